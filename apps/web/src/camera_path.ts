// Where a camera with key poses is at a time: the same curve as cameraAt in src/scene/camera_path.cpp, so that the page moves as
// films do. A cubic through the keys; its speed at a key is that from the key before to the key after, none at the ends and beside
// a rest (two equal keys).
import type { CameraKey } from './tracks';

interface Pose {
  position: [number, number, number];
  target: [number, number, number];
  fieldOfView: number;
}

const kLeastFieldOfView = 1; // degrees: curves may swing a little past their keys
const kMostFieldOfView = 170;

function flat(key: Pose): number[] {
  return [...key.position, ...key.target, key.fieldOfView];
}

function equalPoses(a: CameraKey, b: CameraKey): boolean {
  const there = flat(b);
  return flat(a).every((value, k) => value === there[k]);
}

// Change per second at a key.
function speedAt(path: CameraKey[], k: number): number[] {
  const none = [0, 0, 0, 0, 0, 0, 0];
  if (k === 0 || k + 1 === path.length || equalPoses(path[k - 1], path[k]) || equalPoses(path[k], path[k + 1])) return none;
  const before = flat(path[k - 1]);
  const span = path[k + 1].time - path[k - 1].time;
  return flat(path[k + 1]).map((value, i) => (value - before[i]) / span);
}

function between(path: CameraKey[], k: number, time: number): number[] {
  const span = path[k + 1].time - path[k].time;
  const s = (time - path[k].time) / span;
  const s2 = s * s;
  const s3 = s2 * s;
  const [from, to, leaving, arriving] = [flat(path[k]), flat(path[k + 1]), speedAt(path, k), speedAt(path, k + 1)];
  return from.map((value, i) => value * (2 * s3 - 3 * s2 + 1) + to[i] * (3 * s2 - 2 * s3)
    + leaving[i] * (s3 - 2 * s2 + s) * span + arriving[i] * (s3 - s2) * span);
}

// `path` has at least one key, and its times ascend.
export function poseAt(path: CameraKey[], time: number): Pose {
  const next = path.findIndex((key) => time < key.time);
  const last = path.length - 1;
  const v = next > 0 ? between(path, next - 1, time) : flat(path[next === 0 ? 0 : last]);
  return {
    position: [v[0], v[1], v[2]], target: [v[3], v[4], v[5]],
    fieldOfView: Math.min(kMostFieldOfView, Math.max(kLeastFieldOfView, v[6])),
  };
}
