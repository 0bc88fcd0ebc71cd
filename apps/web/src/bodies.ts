// The bodies: one instanced mesh for each shape and look (one for boxes of all sizes), whose instances are set from the take's frames.
import {
  Box3, BufferGeometry, CircleGeometry, Color, InstancedBufferAttribute, InstancedMesh, LineBasicMaterial, LineSegments, EdgesGeometry, Matrix4,
  Mesh, MeshStandardMaterial, Quaternion, Raycaster, Scene, Vector2, Vector3,
} from 'three';
import type { Camera } from 'three';
import { chance, forceShare, kBehindMortar, lookNumber, materialColour, scaleColour, speedShare, type ColourMode } from './colours';
import { geometryOf } from './geometry';
import { kindOf } from './materials';
import type { Stage } from './stage';
import { surfaceOf } from './surfaces';
import type { BodyMeta, PartMeta, ShapeMeta, Take } from './tracks';

interface Group {
  mesh: InstancedMesh;
  bodies: number[]; // per instance
  locals: (Matrix4 | null)[]; // per instance: the part's place in its body, and of a box its half size
  colours: Color[]; // per instance, of its material
}
interface PlaneSheet {
  mesh: Mesh;
  body: number;
  local: Matrix4 | null;
}
const kPlaneReach = 400; // m: of a plane, which has no end, as much is drawn around its body

function localMatrix(part: PartMeta, shape?: ShapeMeta): Matrix4 | null {
  if ((!part.position || !part.rotation) && !shape?.half) return null;
  return new Matrix4().compose(new Vector3(...(part.position ?? [0, 0, 0])), new Quaternion(...(part.rotation ?? [0, 0, 0, 1])), new Vector3(...(shape?.half ?? [1, 1, 1])));
}

export class Bodies {
  private readonly groups: Group[] = [];
  private readonly byMesh = new Map<unknown, Group>();
  private readonly outline: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly raycaster = new Raycaster();
  private mode: ColourMode = 'material';
  private coloursStale = true; // those of the materials do not change from frame to frame
  private readonly sheets: PlaneSheet[] = [];
  private shownFrame = 0;
  selected = -1;

  constructor(private readonly take: Take, private readonly scene: Scene, private readonly stage: Stage) {
    const members = new Map<string, { body: number; part: number }[]>();
    take.meta.bodies.forEach((meta, body) => {
      for (const [k, part] of meta.parts.entries()) {
        const { type } = take.meta.shapes[part.shape];
        if (type === 'plane') {
          this.addPlane(body, k);
          continue;
        }
        const key = `${type === 'box' ? type : part.shape} ${kindOf(meta, k)} ${meta.role === 'ground'}`;
        const list = members.get(key) ?? [];
        list.push({ body, part: k });
        members.set(key, list);
      }
    });
    for (const list of members.values()) this.addGroup(list);
    this.outline = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: '#ffe27a', depthTest: false, transparent: true }));
    this.outline.visible = false;
    this.outline.renderOrder = 5;
    scene.add(this.outline);
  }

  get meshes(): number {
    return this.groups.length + this.sheets.length;
  }

  private addPlane(body: number, k: number): void {
    const meta = this.take.meta.bodies[body];
    const material = this.materialOf(meta, k, false, true);
    materialColour(this.take, body, k, material.color);
    const mesh = new Mesh(new CircleGeometry(kPlaneReach, 64).rotateX(-Math.PI / 2), material);
    mesh.receiveShadow = true;
    mesh.matrixAutoUpdate = false;
    this.sheets.push({ mesh, body, local: localMatrix(meta.parts[k]) });
    this.scene.add(mesh);
  }

  private materialOf(meta: BodyMeta, k: number, isBox: boolean, isPlane: boolean): MeshStandardMaterial {
    const kind = kindOf(meta, k);
    return surfaceOf(kind, isBox, isPlane && kind === 'ground', this.stage);
  }

  private addGroup(list: { body: number; part: number }[]): void {
    const { shapes, bodies } = this.take.meta;
    const first = bodies[list[0].body];
    const shape = shapes[first.parts[list[0].part].shape];
    const geometry = geometryOf(shape);
    if (!geometry) return;
    const material = this.materialOf(first, list[0].part, shape.type === 'box', false);
    geometry.setAttribute('seed', new InstancedBufferAttribute(new Float32Array(list.map(({ body }) => chance(lookNumber(this.take.meta, body), 9))), 1));
    const mesh = new InstancedMesh(geometry, material, list.length);
    mesh.castShadow = first.role !== 'ground';
    mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    const group = {
      mesh, bodies: list.map(({ body }) => body),
      locals: list.map(({ body, part }) => localMatrix(bodies[body].parts[part], shapes[bodies[body].parts[part].shape])),
      colours: list.map(({ body, part }) => materialColour(this.take, body, part, new Color())),
    };
    this.groups.push(group);
    this.byMesh.set(mesh, group);
    this.scene.add(mesh);
  }

  // Between two frames that is there which was in the first.
  private isShown(body: number): boolean {
    return this.take.isThere(this.shownFrame, body);
  }

  // The pose at a place between two frames.
  pose(body: number, position: number, out: Matrix4): Matrix4 {
    const { take } = this;
    const f = Math.min(take.frames - 1, Math.floor(position));
    const next = Math.min(take.frames - 1, f + 1);
    const share = position - f;
    const p = take.positions;
    const r = take.rotations;
    const here = take.at(f, body);
    const there = take.at(next, body);
    const a = here * 3;
    const b = there * 3;
    const c = here * 4;
    const d = there * 4;
    const side = r[c] * r[d] + r[c + 1] * r[d + 1] + r[c + 2] * r[d + 2] + r[c + 3] * r[d + 3] < 0 ? -share : share;
    const keep = 1 - share;
    scratch.rotation.set(r[c] * keep + r[d] * side, r[c + 1] * keep + r[d + 1] * side, r[c + 2] * keep + r[d + 2] * side,
      r[c + 3] * keep + r[d + 3] * side).normalize();
    scratch.position.set(p[a] * keep + p[b] * share, p[a + 1] * keep + p[b + 1] * share, p[a + 2] * keep + p[b + 2] * share);
    return out.compose(scratch.position, scratch.rotation, scratch.one);
  }

  show(position: number): void {
    const frame = Math.round(position);
    this.shownFrame = Math.min(this.take.frames - 1, Math.floor(position));
    const recolour = this.coloursStale || this.mode !== 'material';
    this.coloursStale = false;
    for (const { mesh, body, local } of this.sheets) {
      this.pose(body, position, mesh.matrix);
      if (local) mesh.matrix.multiply(local);
      mesh.visible = this.isShown(body);
    }
    for (const { mesh, bodies, locals, colours } of this.groups) {
      for (let k = 0; k < bodies.length; k++) {
        if (this.isShown(bodies[k])) {
          this.pose(bodies[k], position, scratch.matrix);
          const local = locals[k];
          if (local) scratch.matrix.multiply(local);
        } else {
          scratch.matrix.makeScale(0, 0, 0);
        }
        scratch.matrix.toArray(mesh.instanceMatrix.array, k * 16);
        if (recolour) mesh.setColorAt(k, this.colourOf(bodies[k], frame) ?? colours[k]);
      }
      mesh.instanceMatrix.needsUpdate = true;
      if (recolour && mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
      mesh.boundingSphere = null; // picking measures it anew
    }
    this.outline.visible = this.selected >= 0 && this.isShown(this.selected) && this.take.meta.bodies[this.selected].role !== 'ground';
    if (this.outline.visible) {
      this.pose(this.selected, position, this.outline.matrix);
      this.outline.matrixAutoUpdate = false;
    }
  }

  // Of the scale that is chosen; null: that of the material.
  private colourOf(body: number, frame: number): Color | null {
    const { take } = this;
    if (this.mode === 'material' || take.meta.bodies[body].role === 'ground') return null;
    if (this.mode === 'utilisation' || this.mode === 'damage') return kBehindMortar;
    if (this.mode === 'speed') return scaleColour(speedShare(take, take.speed(frame, body)), scratch.colour);
    return scaleColour(forceShare(take, take.force(frame, body)), scratch.colour);
  }

  setColourMode(mode: ColourMode): void {
    this.mode = mode;
    this.coloursStale = true;
  }

  select(body: number): void {
    this.selected = body;
    this.outline.geometry.dispose();
    const part = body >= 0 ? this.take.meta.bodies[body].parts[0] : undefined;
    const shape = part && this.take.meta.shapes[part.shape];
    const geometry = shape ? geometryOf(shape) : null;
    if (!geometry || !part) return;
    const local = localMatrix(part, shape);
    if (local) geometry.applyMatrix4(local);
    // Round shapes have no edges to draw: they get those of their box.
    geometry.computeBoundingBox();
    const box = geometry.boundingBox ?? new Box3();
    const half = box.getSize(new Vector3()).multiplyScalar(0.5);
    const centre = box.getCenter(new Vector3());
    this.outline.geometry = shape!.type === 'hull' ? new EdgesGeometry(geometry, 10) : boxEdges(half).translate(centre.x, centre.y, centre.z);
  }

  // The body under a point of the screen (-1 .. 1 each way), -1 = none.
  pick(point: Vector2, camera: Camera): number {
    this.raycaster.setFromCamera(point, camera);
    const hits = this.raycaster.intersectObjects(this.groups.map((group) => group.mesh) as Mesh[], false);
    for (const hit of hits) {
      const group = this.byMesh.get(hit.object);
      if (group && hit.instanceId !== undefined && this.isShown(group.bodies[hit.instanceId])) return group.bodies[hit.instanceId];
    }
    return -1;
  }
}

function boxEdges(half: Vector3): BufferGeometry {
  const points: Vector3[] = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const b of [-1, 1]) for (const c of [-1, 1]) for (const a of [-1, 1]) {
      const p = new Vector3();
      p.setComponent(axis, a).setComponent((axis + 1) % 3, b).setComponent((axis + 2) % 3, c);
      points.push(p.multiply(half).multiplyScalar(1.004));
    }
  }
  return new BufferGeometry().setFromPoints(points);
}

const scratch = {
  matrix: new Matrix4(), position: new Vector3(), rotation: new Quaternion(), one: new Vector3(1, 1, 1), colour: new Color(),
};
