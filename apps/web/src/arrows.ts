// Arrows on demand: each body's velocity, or the force that all others and gravity together have on it (mass x acceleration).
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, LineBasicMaterial, LineSegments, Scene, Vector3 } from 'three';
import { sizeOf } from './bounds';
import type { Take } from './tracks';

export type ArrowKind = 'none' | 'velocity' | 'force';
export const kArrowKinds: ArrowKind[] = ['none', 'velocity', 'force'];
const kColours = { none: '#000000', velocity: '#0b5fd0', force: '#c81e4a' };
const kAhead = 0.1; // s: a velocity's arrow is as long as the way in that time
const kLeastSpeed = 0.05; // m/s: slower may be no more than a step of the positions' grid
const kLeastAcceleration = 1; // m/s2: likewise
const kStandard = 9.81; // m/s2: a force's arrow is as long as its body where it is its weight on earth
const kLongest = 1.5; // m
const kOver = 2; // frames to both sides over which an acceleration is taken
const kHead = 0.28; // of the length
const kMostHead = 0.08; // m

export class Arrows {
  kind: ArrowKind = 'none';
  count = 0; // shown
  private readonly lines: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly movable: number[];
  private readonly places: Float32Array;

  constructor(private readonly take: Take, scene: Scene) {
    this.movable = take.meta.bodies.flatMap((body, k) => (body.mass > 0 ? [k] : []));
    this.places = new Float32Array(this.movable.length * 18); // a shaft and two barbs
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
    this.lines = new LineSegments(geometry, new LineBasicMaterial({ depthTest: false, transparent: true }));
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 4;
    scene.add(this.lines);
  }

  next(): void {
    this.kind = kArrowKinds[(kArrowKinds.indexOf(this.kind) + 1) % kArrowKinds.length];
  }

  // m/s, from the frame before to the one after; null where one of them is not there.
  velocity(frame: number, body: number): Vector3 | null {
    const [from, to] = [Math.max(0, frame - 1), Math.min(this.take.frames - 1, frame + 1)];
    if (from === to || !this.take.isThere(from, body) || !this.take.isThere(to, body)) return null;
    const way = new Vector3(...this.take.position(to, body)).sub(new Vector3(...this.take.position(from, body)));
    return way.divideScalar(this.take.times[to] - this.take.times[from]);
  }
  // N: its mean over some frames.
  force(frame: number, body: number): Vector3 | null {
    const [from, to] = [frame - kOver, frame + kOver];
    if (from < 0 || to >= this.take.frames || !this.take.isThere(from, body) || !this.take.isThere(to, body)) return null;
    const seconds = 0.5 * (this.take.times[to] - this.take.times[from]);
    const sum = new Vector3(...this.take.position(to, body)).add(new Vector3(...this.take.position(from, body)));
    const bend = sum.addScaledVector(new Vector3(...this.take.position(frame, body)), -2);
    return bend.multiplyScalar(this.take.meta.bodies[body].mass / (seconds * seconds));
  }

  // From which place, and how long it is drawn; null: it is not.
  private shaft(frame: number, body: number): Vector3 | null {
    const { mass } = this.take.meta.bodies[body];
    const value = this.kind === 'velocity' ? this.velocity(frame, body) : this.force(frame, body);
    const least = this.kind === 'velocity' ? kLeastSpeed : kLeastAcceleration * mass;
    if (!value || value.length() < least) return null;
    const scale = this.kind === 'velocity' ? kAhead : (2 * sizeOf(this.take, body)) / (mass * kStandard);
    return value.multiplyScalar(scale).clampLength(0, kLongest);
  }

  // `eye`: where the camera stands: barbs lie across its sight.
  show(frame: number, eye: Vector3): void {
    this.count = 0;
    for (const body of this.kind === 'none' ? [] : this.movable) {
      if (!this.take.isThere(frame, body)) continue;
      const along = this.shaft(frame, body);
      if (along) this.put(new Vector3(...this.take.position(frame, body)), along, eye);
    }
    this.lines.visible = this.count > 0;
    this.lines.geometry.setDrawRange(0, this.count * 6);
    this.lines.geometry.attributes.position.needsUpdate = true;
    this.lines.material.color.set(kColours[this.kind]);
  }

  private put(from: Vector3, along: Vector3, eye: Vector3): void {
    const tip = from.clone().add(along);
    const head = Math.min(kMostHead, kHead * along.length());
    const back = along.clone().setLength(-head).add(tip);
    const aside = new Vector3().crossVectors(along, eye.clone().sub(from)).setLength(0.5 * head);
    const points = [from, tip, tip, back.clone().add(aside), tip, back.clone().sub(aside)];
    for (const [k, point] of points.entries()) point.toArray(this.places, this.count * 18 + k * 3);
    this.count++;
  }
}
