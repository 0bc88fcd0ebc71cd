// Meshes of shapes. Boxes get a small bevel: it catches the light along the edges, which is what makes single bricks of a
// wall without mortar tell apart.
import { BufferAttribute, BufferGeometry, CapsuleGeometry, CylinderGeometry, SphereGeometry } from 'three';
import type { ShapeMeta } from './tracks';

const kBevel = 0.0022; // m

// In the shader of a box: from a corner of the box of half size 1 to where it lies on its face, whose edges are bevelled. As a share of
// the half size, which the instance's matrix brings.
export const kBevelled = `
  vec3 boxHalf = max(vec3(length(instanceMatrix[0]), length(instanceMatrix[1]), length(instanceMatrix[2])), vec3(1e-6));
  float bevel = min(${kBevel}, 0.12 * min(boxHalf.x, min(boxHalf.y, boxHalf.z)));
  vec3 onBox = position * (1.0 - bevel * (1.0 - abs(normal)) / boxHalf);`;

// One mesh for boxes of all sizes. Each corner is three points, one on each face that meets there; faces, edges and corners are
// filled between them. Each point has the normal of its face, so that faces are flat and the bevels between them round. All three lie in
// the corner until the shader parts them.
function unitBox(): BufferGeometry {
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (let corner = 0; corner < 8; corner++) {
    const signs = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? 1 : -1));
    for (let axis = 0; axis < 3; axis++) {
      positions.push(...signs);
      normals.push(...signs.map((sign, k) => (k === axis ? sign : 0)));
    }
  }
  // The point on the face of `axis` in the corner whose signs on axes u and v are b and c.
  const point = (face: number, axis: number, a: number, u: number, b: number, v: number, c: number): number =>
    3 * (((a > 0 ? 1 : 0) << axis) + ((b > 0 ? 1 : 0) << u) + ((c > 0 ? 1 : 0) << v)) + face;
  // Round the way that faces outward: the other way for faces and edges on the negative side, whichever it is.
  const fill = (points: number[], isTurned: boolean): void => {
    const triangles = points.length === 3 ? [0, 1, 2] : [0, 1, 2, 0, 2, 3];
    for (const k of isTurned ? triangles.reverse() : triangles) indices.push(points[k]);
  };
  for (let axis = 0; axis < 3; axis++) {
    const u = (axis + 1) % 3;
    const v = (axis + 2) % 3;
    for (const a of [-1, 1]) {
      fill([[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([b, c]) => point(axis, axis, a, u, b, v, c)), a < 0);
      for (const b of [-1, 1]) { // the edge between the faces of axis and u, along v
        fill([point(axis, axis, a, u, b, v, -1), point(u, axis, a, u, b, v, -1), point(u, axis, a, u, b, v, 1), point(axis, axis, a, u, b, v, 1)], a * b < 0);
      }
    }
  }
  for (let corner = 0; corner < 8; corner++) {
    const isOdd = ((corner & 1) + ((corner >> 1) & 1) + (corner >> 2)) % 2 === 0; // an even number of positive sides
    fill([0, 1, 2].map((axis) => 3 * corner + axis), isOdd);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(indices);
  return geometry;
}

export function geometryOf(shape: ShapeMeta): BufferGeometry | null {
  switch (shape.type) {
    case 'box':
      return unitBox(); // of any size: the size is in the instance's matrix
    case 'sphere':
      return new SphereGeometry(shape.radius, 40, 24);
    case 'capsule':
      return new CapsuleGeometry(shape.radius, 2 * shape.halfHeight!, 12, 28);
    case 'cylinder':
      return new CylinderGeometry(shape.radius, shape.radius, 2 * shape.halfHeight!, 48);
    case 'cone':
      return new CylinderGeometry(shape.topRadius!, shape.radius, 2 * shape.halfHeight!, 48);
    case 'hull': {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(shape.positions!), 3));
      geometry.setAttribute('normal', new BufferAttribute(new Float32Array(shape.normals!), 3));
      geometry.setIndex(shape.indices!);
      return geometry;
    }
    case 'plane':
      return null; // without end: the stage draws as much of it as can be seen
  }
}
