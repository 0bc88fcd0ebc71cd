// Mortar joints as coloured plates, a little larger than the faces that they glue, so that their edges are seen.
import { BoxGeometry, Color, InstancedMesh, Matrix4, MeshBasicMaterial, Scene, Vector3 } from 'three';
import type { Bodies } from './bodies';
import { scaleColour, type ColourMode } from './colours';
import type { Take } from './tracks';

const kThick = 0.2; // of the smaller half edge
const kWider = 1.03;

export class Mortar {
  private readonly mesh: InstancedMesh | null = null;
  private readonly places: Matrix4[] = [];
  private mode: ColourMode = 'material';

  constructor(private readonly take: Take, private readonly bodies: Bodies, scene: Scene) {
    const joints = take.meta.mortar ?? [];
    if (joints.length === 0) return;
    this.mesh = new InstancedMesh(new BoxGeometry(2, 2, 2), new MeshBasicMaterial({ toneMapped: false }), joints.length);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    scene.add(this.mesh);
    for (const joint of joints) {
      const u = new Vector3(...joint.along1);
      const v = new Vector3(...joint.along2);
      const thick = 0.5 * kThick * Math.min(u.length(), v.length());
      const n = u.clone().cross(v).setLength(thick);
      this.places.push(new Matrix4().makeBasis(u.multiplyScalar(kWider), v.multiplyScalar(kWider), n).setPosition(...joint.centre));
    }
  }

  setColourMode(mode: ColourMode): void {
    this.mode = mode;
    if (this.mesh) this.mesh.visible = mode === 'utilisation' || mode === 'damage';
  }

  show(position: number): void {
    const { mesh, take } = this;
    if (!mesh?.visible) return;
    const frame = Math.round(position);
    for (let k = 0; k < this.places.length; k++) {
      const state = take.mortar(frame, k);
      // Broken mortar bears nothing.
      if (!state || (this.mode === 'utilisation' && state[1] >= 1)) {
        scratch.matrix.makeScale(0, 0, 0);
      } else {
        this.bodies.pose(take.meta.mortar![k].a, position, scratch.matrix).multiply(this.places[k]);
        mesh.setColorAt(k, scaleColour(state[this.mode === 'damage' ? 1 : 0], scratch.colour));
      }
      mesh.setMatrixAt(k, scratch.matrix);
    }
    mesh.instanceMatrix.needsUpdate = true;
    if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
  }
}

const scratch = { matrix: new Matrix4(), colour: new Color() };
