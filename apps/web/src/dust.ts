// Puffs of dust where bodies hit. They depend on the time alone, not on what was shown before, so scrubbing shows them too.
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, NormalBlending, Points, Scene, ShaderMaterial } from 'three';
import { chance, materialColour } from './colours';
import type { Hit, Take } from './tracks';

const kSeconds = 1.3;
const kMostPuffs = 160;
const kParticles = 7; // per puff
const kPale = new Color().setRGB(0.56, 0.5, 0.44);
const kPaleness = 0.5;
const scratch = new Color();

export class Dust {
  private readonly points: Points<BufferGeometry, ShaderMaterial>;
  private readonly places = new Float32Array(kMostPuffs * kParticles * 3);
  private readonly looks = new Float32Array(kMostPuffs * kParticles * 3); // size in m, opacity, what tells it from others
  private readonly tints = new Float32Array(kMostPuffs * kParticles * 3);
  private readonly hits: Hit[];
  private readonly strength: number; // N s: impulses below a share of it raise no dust

  constructor(private readonly take: Take, scene: Scene) {
    const impulses = take.hits.map((hit) => hit.impulse).sort((a, b) => b - a);
    this.strength = impulses[Math.min(impulses.length - 1, 30)] ?? 1;
    this.hits = take.hits.filter((hit) => hit.impulse > this.strength * 0.08);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('look', new BufferAttribute(this.looks, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute('tint', new BufferAttribute(this.tints, 3).setUsage(DynamicDrawUsage));
    const material = new ShaderMaterial({
      transparent: true,
      depthWrite: false,
      blending: NormalBlending,
      uniforms: { scale: { value: 500 } },
      vertexShader: `attribute vec3 look, tint; varying float vAlpha, vSeed; varying vec3 vTint; uniform float scale;
        void main() {
          vec4 p = modelViewMatrix * vec4(position, 1.0);
          gl_Position = projectionMatrix * p;
          gl_PointSize = min(look.x * scale / -p.z, 400.0);
          vAlpha = look.y;
          vSeed = look.z;
          vTint = tint;
        }`,
      fragmentShader: `varying float vAlpha, vSeed; varying vec3 vTint;
        float dustHash(vec2 p) { vec3 q = fract(vec3(p.xyx) * 0.1031); q += dot(q, q.yzx + 33.33); return fract((q.x + q.y) * q.z); }
        float dustNoise(vec2 p) {
          vec2 i = floor(p), f = fract(p); f = f * f * (3.0 - 2.0 * f);
          return mix(mix(dustHash(i), dustHash(i + vec2(1, 0)), f.x), mix(dustHash(i + vec2(0, 1)), dustHash(i + vec2(1, 1)), f.x), f.y);
        }
        void main() {
          vec2 d = gl_PointCoord * 2.0 - 1.0;
          float a = max(0.0, 1.0 - dot(d, d)), billow = dustNoise(d * 2.3 + vSeed * 17.0) * 0.65 + dustNoise(d * 5.1 + vSeed * 31.0) * 0.35;
          a = a * a * smoothstep(0.25, 0.85, billow + 0.25 * a);
          // Lit from above: brighter on top.
          vec3 light = mix(vec3(0.75, 0.76, 0.78), vec3(1.55, 1.45, 1.3), clamp(0.5 - 0.45 * d.y + 0.2 * billow, 0.0, 1.0));
          gl_FragColor = vec4(vTint * light, vAlpha * a);
          #include <tonemapping_fragment>
          #include <colorspace_fragment>
        }`,
    });
    this.points = new Points(geometry, material);
    this.points.frustumCulled = false;
    this.points.renderOrder = 3;
    scene.add(this.points);
  }

  // pixelsPerRadian: height of the picture over the tangent of its opening.
  show(position: number, pixelsPerRadian: number): void {
    const { take } = this;
    this.points.material.uniforms.scale.value = pixelsPerRadian;
    const now = take.timeAt(position);
    // The latest hits first: they are the ones to show when there are more than fit.
    let k = this.hits.length - 1;
    while (k >= 0 && take.times[this.hits[k].frame] > now) k--;
    let puffs = 0;
    for (; k >= 0 && puffs < kMostPuffs; k--) {
      const age = now - take.times[this.hits[k].frame];
      if (age > kSeconds) break;
      this.put(puffs++, k, age);
    }
    this.points.geometry.setDrawRange(0, puffs * kParticles);
    this.points.geometry.attributes.position.needsUpdate = true;
    this.points.geometry.attributes.look.needsUpdate = true;
    this.points.geometry.attributes.tint.needsUpdate = true;
    this.points.visible = puffs > 0;
  }

  // Of what broke, paler than the whole: of the brick rather than of what hit it.
  private colourOf(hit: Hit): Color {
    const { bodies } = this.take.meta;
    const rank = (body: number): number => ['brick', 'body', 'ground', 'ball'].indexOf(bodies[body].role);
    const body = hit.b >= 0 && rank(hit.b) < rank(hit.a) ? hit.b : hit.a;
    return materialColour(this.take, body, 0, scratch).lerp(kPale, kPaleness);
  }

  private put(puff: number, hitIndex: number, age: number): void {
    const hit = this.hits[hitIndex];
    const force = Math.min(1, Math.sqrt(hit.impulse / this.strength));
    const share = age / kSeconds;
    const spread = 1 - (1 - share) ** 3;
    const tint = this.colourOf(hit);
    for (let n = 0; n < kParticles; n++) {
      const at = puff * kParticles + n;
      const angle = chance(hitIndex, n) * Math.PI * 2;
      const reach = (0.05 + 0.26 * chance(hitIndex, n + 20)) * spread * force;
      this.places[at * 3] = hit.point[0] + Math.cos(angle) * reach;
      this.places[at * 3 + 1] = hit.point[1] + (0.03 + 0.2 * chance(hitIndex, n + 40)) * spread * force;
      this.places[at * 3 + 2] = hit.point[2] + Math.sin(angle) * reach;
      this.looks[at * 3] = (0.12 + 0.34 * spread) * (0.5 + 0.7 * chance(hitIndex, n + 60)) * (0.4 + 0.6 * force);
      this.looks[at * 3 + 2] = chance(hitIndex, n + 80);
      tint.toArray(this.tints, at * 3);
      this.looks[at * 3 + 1] = 0.24 * (1 - share) ** 1.5 * Math.min(1, age * 14 + 0.1) * (0.35 + 0.65 * force);
    }
  }
}
