// From where one looks: an overview that fits the whole run, the cameras of the take, and one that goes along with the ball.
import { Box3, PerspectiveCamera, Vector3 } from 'three';
import { sizeOf, type Bounds } from './bounds';
import { poseAt } from './camera_path';
import type { Stage } from './stage';
import type { CameraKey, Take } from './tracks';

export interface View {
  name: string;
  position: Vector3;
  target: Vector3;
  fieldOfView: number;
  follows: number; // body, -1 = none
  path?: CameraKey[]; // along which it moves while the run plays
  turnsAfter?: number; // a body: while it is there it is the target
}

// From the ball's side, a third of a right angle off its line, so that both the flight and the breach are seen.
export function overviewSide(take: Take, bounds: Bounds): Vector3 {
  const ball = take.meta.bodies.findIndex((body) => body.role === 'ball');
  const towards = ball >= 0 ? new Vector3(...take.position(0, ball)).sub(bounds.start.getCenter(new Vector3())).setY(0) : new Vector3(0, 0, 1);
  if (towards.length() < 0.2) towards.set(0, 0, 1);
  return towards.normalize().applyAxisAngle(new Vector3(0, 1, 0), 0.56);
}

// From what the first camera looks at to the camera: the sun goes by it. Of one that moves: where its path begins.
export function firstSide(take: Take, bounds: Bounds): Vector3 {
  const camera = take.meta.cameras[0];
  if (!camera) return overviewSide(take, bounds);
  const pose = camera.path?.length ? poseAt(camera.path, camera.path[0].time) : camera;
  return new Vector3(...pose.position).sub(new Vector3(...pose.target));
}

// What page and bar leave of the picture's height: from 1 (its top) to -1.
export interface FreeHeight {
  top: number;
  bottom: number;
}

// From that side and a little above, just so far that all points are in the free part of the picture.
function fitted(points: Vector3[], towards: Vector3, aspect: number, free: FreeHeight): View {
  const fieldOfView = 36;
  const camera = new PerspectiveCamera(fieldOfView, aspect, 0.01, 1e5);
  const box = new Box3().setFromPoints(points);
  const target = box.getCenter(new Vector3());
  const direction = towards.clone().add(new Vector3(0, 0.24, 0)).normalize();
  const right = new Vector3(direction.z, 0, -direction.x).normalize();
  let distance = Math.max(0.5, box.getSize(new Vector3()).length() * 2);
  const seen = new Vector3();
  for (let round = 0; round < 24; round++) {
    camera.position.copy(target).addScaledVector(direction, distance);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    const around = new Box3();
    for (const point of points) around.expandByPoint(seen.copy(point).project(camera));
    // Aside, up or down until they lie in the middle of the free part, nearer or farther until they fill nine tenths of it.
    const half = Math.tan((fieldOfView * Math.PI) / 360);
    const off = around.getCenter(seen);
    target.addScaledVector(right, off.x * half * aspect * distance * 0.8);
    target.y += (off.y - (free.top + free.bottom) / 2) * half * distance * 0.8;
    const size = around.getSize(seen);
    const fill = Math.max(size.x / 1.8, size.y / (0.9 * (free.top - free.bottom)));
    distance *= Math.min(1.5, Math.max(0.6, fill)) ** 0.8;
  }
  return { name: 'Overview', position: target.clone().addScaledVector(direction, distance), target, fieldOfView, follows: -1 };
}

export function viewsOf(take: Take, bounds: Bounds, aspect: number, free: FreeHeight): View[] {
  const ball = take.meta.bodies.findIndex((body) => body.role === 'ball');
  const towards = overviewSide(take, bounds);
  const views: View[] = [fitted(bounds.outermost, towards, aspect, free)];
  for (const camera of take.meta.cameras) {
    const path = camera.path?.length ? camera.path : undefined;
    views.push({ name: camera.name, position: new Vector3(...camera.position), target: new Vector3(...camera.target), fieldOfView: camera.fieldOfView, follows: -1, path, turnsAfter: camera.turnsAfter });
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

// A camera of a scene is set up for a picture as wide as a screen. In a narrower one it steps back until what stands at the start is
// seen from side to side, at most as far as shows all that the wide one does: by a factor, 1 or more.
function stepBack(position: Vector3, target: Vector3, fieldOfView: number, aspect: number, start: Box3): number {
  const most = Math.max(1, kUsualAspect / aspect);
  const camera = new PerspectiveCamera(fieldOfView, aspect, 0.01, 1e5);
  const corners = [start.min, start.max].flatMap((x) => [start.min, start.max].flatMap((y) => [start.min, start.max].map((z) => new Vector3(x.x, y.y, z.z))));
  for (let back = 1; back < most; back *= 1.06) {
    camera.position.copy(position).sub(target).multiplyScalar(back).add(target);
    camera.lookAt(target);
    camera.updateMatrixWorld();
    if (corners.every((corner) => Math.abs(corner.clone().project(camera).x) < 0.96)) return back;
  }
  return most;
}

// time: s, for a camera that moves; seen: where the body is that it turns after.
export function applyView(stage: Stage, view: View, fits: boolean, time: number, bounds: Bounds, seen: Vector3 | null): void {
  const pose = view.path ? poseAt(view.path, time) : null;
  const target = seen ?? (pose ? new Vector3(...pose.target) : view.target);
  const position = pose ? new Vector3(...pose.position) : view.position.clone();
  const fieldOfView = pose ? pose.fieldOfView : view.fieldOfView;
  const back = fits ? 1 : stepBack(position, target, fieldOfView, stage.camera.aspect, bounds.start);
  stage.look(position.sub(target).multiplyScalar(back).add(target), target, fieldOfView);
}
