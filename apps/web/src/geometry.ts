// Meshes of shapes. Boxes get a small bevel: it catches the light along the edges, which is what makes single bricks of a
// wall without mortar tell apart.
import { BufferAttribute, BufferGeometry, CapsuleGeometry, SphereGeometry, Vector3 } from 'three';
import type { ShapeMeta } from './tracks';

const kBevel = 0.0022; // m

// Each corner of the box becomes three points, one on each face that meets there; faces, edges and corners are filled
// between them. Normals of the faces stay flat, those of the bevels lie between.
export function bevelledBox(half: [number, number, number]): BufferGeometry {
  const bevel = Math.min(kBevel, Math.min(...half) * 0.12);
  const positions: number[] = [];
  const normals: number[] = [];
  const quad = (points: Vector3[], normal: Vector3): void => {
    const turned = new Vector3().crossVectors(points[1].clone().sub(points[0]), points[2].clone().sub(points[0])).dot(normal) < 0;
    const order = turned ? [0, 2, 1, 0, 3, 2] : [0, 1, 2, 0, 2, 3];
    for (const k of order.filter((k) => k < points.length)) {
      positions.push(points[k].x, points[k].y, points[k].z);
      normals.push(normal.x, normal.y, normal.z);
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
      quad(corners, axisVector(axis, a));
      for (const b of [1, -1]) { // the edge between the faces of axis and u, along v
        const points = [
          onFace(signs(axis, a, u, b, v, -1), axis), onFace(signs(axis, a, u, b, v, 1), axis),
          onFace(signs(axis, a, u, b, v, 1), u), onFace(signs(axis, a, u, b, v, -1), u),
        ];
        quad(points, axisVector(axis, a).add(axisVector(u, b)).normalize());
      }
    }
  }
  for (const x of [1, -1]) for (const y of [1, -1]) for (const z of [1, -1]) {
    const s = [x, y, z];
    const points = [onFace(s, 0), onFace(s, 1), onFace(s, 2)];
    const normal = new Vector3(x, y, z).normalize();
    const turned = new Vector3().crossVectors(points[1].clone().sub(points[0]), points[2].clone().sub(points[0])).dot(normal) < 0;
    for (const p of turned ? [points[0], points[2], points[1]] : points) {
      positions.push(p.x, p.y, p.z);
      normals.push(normal.x, normal.y, normal.z);
    }
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
    case 'hull': {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(shape.positions!), 3));
      geometry.setAttribute('normal', new BufferAttribute(new Float32Array(shape.normals!), 3));
      geometry.setIndex(shape.indices!);
      return geometry;
    }
    case 'plane':
      return null; // the stage draws it
  }
}
