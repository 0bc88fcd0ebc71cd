// Meshes of shapes. Boxes get a small bevel: it catches the light along the edges, which is what makes single bricks of a
// wall without mortar tell apart.
import { BufferAttribute, BufferGeometry, CapsuleGeometry, CylinderGeometry, SphereGeometry, Vector3 } from 'three';
import type { ShapeMeta } from './tracks';

const kBevel = 0.0022; // m

// Each corner of the box becomes three points, one on each face that meets there; faces, edges and corners are filled
// between them. Each point has the normal of its face, so that faces are flat and the bevels between them round.
export function bevelledBox(half: [number, number, number]): BufferGeometry {
  const bevel = Math.min(kBevel, Math.min(...half) * 0.12);
  const positions: number[] = [];
  const normals: number[] = [];
  // Three or four points, with a normal for each.
  const fill = (points: Vector3[], facing: Vector3[]): void => {
    const outward = facing.reduce((sum, n) => sum.add(n), new Vector3());
    const turned = new Vector3().crossVectors(points[1].clone().sub(points[0]), points[2].clone().sub(points[0])).dot(outward) < 0;
    const triangles = points.length === 3 ? [0, 1, 2] : [0, 1, 2, 0, 2, 3];
    for (const k of turned ? triangles.reverse() : triangles) {
      positions.push(points[k].x, points[k].y, points[k].z);
      normals.push(facing[k].x, facing[k].y, facing[k].z);
    }
  };
  // The corner of signs s as it lies on the face of `axis`.
  const onFace = (s: number[], axis: number): Vector3 =>
    new Vector3(...s.map((sign, k) => sign * (half[k] - (k === axis ? 0 : bevel))));
  const axisVector = (axis: number, sign: number): Vector3 => new Vector3().setComponent(axis, sign);
  const signs = (axis: number, a: number, u: number, b: number, v: number, c: number): number[] => {
    const s = [0, 0, 0];
    s[axis] = a;
    s[u] = b;
    s[v] = c;
    return s;
  };
  for (let axis = 0; axis < 3; axis++) {
    const u = (axis + 1) % 3;
    const v = (axis + 2) % 3;
    for (const a of [1, -1]) {
      const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([b, c]) => onFace(signs(axis, a, u, b, v, c), axis));
      const facing = axisVector(axis, a);
      fill(corners, [facing, facing, facing, facing]);
      for (const b of [1, -1]) { // the edge between the faces of axis and u, along v
        const points = [
          onFace(signs(axis, a, u, b, v, -1), axis), onFace(signs(axis, a, u, b, v, 1), axis),
          onFace(signs(axis, a, u, b, v, 1), u), onFace(signs(axis, a, u, b, v, -1), u),
        ];
        fill(points, [facing, facing, axisVector(u, b), axisVector(u, b)]);
      }
    }
  }
  for (const x of [1, -1]) for (const y of [1, -1]) for (const z of [1, -1]) {
    const s = [x, y, z];
    fill([0, 1, 2].map((axis) => onFace(s, axis)), [0, 1, 2].map((axis) => axisVector(axis, s[axis])));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  return geometry;
}

export function geometryOf(shape: ShapeMeta): BufferGeometry | null {
  switch (shape.type) {
    case 'box':
      return bevelledBox(shape.half!);
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
