// How much room a run takes: what the overview has to show.
import { Box3, Quaternion, Vector3 } from 'three';
import type { ShapeMeta, Take } from './tracks';

const kMostSamples = 48; // frames that are looked at, besides the first and the last
const kFallen = 0.3; // m below the lowest that is fixed
const kStraying = 0.03; // of the bodies may stray: they do not say how large the scene is
const kStrayReach = 0.6; // of that size: as far outside of it a stray is still followed
const kOutermost = 96; // directions in which the farthest corner is kept

// m, from its middle to what is farthest of it.
export function sizeOf(take: Take, body: number): number {
  let most = 0.01;
  for (const part of take.meta.bodies[body].parts) {
    const shape = take.meta.shapes[part.shape];
    let far = shape.half ? Math.hypot(...shape.half) : (shape.radius ?? 0) + (shape.halfHeight ?? 0);
    for (let k = 0; k < (shape.positions?.length ?? 0); k += 3) far = Math.max(far, Math.hypot(...shape.positions!.slice(k, k + 3)));
    most = Math.max(most, far + (part.position ? Math.hypot(...part.position) : 0));
  }
  return most;
}

// m, of what a part is made of: its corners, and how far it reaches around them.
function cornersOf(shape: ShapeMeta): { corners: number[]; round: number } {
  if (shape.positions) return { corners: shape.positions, round: 0 };
  const [x, y, z] = shape.half ?? [0, shape.halfHeight ?? 0, 0];
  const corners = [-x, x].flatMap((a) => [-y, y].flatMap((b) => [-z, z].flatMap((c) => [a, b, c])));
  return { corners, round: shape.radius ?? 0 };
}

// m, below all that is fixed: who has fallen so far has left the scene. None where a plane or nothing is there to fall from.
function bottomOf(take: Take): number {
  let lowest = Infinity;
  const point = new Vector3();
  for (const [body, meta] of take.meta.bodies.entries()) {
    if (meta.mass > 0) continue;
    const turn = new Quaternion(...take.rotation(0, body));
    for (const part of meta.parts) {
      const shape = take.meta.shapes[part.shape];
      if (shape.type === 'plane') return -Infinity;
      const partTurn = part.rotation ? new Quaternion(...part.rotation) : new Quaternion();
      const { corners, round } = cornersOf(shape);
      for (let k = 0; k < corners.length; k += 3) {
        point.set(corners[k], corners[k + 1], corners[k + 2]).applyQuaternion(partTurn);
        if (part.position) point.add(new Vector3(...part.position));
        lowest = Math.min(lowest, point.applyQuaternion(turn).y + take.position(0, body)[1] - round);
      }
    }
  }
  return lowest === Infinity ? -Infinity : lowest - kFallen;
}

// Of one body from start to end.
function roomOf(take: Take, body: number, bottom: number): Box3 {
  const first = take.births[body];
  const last = take.ends[body] - 1;
  const samples = Math.min(kMostSamples, last - first) + 1;
  const box = new Box3();
  const point = new Vector3();
  for (let k = 0; k < samples; k++) {
    point.fromArray(take.positions, 3 * take.at(first + Math.round((k * (last - first)) / Math.max(1, samples - 1)), body));
    if (k === 0 || point.y > bottom) box.expandByPoint(point);
  }
  return box.expandByScalar(sizeOf(take, body));
}

// The box that holds all but the few that go farthest, each way.
function roomOfMost(rooms: Box3[]): Box3 {
  const left = Math.floor(rooms.length * kStraying);
  const out = new Box3();
  for (let axis = 0; axis < 3; axis++) {
    out.min.setComponent(axis, rooms.map((room) => room.min.getComponent(axis)).sort((a, b) => a - b)[left]);
    out.max.setComponent(axis, rooms.map((room) => room.max.getComponent(axis)).sort((a, b) => b - a)[left]);
  }
  return out;
}

// The corners farthest in directions that are spread evenly (along a spiral from pole to pole): what shows them shows all boxes, but
// for slivers. A box around all would have corners where nothing ever is, as beside a wall whose bricks fly off in a narrow fan.
function outermostOf(boxes: Box3[]): Vector3[] {
  const goldenAngle = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: kOutermost }, (_, k) => {
    const y = 1 - (2 * k + 1) / kOutermost;
    const ring = Math.sqrt(1 - y * y);
    const direction = new Vector3(ring * Math.cos(k * goldenAngle), y, ring * Math.sin(k * goldenAngle));
    const corner = new Vector3();
    const farthest = new Vector3();
    let most = -Infinity;
    for (const { min, max } of boxes) {
      corner.set(direction.x > 0 ? max.x : min.x, direction.y > 0 ? max.y : min.y, direction.z > 0 ? max.z : min.z);
      const far = corner.dot(direction);
      if (far <= most) continue;
      most = far;
      farthest.copy(corner);
    }
    return farthest;
  });
}

export interface Bounds {
  start: Box3; // of what stands there at the start
  most: Box3; // of the whole run, but for few that stray
  outermost: Vector3[]; // corners of all that is to be seen of the run, strays too
}

// Every body counts with all of its way; only who leaves far behind what the others need, as a ball that rolls away, is followed
// for a part of it.
export function boundsOf(take: Take): Bounds {
  const shown = take.meta.bodies.map((_, k) => k).filter((k) => take.meta.bodies[k].role !== 'ground' && take.ends[k] > take.births[k]);
  const moving = shown.filter((k) => take.meta.bodies[k].mass > 0);
  const movable = moving.length > 0 ? moving : shown; // what is fixed may be a whole landscape
  const start = new Box3();
  if (movable.length === 0) {
    start.set(new Vector3(-1, 0, -1), new Vector3(1, 1, 1));
    return { start, most: start.clone(), outermost: outermostOf([start]) };
  }
  const targets = movable.filter((k) => take.meta.bodies[k].role !== 'ball');
  const counted = targets.length > 0 ? targets : movable;
  const early = counted.filter((k) => take.isThere(0, k));
  const point = new Vector3();
  for (const k of early.length > 0 ? early : counted) {
    start.union(new Box3().setFromCenterAndSize(point.set(...take.position(0, k)), new Vector3().setScalar(2 * sizeOf(take, k))));
  }
  const bottom = bottomOf(take);
  const roomBy = new Map(movable.map((k) => [k, roomOf(take, k, bottom)]));
  const most = roomOfMost(counted.map((k) => roomBy.get(k)!)).union(start);
  const limit = most.clone().expandByScalar(kStrayReach * most.getSize(point).length());
  const rooms = [...roomBy.values()].map((room) => room.intersect(limit)).filter((room) => !room.isEmpty());
  return { start, most, outermost: outermostOf(rooms) };
}
