// The motion of a take: unpacks what src/output/replay_tracks.cpp packed (docs/decisions/0005-replay-data.md).
import { decompress } from 'fzstd';

export interface ShapeMeta {
  type: 'box' | 'sphere' | 'capsule' | 'cylinder' | 'cone' | 'hull' | 'plane';
  half?: [number, number, number];
  radius?: number;
  topRadius?: number;
  halfHeight?: number;
  positions?: number[];
  normals?: number[];
  indices?: number[];
}
export interface PartMeta {
  shape: number;
  position?: [number, number, number];
  rotation?: [number, number, number, number];
}
export interface BodyMeta {
  name: string;
  role: 'ground' | 'brick' | 'ball' | 'body';
  colour: number;
  mass: number;
  material?: string; // its name in the scene; left out: not known
  partMaterials?: string[]; // one for each part, where they differ
  partColours?: number[]; // likewise
  parts: PartMeta[];
  look?: number; // by which it differs from others of its stuff; left out: its own number
  birth?: number; // the first frame in which it is there; left out: 0
  end?: number; // the first in which it no longer is; left out: it stays
}
export interface CameraKey {
  time: number; // s
  position: [number, number, number];
  target: [number, number, number];
  fieldOfView: number;
}
export interface CameraMeta {
  name: string;
  position: [number, number, number];
  target: [number, number, number];
  fieldOfView: number;
  path?: CameraKey[]; // along which it moves while the run plays; left out: it stays
  turnsAfter?: number; // a body: while it is there it is the target
}
// A mortar joint: where its face is, in the frame of body a.
export interface JointMeta {
  a: number;
  b: number;
  centre: [number, number, number];
  along1: [number, number, number]; // m, half edges
  along2: [number, number, number];
  birth?: number; // as of a body
  end?: number;
}
export interface TakerMeta {
  joint: number; // -1: contacts of the two bodies
  a: number;
  b: number;
  before: number; // N
  after: number;
}
export interface BreakMeta {
  joint: number;
  crackTime: number; // s
  time: number;
  mode: 'tension' | 'shear' | 'crushing' | 'none';
  tension: number; // share of its energy
  shear: number;
  force: number; // N, that it bore before it opened
  takers: TakerMeta[];
}
export interface TakeMeta {
  format: number;
  scene: string;
  title: string;
  engineVersion: string;
  seed: string;
  framesPerSecond: number;
  frames: number;
  positionStep: number;
  turnStep: number;
  forceSteps: number;
  shapes: ShapeMeta[];
  bodies: BodyMeta[];
  cameras: CameraMeta[];
  mortar?: JointMeta[]; // left out: there is none
  breaks?: BreakMeta[];
  falls?: [number, number][]; // a body, and which of the breaks gave way first
  series?: Record<string, number[]>; // figures over time, by their names in series.csv; left out: not known
}

export interface Hit {
  frame: number;
  a: number;
  b: number;
  point: [number, number, number];
  impulse: number;
}

const kEscape = 255;
const kQuatScale = 32767;
const kSeenSpeed = 0.05; // m/s: what is slower hardly shows, and may be no more than a step of the positions' grid

class ByteReader {
  private at = 0;
  private readonly view: DataView;
  constructor(readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  u32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  u8(): number {
    const b = this.bytes[this.at++];
    if (b === undefined) throw new Error('the motion data ends early');
    return b;
  }
  f32(): number {
    this.at += 4;
    return this.view.getFloat32(this.at - 4, true);
  }
  f64(): number {
    this.at += 8;
    return this.view.getFloat64(this.at - 8, true);
  }
  // Exact up to 2^53: products, because shifts would cut at 32 bits.
  varint(): number {
    let value = 0;
    let scale = 1;
    for (;;) {
      const b = this.bytes[this.at++];
      if (b === undefined) throw new Error('the motion data ends early');
      value += (b & 0x7f) * scale;
      if (b < 0x80) return value;
      scale *= 128;
    }
  }
  signedVarint(): number {
    return unzigzag(this.varint());
  }
  section(): ByteReader {
    const size = this.u32();
    if (size > this.bytes.length - this.at) throw new Error('the motion data ends early');
    this.at += size;
    return new ByteReader(this.bytes.subarray(this.at - size, this.at));
  }
}

function unzigzag(code: number): number {
  return code % 2 === 0 ? code / 2 : -(code + 1) / 2;
}

function fromBase64(text: string): Uint8Array {
  const binary = atob(text.trim());
  const out = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) out[k] = binary.charCodeAt(k);
  return out;
}

export class Take {
  readonly bodies: number;
  readonly frames: number;
  readonly times: Float64Array; // s, per frame
  readonly births: Int32Array; // per body: the first frame in which it is there
  readonly ends: Int32Array; // and the first in which it no longer is
  private readonly starts: Float64Array; // and where its frames begin in the lists below
  readonly positions: Float32Array; // [at(frame, body) * 3]
  readonly rotations: Int16Array; // [at(frame, body) * 4], 1 = 32767
  readonly forces: Uint8Array; // [at(frame, body)], code
  readonly hits: Hit[] = []; // in the order of time
  readonly activity: Float32Array; // per frame: root of the summed squares of all speeds that are seen, but the balls'
  topSpeed = 1; // m/s: 95 % of the moving bodies' frames are below it
  topForce = 1; // N
  // Of each mortar joint: the frames in which it changed, and its utilisation and damage from then on, 0 .. 255.
  private readonly mortarFrames: number[][] = [];
  private readonly mortarStates: [number, number][][] = [];

  constructor(readonly meta: TakeMeta, base64: string) {
    if (meta.format !== 2) throw new Error(`replay data of format ${meta.format}; this page reads 2`);
    this.bodies = meta.bodies.length;
    this.frames = meta.frames;
    this.births = Int32Array.from(meta.bodies, (body) => body.birth ?? 0);
    this.ends = Int32Array.from(meta.bodies, (body) => body.end ?? this.frames);
    this.starts = new Float64Array(this.bodies);
    let count = 0;
    for (let body = 0; body < this.bodies; body++) {
      this.starts[body] = count;
      count += this.ends[body] - this.births[body];
    }
    this.times = new Float64Array(this.frames);
    this.positions = new Float32Array(count * 3);
    this.rotations = new Int16Array(count * 4);
    this.forces = new Uint8Array(count);
    this.activity = new Float32Array(this.frames);

    const reader = new ByteReader(decompress(fromBase64(base64)));
    for (let f = 0; f < this.frames; f++) this.times[f] = reader.f64();
    const start = reader.section();
    const planes = Array.from({ length: 7 }, () => reader.section().bytes);
    const large = reader.section();
    this.readBodies(start, planes, large);
    this.readHits(reader.section());
    this.readMortar(reader.section());
    this.measure();
  }

  // The frame nearest to a time, s.
  frameAt(time: number): number {
    let best = 0;
    for (let f = 1; f < this.frames; f++) if (Math.abs(this.times[f] - time) < Math.abs(this.times[best] - time)) best = f;
    return best;
  }
  // s, at a place between two frames.
  timeAt(position: number): number {
    const f = Math.max(0, Math.min(this.frames - 1, Math.floor(position)));
    return this.times[f] + (this.times[Math.min(this.frames - 1, f + 1)] - this.times[f]) * (position - f);
  }
  isThere(frame: number, body: number): boolean {
    return frame >= this.births[body] && frame < this.ends[body];
  }
  // Where the lists have the frame, or the nearest in which the body is there.
  at(frame: number, body: number): number {
    const birth = this.births[body];
    return this.starts[body] + Math.max(0, Math.min(frame, this.ends[body] - 1) - birth);
  }

  // Body by body as it was written; the order of the planes within a body matters only for the list of large numbers.
  private readBodies(start: ByteReader, planes: Uint8Array[], large: ByteReader): void {
    let moves = 0; // of the bodies before
    for (let body = 0; body < this.bodies; body++) {
      const first = this.starts[body];
      const count = this.ends[body] - this.births[body];
      for (let axis = 0; axis < 3; axis++) {
        this.readAxis(planes[axis], moves, large, first, count, axis, start.signedVarint());
      }
      this.readTurns(planes, moves, large, first, count, start);
      let code = 0;
      for (let at = first; at < first + count; at++) {
        const b = planes[6][at];
        code += unzigzag(b < kEscape ? b : large.varint());
        this.forces[at] = code;
      }
      moves += count - 1;
    }
  }

  private readAxis(plane: Uint8Array, at: number, large: ByteReader, first: number, count: number, axis: number, place: number): void {
    const { positions } = this;
    const step = this.meta.positionStep;
    let last = place;
    let move = 0;
    positions[first * 3 + axis] = place * step;
    for (let f = 1; f < count; f++) {
      const b = plane[at++];
      if (b !== 0) move += unzigzag(b < kEscape ? b : large.varint());
      last += move;
      positions[(first + f) * 3 + axis] = last * step;
    }
  }

  // The same arithmetic as the writer's, so that both arrive at the same rotation: turned on by whole steps of
  // tan(angle / 2), each frame.
  private readTurns(planes: Uint8Array[], at: number, large: ByteReader, first: number, count: number, start: ByteReader): void {
    const step = this.meta.turnStep;
    let x = start.signedVarint();
    let y = start.signedVarint();
    let z = start.signedVarint();
    let w = start.signedVarint();
    let s = 1 / Math.sqrt(x * x + y * y + z * z + w * w);
    x *= s; y *= s; z *= s; w *= s;
    let tx = 0;
    let ty = 0;
    let tz = 0;
    this.setRotation(first, x, y, z, w);
    for (let f = 1; f < count; f++, at++) {
      const bx = planes[3][at];
      const by = planes[4][at];
      const bz = planes[5][at];
      if (bx !== 0) tx += unzigzag(bx < kEscape ? bx : large.varint());
      if (by !== 0) ty += unzigzag(by < kEscape ? by : large.varint());
      if (bz !== 0) tz += unzigzag(bz < kEscape ? bz : large.varint());
      if (tx !== 0 || ty !== 0 || tz !== 0) {
        const a = tx * step;
        const b = ty * step;
        const c = tz * step;
        const nx = x + a * w + b * z - c * y;
        const ny = y - a * z + b * w + c * x;
        const nz = z + a * y - b * x + c * w;
        const nw = w - a * x - b * y - c * z;
        s = 1 / Math.sqrt(nx * nx + ny * ny + nz * nz + nw * nw);
        x = nx * s; y = ny * s; z = nz * s; w = nw * s;
      }
      if (tx !== 0 || ty !== 0 || tz !== 0) this.setRotation(first + f, x, y, z, w);
      else this.rotations.copyWithin((first + f) * 4, (first + f - 1) * 4, (first + f) * 4);
    }
  }

  private setRotation(place: number, x: number, y: number, z: number, w: number): void {
    const at = place * 4;
    this.rotations[at] = Math.round(x * kQuatScale);
    this.rotations[at + 1] = Math.round(y * kQuatScale);
    this.rotations[at + 2] = Math.round(z * kQuatScale);
    this.rotations[at + 3] = Math.round(w * kQuatScale);
  }

  private readHits(reader: ByteReader): void {
    const count = reader.varint();
    const column = (read: () => number): number[] => Array.from({ length: count }, read);
    const steps = column(() => reader.varint());
    const a = column(() => reader.varint());
    const b = column(() => reader.varint());
    const x = column(() => reader.signedVarint());
    const y = column(() => reader.signedVarint());
    const z = column(() => reader.signedVarint());
    const impulse = column(() => reader.f32());
    let frame = 0;
    for (let k = 0; k < count; k++) {
      frame += steps[k];
      const at = this.at(frame, a[k]) * 3;
      const p = this.positions;
      this.hits.push({
        frame, a: a[k], b: b[k], impulse: impulse[k],
        point: [p[at] + x[k] * 1e-3, p[at + 1] + y[k] * 1e-3, p[at + 2] + z[k] * 1e-3],
      });
    }
  }

  private readMortar(reader: ByteReader): void {
    for (const _ of this.meta.mortar ?? []) {
      this.mortarFrames.push([]);
      this.mortarStates.push([]);
    }
    if (this.mortarFrames.length === 0) return;
    for (let f = 0; f < this.frames; f++) {
      let joint = 0;
      for (let count = reader.varint(); count > 0; count--) {
        joint += reader.varint();
        this.mortarFrames[joint].push(f);
        this.mortarStates[joint].push([reader.u8(), reader.u8()]);
      }
    }
  }

  // Utilisation and damage of a joint, 0 .. 1 each; null: it is not there.
  mortar(frame: number, joint: number): [number, number] | null {
    const meta = this.meta.mortar![joint];
    if (frame < (meta.birth ?? 0) || frame >= (meta.end ?? this.frames)) return null;
    const frames = this.mortarFrames[joint];
    let low = 0;
    let high = frames.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (frames[middle] <= frame) low = middle + 1;
      else high = middle;
    }
    if (low === 0) return [0, 0];
    const state = this.mortarStates[joint][low - 1];
    return [state[0] / 255, state[1] / 255];
  }

  // What the colour scales and the timeline need.
  private measure(): void {
    const speeds = new Uint32Array(512); // histogram, 0.1 m/s each
    let moving = 0;
    const counts = this.meta.bodies.map((body) => body.role !== 'ball' && body.role !== 'ground');
    const squares = new Float64Array(this.frames);
    for (let body = 0; body < this.bodies; body++) {
      if (!counts[body]) continue;
      for (let f = this.births[body]; f < this.ends[body]; f++) {
        const speed = this.speed(f, body);
        if (speed <= kSeenSpeed) continue;
        speeds[Math.min(511, Math.floor(speed * 10))]++;
        moving++;
        squares[f] += Math.min(speed, 100) ** 2;
      }
    }
    for (let f = 0; f < this.frames; f++) this.activity[f] = Math.sqrt(squares[f]);
    let below = 0;
    let bin = 0;
    while (bin < 511 && (below += speeds[bin]) < 0.95 * moving) bin++;
    this.topSpeed = Math.max(1, Math.ceil((bin + 1) / 5) / 2);
    let code = 0;
    for (let body = 0; body < this.bodies; body++) {
      if (!counts[body]) continue;
      const last = this.at(this.frames, body);
      for (let at = this.starts[body]; at <= last; at++) code = Math.max(code, this.forces[at]);
    }
    this.topForce = Math.max(10, this.forceOfCode(code));
  }

  forceOfCode(code: number): number {
    return 2 ** (code / this.meta.forceSteps) - 1;
  }
  force(frame: number, body: number): number {
    return this.isThere(frame, body) ? this.forceOfCode(this.forces[this.at(frame, body)]) : 0;
  }
  // m/s, from the frame before to this one.
  speed(frame: number, body: number): number {
    if (!this.isThere(frame, body) || this.ends[body] - this.births[body] < 2) return 0;
    const f = Math.max(frame, this.births[body] + 1); // its first frame has none before: as in the next
    const p = this.positions;
    const now = this.at(f, body) * 3;
    const last = now - 3;
    const x = p[now] - p[last];
    const y = p[now + 1] - p[last + 1];
    const z = p[now + 2] - p[last + 2];
    return Math.sqrt(x * x + y * y + z * z) / (this.times[f] - this.times[f - 1] || 1); // Math.hypot is many times slower
  }
  position(frame: number, body: number): [number, number, number] {
    const at = this.at(frame, body) * 3;
    return [this.positions[at], this.positions[at + 1], this.positions[at + 2]];
  }
  rotation(frame: number, body: number): [number, number, number, number] {
    const at = this.at(frame, body) * 4;
    const r = this.rotations;
    return [r[at] / kQuatScale, r[at + 1] / kQuatScale, r[at + 2] / kQuatScale, r[at + 3] / kQuatScale];
  }
}
