// From where one looks: an overview that fits the whole run, the cameras of the take, and one that goes along with the ball.
import { Box3, PerspectiveCamera, Vector3 } from 'three';
import type { Stage } from './stage';
import type { Take } from './tracks';

export interface View {
  name: string;
  position: Vector3;
  target: Vector3;
  fieldOfView: number;
  follows: number; // body, -1 = none
}

function sizeOf(take: Take, body: number): number {
  let most = 0.05;
  for (const part of take.meta.bodies[body].parts) {
    const shape = take.meta.shapes[part.shape];
    const far = shape.half ? Math.hypot(...shape.half) : (shape.radius ?? 0) + (shape.halfHeight ?? 0);
    most = Math.max(most, far);
  }
  return most;
}

// What to look at: all bricks and other bodies as they stand at the start, and those that lie near at the end.
export function interestingBounds(take: Take): { start: Box3; all: Box3 } {
  const start = new Box3();
  const movable = take.meta.bodies.map((_, k) => k).filter((k) => take.meta.bodies[k].role !== 'ground');
  const bricks = movable.filter((k) => take.meta.bodies[k].role !== 'ball');
  const point = new Vector3();
  // Those of the start; where nothing is there yet, all where they come.
  const first = (bricks.length > 0 ? bricks : movable).filter((k) => take.isThere(0, k));
  for (const k of first.length > 0 ? first : movable) {
    const size = sizeOf(take, k);
    start.expandByPoint(point.set(...take.position(0, k)).addScalar(size));
    start.expandByPoint(point.set(...take.position(0, k)).addScalar(-size));
  }
  if (start.isEmpty()) start.set(new Vector3(-1, 0, -1), new Vector3(1, 1, 1));
  const all = start.clone();
  const last = take.frames - 1;
  for (let axis = 0; axis < 3; axis++) {
    const ends = bricks.filter((k) => take.isThere(last, k)).map((k) => take.position(last, k)[axis]).sort((a, b) => a - b);
    if (ends.length === 0) continue;
    const low = ends[Math.floor(ends.length * 0.04)];
    const high = ends[Math.ceil(ends.length * 0.96) - 1];
    const reach = start.getSize(point).length() * 2;
    all.min.setComponent(axis, Math.min(all.min.getComponent(axis), Math.max(low - 0.15, all.min.getComponent(axis) - reach)));
    all.max.setComponent(axis, Math.max(all.max.getComponent(axis), Math.min(high + 0.15, all.max.getComponent(axis) + reach)));
  }
  return { start, all };
}

// From the ball's side, a third of a right angle off its line, so that both the flight and the breach are seen.
export function overviewSide(take: Take, bounds: { start: Box3 }): Vector3 {
  const ball = take.meta.bodies.findIndex((body) => body.role === 'ball');
  const towards = ball >= 0 ? new Vector3(...take.position(0, ball)).sub(bounds.start.getCenter(new Vector3())).setY(0) : new Vector3(0, 0, 1);
  if (towards.length() < 0.2) towards.set(0, 0, 1);
  return towards.normalize().applyAxisAngle(new Vector3(0, 1, 0), 0.56);
}

// What page and bar leave of the picture's height: from 1 (its top) to -1.
export interface FreeHeight {
  top: number;
  bottom: number;
}

// From that side and a little above, just so far that the whole box is in the free part of the picture.
function fitted(box: Box3, towards: Vector3, aspect: number, free: FreeHeight): View {
  const fieldOfView = 36;
  const camera = new PerspectiveCamera(fieldOfView, aspect, 0.01, 1e5);
  const target = box.getCenter(new Vector3());
  const direction = towards.clone().add(new Vector3(0, 0.24, 0)).normalize();
  let distance = Math.max(0.5, box.getSize(new Vector3()).length() * 2);
  const corner = new Vector3();
  for (let round = 0; round < 24; round++) {
    camera.position.copy(target).addScaledVector(direction, distance);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    const seen = { left: 1e9, right: -1e9, low: 1e9, high: -1e9 };
    for (let k = 0; k < 8; k++) {
      corner.set(k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z).project(camera);
      seen.left = Math.min(seen.left, corner.x);
      seen.right = Math.max(seen.right, corner.x);
      seen.low = Math.min(seen.low, corner.y);
      seen.high = Math.max(seen.high, corner.y);
    }
    // Up or down until it lies in the middle of the free part, nearer or farther until it fills nine tenths of it.
    const half = Math.tan((fieldOfView * Math.PI) / 360);
    const off = (seen.low + seen.high - free.top - free.bottom) / 2;
    target.y += off * half * distance * 0.8;
    const fill = Math.max((seen.right - seen.left) / 1.8, Math.max(Math.abs(seen.left), Math.abs(seen.right)) / 0.9,
      (seen.high - seen.low) / (0.9 * (free.top - free.bottom)));
    distance *= Math.min(1.5, Math.max(0.6, fill)) ** 0.8;
  }
  return { name: 'Overview', position: target.clone().addScaledVector(direction, distance), target, fieldOfView, follows: -1 };
}

export function viewsOf(take: Take, bounds: { start: Box3; all: Box3 }, aspect: number, free: FreeHeight): View[] {
  const ball = take.meta.bodies.findIndex((body) => body.role === 'ball');
  const towards = overviewSide(take, bounds);
  const views: View[] = [fitted(bounds.all, towards, aspect, free)];
  for (const camera of take.meta.cameras) {
    views.push({ name: camera.name, position: new Vector3(...camera.position), target: new Vector3(...camera.target), fieldOfView: camera.fieldOfView, follows: -1 });
  }
  if (ball >= 0) {
    const from = new Vector3(...take.position(0, ball));
    const far = Math.max(0.3, 7 * sizeOf(take, ball));
    const behind = from.clone().addScaledVector(towards, far).add(new Vector3(0, 0.5 * far, 0));
    views.push({ name: 'Follow the ball', position: behind, target: from, fieldOfView: 48, follows: ball });
  }
  return views;
}

const kUsualAspect = 1.6;

// Cameras of a scene are set up for a picture as wide as a screen: in a narrower one they step back.
export function applyView(stage: Stage, view: View, fits: boolean): void {
  const back = fits ? 1 : Math.max(1, kUsualAspect / stage.camera.aspect) ** 0.75;
  stage.camera.position.copy(view.position).sub(view.target).multiplyScalar(back).add(view.target);
  stage.camera.fov = view.fieldOfView;
  stage.camera.updateProjectionMatrix();
  stage.controls.target.copy(view.target);
  stage.controls.update();
}
