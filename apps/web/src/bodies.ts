// The bodies: one instanced mesh for each shape and look, whose instances are set from the take's frames.
import {
  Box3, BufferGeometry, Color, InstancedBufferAttribute, InstancedMesh, LineBasicMaterial, LineSegments, EdgesGeometry, Matrix4,
  Mesh, MeshStandardMaterial, Quaternion, Raycaster, Scene, Vector2, Vector3,
} from 'three';
import type { Camera } from 'three';
import { chance, forceShare, materialColour, scaleColour, speedShare, type ColourMode } from './colours';
import { geometryOf } from './geometry';
import { kindOf, type Kind } from './materials';
import { groundMaterial } from './stage';
import type { PartMeta, ShapeMeta, Take } from './tracks';

interface Group {
  mesh: InstancedMesh;
  shape: ShapeMeta;
  bodies: number[]; // per instance
  locals: (Matrix4 | null)[]; // per instance: the part's place in its body
}

// Fired clay, close up (concrete and stone are like it, but `fired` less): grain, dark inclusions, a little relief, and edges that are darker than faces.
function clayMaterial(half: [number, number, number] | undefined, fired: number): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ color: '#ffffff', roughness: 0.93, metalness: 0 });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uHalf = { value: new Vector3(...(half ?? [0, 0, 0])) };
    shader.uniforms.uFired = { value: fired };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nattribute float seed;\nvarying vec3 vLocal;\nvarying float vSeed;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvLocal = position;\nvSeed = seed;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        uniform vec3 uHalf;
        uniform float uFired;
        varying vec3 vLocal;
        varying float vSeed;
        float clayHash(vec3 p) { p = fract(p * 0.1031); p += dot(p, p.zyx + 31.32); return fract((p.x + p.y) * p.z); }
        float clayNoise(vec3 p) {
          vec3 i = floor(p), f = fract(p); f = f * f * (3.0 - 2.0 * f);
          return mix(mix(mix(clayHash(i), clayHash(i + vec3(1, 0, 0)), f.x), mix(clayHash(i + vec3(0, 1, 0)), clayHash(i + vec3(1, 1, 0)), f.x), f.y),
                     mix(mix(clayHash(i + vec3(0, 0, 1)), clayHash(i + vec3(1, 0, 1)), f.x), mix(clayHash(i + vec3(0, 1, 1)), clayHash(i + vec3(1, 1, 1)), f.x), f.y), f.z);
        }
        float clayRelief = 0.0;`)
      .replace('#include <color_fragment>', `#include <color_fragment>
        {
          vec3 q = vLocal + vec3(13.7, 5.1, 9.3) * vSeed;
          float pixel = length(fwidth(vLocal));
          float fineShown = 1.0 - smoothstep(0.0015, 0.006, pixel);
          float coarse = clayNoise(q * 26.0), fine = clayNoise(q * 240.0), pit = clayNoise(q * 170.0 + 3.0);
          clayRelief = fineShown * (fine * 0.6 + smoothstep(0.6, 0.94, pit) * -0.9);
          float bloom = smoothstep(0.35, 0.9, clayNoise(q * 9.0 + 11.0)); // salts and lime that came to the face
          float bed = clayNoise(q * vec3(14.0, 60.0, 60.0));
          float shade = 0.84 + 0.22 * coarse + 0.1 * bed + fineShown * 0.2 * (fine - 0.5) - fineShown * 0.26 * smoothstep(0.58, 0.92, pit);
          diffuseColor.rgb *= mix(1.0, shade, 0.5 + 0.5 * uFired);
          float grey = dot(diffuseColor.rgb, vec3(0.3, 0.5, 0.2));
          diffuseColor.rgb = mix(diffuseColor.rgb, vec3(grey) * vec3(1.12, 1.0, 0.9), uFired * (0.2 + 0.22 * bloom)) * (1.0 + 0.12 * bloom * uFired);
          if (uHalf.x > 0.0) {
            vec3 d = uHalf - abs(vLocal);
            float edge = max(min(d.x, d.y), min(max(d.x, d.y), d.z)); // the middle one of the three
            diffuseColor.rgb *= mix(0.55, 1.0, smoothstep(0.0, 0.0045 + pixel, edge + 0.0008));
          }
        }`)
      .replace('#include <normal_fragment_maps>', `#include <normal_fragment_maps>
        {
          vec3 sx = dFdx(-vViewPosition), sy = dFdy(-vViewPosition);
          vec3 r1 = cross(sy, normal), r2 = cross(normal, sx);
          float det = dot(sx, r1), h = clayRelief * 0.0007;
          normal = normalize(abs(det) * normal - sign(det) * (dFdx(h) * r1 + dFdy(h) * r2));
        }`);
  };
  return material;
}

function localMatrix(part: PartMeta): Matrix4 | null {
  if (!part.position || !part.rotation) return null;
  return new Matrix4().compose(new Vector3(...part.position), new Quaternion(...part.rotation), new Vector3(1, 1, 1));
}

export class Bodies {
  private readonly groups: Group[] = [];
  private readonly byMesh = new Map<unknown, Group>();
  private readonly outline: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly raycaster = new Raycaster();
  private mode: ColourMode = 'material';
  private coloursStale = true; // those of the materials do not change from frame to frame
  private readonly materialColours: Color[];
  private shownFrame = 0;
  selected = -1;

  constructor(private readonly take: Take, private readonly scene: Scene) {
    this.materialColours = take.meta.bodies.map((_, body) => materialColour(take, body, new Color()));
    const members = new Map<string, { body: number; part: PartMeta }[]>();
    take.meta.bodies.forEach((meta, body) => {
      for (const [k, part] of meta.parts.entries()) {
        if (take.meta.shapes[part.shape].type === 'plane') continue;
        const key = `${part.shape} ${kindOf(meta, k)} ${meta.role === 'ground'}`;
        const list = members.get(key) ?? [];
        list.push({ body, part });
        members.set(key, list);
      }
    });
    for (const [key, list] of members) this.addGroup(Number(key.split(' ')[0]), key.split(' ')[1] as Kind, list);
    this.outline = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: '#ffe27a', depthTest: false, transparent: true }));
    this.outline.visible = false;
    this.outline.renderOrder = 5;
    scene.add(this.outline);
  }

  private materialOf(kind: Kind, shape: ShapeMeta): MeshStandardMaterial {
    switch (kind) {
      case 'steel': return new MeshStandardMaterial({ roughness: 0.24, metalness: 0.8, envMap: this.scene.environment, envMapIntensity: 1.5 }); // the sky in it
      case 'plain': return new MeshStandardMaterial({ roughness: 0.62, metalness: 0 });
      case 'rubber': return new MeshStandardMaterial({ roughness: 0.5, metalness: 0 });
      case 'concrete': case 'stone': case 'wood': case 'ground': return clayMaterial(shape.half, 0); // earth that is no floor, too
      case 'brick': return clayMaterial(shape.half, 1);
    }
  }

  private addGroup(shapeIndex: number, kind: Kind, list: { body: number; part: PartMeta }[]): void {
    const shape = this.take.meta.shapes[shapeIndex];
    const geometry = geometryOf(shape);
    if (!geometry) return;
    const isFloor = this.take.meta.bodies[list[0].body].role === 'ground';
    const material = isFloor ? groundMaterial() : this.materialOf(kind, shape);
    geometry.setAttribute('seed', new InstancedBufferAttribute(new Float32Array(list.map(({ body }) => chance(body, 9))), 1));
    const mesh = new InstancedMesh(geometry, material, list.length);
    mesh.castShadow = !isFloor;
    mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    const group = { mesh, shape, bodies: list.map(({ body }) => body), locals: list.map(({ part }) => localMatrix(part)) };
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
    for (const { mesh, bodies, locals } of this.groups) {
      for (let k = 0; k < bodies.length; k++) {
        if (this.isShown(bodies[k])) {
          this.pose(bodies[k], position, scratch.matrix);
          const local = locals[k];
          if (local) scratch.matrix.multiply(local);
        } else {
          scratch.matrix.makeScale(0, 0, 0);
        }
        scratch.matrix.toArray(mesh.instanceMatrix.array, k * 16);
        if (recolour) mesh.setColorAt(k, this.colourOf(bodies[k], frame));
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

  private colourOf(body: number, frame: number): Color {
    const { take } = this;
    if (this.mode === 'material' || take.meta.bodies[body].role === 'ground') return this.materialColours[body];
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
    const local = localMatrix(part);
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
