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
}

// From the ball's side, a third of a right angle off its line, so that both the flight and the breach are seen.
export function overviewSide(take: Take, bounds: Bounds): Vector3 {
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
    views.push({ name: camera.name, position: new Vector3(...camera.position), target: new Vector3(...camera.target), fieldOfView: camera.fieldOfView, follows: -1, path });
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

// time: s, for a camera that moves. Cameras of a scene are set up for a picture as wide as a screen: in a narrower one they step back.
export function applyView(stage: Stage, view: View, fits: boolean, time: number): void {
  const pose = view.path ? poseAt(view.path, time) : null;
  const target = pose ? new Vector3(...pose.target) : view.target;
  const position = pose ? new Vector3(...pose.position) : view.position.clone();
  const back = fits ? 1 : Math.max(1, kUsualAspect / stage.camera.aspect) ** 0.75;
  stage.look(position.sub(target).multiplyScalar(back).add(target), target, pose ? pose.fieldOfView : view.fieldOfView);
}
