// From where one looks: an overview that fits the scene, the cameras of the take, and one that goes along with the ball.
import { Box3, MathUtils, Vector3 } from 'three';
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

export function viewsOf(take: Take, bounds: { start: Box3; all: Box3 }, aspect: number): View[] {
  const ball = take.meta.bodies.findIndex((body) => body.role === 'ball');
  const centre = bounds.start.getCenter(new Vector3());
  const towards = overviewSide(take, bounds);
  const size = bounds.start.getSize(new Vector3()).length() / 2;
  const radius = size + 0.14 * (bounds.all.getSize(new Vector3()).length() / 2 - size);
  const fieldOfView = 36;
  const opening = Math.atan(Math.tan(MathUtils.degToRad(fieldOfView / 2)) * Math.min(1.45, aspect));
  const distance = (radius * 1.15) / Math.sin(opening);
  // A little below the middle of the picture, where the bar does not reach.
  const target = new Vector3(centre.x, centre.y - 0.1 * size, centre.z);
  const position = target.clone().addScaledVector(towards, distance * 0.97).add(new Vector3(0, distance * 0.235, 0));
  const views: View[] = [{ name: 'Overview', position, target, fieldOfView, follows: -1 }];
  for (const camera of take.meta.cameras) {
    views.push({ name: camera.name, position: new Vector3(...camera.position), target: new Vector3(...camera.target), fieldOfView: camera.fieldOfView, follows: -1 });
  }
  if (ball >= 0) {
    const from = new Vector3(...take.position(0, ball));
    const behind = from.clone().addScaledVector(towards, 0.9).add(new Vector3(0, 0.45, 0));
    views.push({ name: 'Follow the ball', position: behind, target: from, fieldOfView: 48, follows: ball });
  }
  return views;
}

export function applyView(stage: Stage, view: View): void {
  stage.camera.position.copy(view.position);
  stage.camera.fov = view.fieldOfView;
  stage.camera.updateProjectionMatrix();
  stage.controls.target.copy(view.target);
  stage.controls.update();
}
