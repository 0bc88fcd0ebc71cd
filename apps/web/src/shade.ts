// Less light from the sky where bodies meet. Depth and facing of what is seen are drawn once more, ahead of the picture, and from
// them three.js finds how open each point is (ground-truth ambient occlusion). Materials read both: how open a point is takes from
// the light of the sky, and with the depth a brick sees whether something goes on beyond its edge, which makes the edge a joint.
// What the device does not keep up with is left out by levels; the joints stay.
import { Color, DepthFormat, DepthTexture, Line, MeshNormalMaterial, NearestFilter, Points, UnsignedIntType, Vector2, WebGLRenderTarget } from 'three';
import type { PerspectiveCamera, Scene, WebGLProgramParametersWithUniforms, WebGLRenderer } from 'three';
import { GTAOPass } from 'three/examples/jsm/postprocessing/GTAOPass.js';
import { generateMagicSquareNoise } from 'three/examples/jsm/shaders/GTAOShader.js';

export const kMostShade = 2; // the finest level; 1: half as fine each way; 0: joints alone
const kMostPixels = 1.1e6; // of the finest level: a screen of today without its double resolution
const kSlowMilliseconds = 42; // from frame to frame, on average: then the next level below
const kFramesToJudge = 24;
const kTowardsCamera = 0x7f7fff; // as a normal's colour

export class Shade {
  readonly uniforms = {
    shadeMap: { value: null as unknown }, // 1 = open
    shadeDepth: { value: null as unknown },
    shadeSize: { value: new Vector2(1, 1) }, // pixels of both
    shadeScale: { value: new Vector2(1, 1) }, // from a pixel of the picture to 0 .. 1
    shadeLens: { value: new Vector2(1, 1) }, // of the projection: from slope to -1 .. 1
    shadeRange: { value: new Vector2(0.1, 1000) }, // m, near and far
    shadeShare: { value: 0 },
    shadeReach: { value: 0.15 }, // m
  };
  private isHeld = false;
  private readonly seen: WebGLRenderTarget;
  private readonly pass: GTAOPass;
  private readonly facing = new MeshNormalMaterial();
  private readonly canvasSize = new Vector2();
  private spent = 0;
  private judged = 0;

  // level: at which it begins.
  constructor(private readonly renderer: WebGLRenderer, private readonly scene: Scene, private readonly camera: PerspectiveCamera, private level: number) {
    const depthTexture = new DepthTexture(1, 1, UnsignedIntType);
    depthTexture.format = DepthFormat;
    this.seen = new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter, depthTexture });
    this.pass = new GTAOPass(scene, camera, 1, 1, { depthTexture, normalTexture: this.seen.texture });
    this.pass.output = GTAOPass.OUTPUT.Off;
    this.pass.gtaoMaterial.fragmentShader = weighed(this.pass.gtaoMaterial.fragmentShader);
    // Its own noise is thrown anew on each visit; one take shall give one picture.
    this.pass.pdMaterial.uniforms.tNoise.value = generateMagicSquareNoise();
    this.pass.updatePdMaterial({ lumaPhi: 10, depthPhi: 0.02, normalPhi: 3, radius: 4, rings: 2, samples: 12 });
    this.uniforms.shadeMap.value = this.pass.gtaoMap;
    this.uniforms.shadeDepth.value = depthTexture;
  }

  // How far things darken each other, m: about the size of a brick.
  setReach(reach: number): void {
    this.uniforms.shadeReach.value = reach;
    this.pass.updateGtaoMaterial({ radius: reach, distanceExponent: 1.6, thickness: reach, distanceFallOff: 0.5, scale: 1.3, samples: 12 });
  }

  // Stays at a level, whatever it costs.
  hold(level: number): void {
    this.level = Math.min(kMostShade, Math.max(0, Math.round(level)));
    this.isHeld = true;
  }

  // milliseconds: from the frame before to this one, while frames follow each other.
  judge(milliseconds: number): void {
    if (this.isHeld || this.level === 0) return;
    this.spent += Math.min(milliseconds, 120); // one picture that took long says nothing: a shader was made, a tab had slept
    if (++this.judged < kFramesToJudge) return;
    if (this.spent / this.judged > kSlowMilliseconds) this.level--;
    this.spent = this.judged = 0;
  }

  // Before the picture itself.
  render(): void {
    const { renderer, uniforms, camera } = this;
    this.fit();
    const colour = renderer.getClearColor(new Color());
    const alpha = renderer.getClearAlpha();
    renderer.setRenderTarget(this.seen);
    renderer.setClearColor(kTowardsCamera, 1);
    this.scene.overrideMaterial = this.facing;
    const hidden = this.scene.children.filter((child) => child.visible && (child instanceof Points || child instanceof Line)); // dust, outline
    for (const child of hidden) child.visible = false;
    renderer.render(this.scene, camera);
    for (const child of hidden) child.visible = true;
    this.scene.overrideMaterial = null;
    uniforms.shadeShare.value = this.level > 0 ? 1 : 0;
    if (this.level > 0) this.pass.render(renderer, this.seen, this.seen, 0, false);
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
    uniforms.shadeLens.value.set(camera.projectionMatrix.elements[0], camera.projectionMatrix.elements[5]);
    uniforms.shadeRange.value.set(camera.near, camera.far);
  }

  private fit(): void {
    const canvas = this.renderer.domElement;
    this.canvasSize.set(canvas.clientWidth, canvas.clientHeight);
    const pixels = this.canvasSize.x * this.canvasSize.y;
    const share = Math.min(1, Math.sqrt(kMostPixels / Math.max(1, pixels))) * (this.level < kMostShade ? 0.5 : 1);
    const width = Math.max(1, Math.round(this.canvasSize.x * share));
    const height = Math.max(1, Math.round(this.canvasSize.y * share));
    if (this.seen.width !== width || this.seen.height !== height) {
      this.seen.setSize(width, height);
      this.pass.setSize(width, height);
    }
    this.uniforms.shadeSize.value.set(width, height);
    this.uniforms.shadeScale.value.set(1 / canvas.width, 1 / canvas.height);
  }

  // A material whose shader goes through this receives the shade. Its shader says where it looks it up: `shadeAt`, 0 .. 1 each way.
  receive(shader: WebGLProgramParametersWithUniforms): void {
    Object.assign(shader.uniforms, this.uniforms);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\n${kShadeInputs}`)
      .replace('#include <aomap_fragment>', `#include <aomap_fragment>
        {
          // Far away it is finer than a pixel.
          float shown = smoothstep(3.0, 8.0, shadeReach * shadeLens.y * shadeSize.y * 0.5 / vViewPosition.z);
          float open = mix(1.0, texture2D(shadeMap, shadeAt).r, shadeShare * shown);
          reflectedLight.indirectDiffuse *= open;
          reflectedLight.indirectSpecular *= mix(1.0, open, 0.8);
          reflectedLight.directDiffuse *= mix(1.0, open, 0.45); // the sun is no point, and a crack hides half of it
        }`);
  }
}

// three.js adds up how open a point is over slices through it, each as if the face stood upright in it. Of ground that is seen at a
// flat angle the slices come to more than all there is, so that it stays light at the foot of whatever stands on it. Here each counts
// by how upright the face is in it, and the sum is taken as a share of that with nothing around.
function weighed(shader: string): string {
  const changes: [string, string][] = [
    ['void main() {', `float openIn(vec2 c, float nx, float ny) {
        vec2 s = sqrt(1.0 - c * c);
        return nx * 0.5 * (acos(c.y) - acos(c.x) + s.x * c.x - s.y * c.y) + ny * 0.5 * (2.0 - dot(c, c));
      }
      void main() {`],
    ['float ao = 0.0;', 'float ao = 0.0, whole = 0.0;'],
    ['vec2 sinHorizons =', 'vec2 openHorizons = vec2(dot(viewDir, tangentToNormalInSlice), dot(viewDir, -tangentToNormalInSlice)), sinHorizons ='],
    ['ao += occlusion;', `float upright = length(viewNormal - sliceBitangent * dot(viewNormal, sliceBitangent));
      whole += upright * openIn(openHorizons, nx, ny);
      ao += upright * occlusion;`],
    ['ao / float(DIRECTIONS)', 'ao / max(whole, 1e-4)'],
  ];
  for (const [from, to] of changes) {
    if (shader.split(from).length !== 2) throw new Error(`three.js has another shader for the shade: "${from}"`);
    shader = shader.replace(from, to);
  }
  return shader;
}

const kShadeInputs = `
  uniform sampler2D shadeMap;
  uniform highp sampler2D shadeDepth;
  uniform vec2 shadeSize, shadeScale, shadeLens, shadeRange;
  uniform float shadeShare, shadeReach;
  vec2 shadePixel(vec3 p) { return (shadeLens * p.xy / -p.z * 0.5 + 0.5) * shadeSize; }`;

// 0 .. 1: whether the edge of a face is a joint: whether something goes on beyond it, level with the face or before it. `here`: the
// point that is drawn, in the camera's frame; `facing`: of its face; `outward`: from the edge, in the face; `toEdge`: m;
// `below`: m, of the face; `least`: m, half of the smallest side of the brick.
// It looks into the depth a little beyond the edge. A lone brick has its own next face there, which ends at the edge; ground at
// its foot stands before the face.
export const kJointFunction = `
  float goesOnAt(vec2 at, vec3 here, vec3 facing, vec3 outward, float toEdge, float below, float beyond) {
    float z = -shadeRange.x * shadeRange.y / (shadeRange.y - texelFetch(shadeDepth, ivec2(at), 0).r * (shadeRange.y - shadeRange.x));
    vec3 there = vec3(((floor(at) + 0.5) / shadeSize * 2.0 - 1.0) / shadeLens * -z, z) - here;
    float along = dot(there, outward) - toEdge, before = dot(there, facing) - below;
    float doubt = 0.0008 + 1e-6 * z * z; // m, of the depth
    float goesOn = smoothstep(0.2, 0.5, along / beyond) * (1.0 - smoothstep(0.005, 0.012, -before - doubt));
    float stands = smoothstep(1.0, 3.0, before / doubt);
    stands *= smoothstep(-0.35, -0.1, along / beyond); // beyond the edge, not on this side of it
    return max(goesOn, stands) * (1.0 - smoothstep(0.05, 0.1, before - 0.5 * beyond));
  }
  float jointShare(vec3 here, vec3 facing, vec3 outward, float toEdge, float below, float least) {
    float beyond = 0.006;
    vec3 edge = here + outward * toEdge;
    vec2 from = shadePixel(edge), step = shadePixel(edge + outward * beyond) - from;
    // Not less than a pixel and a half of the depth, or it would see the face itself.
    float longer = max(1.0, 1.6 / max(length(step), 1e-3));
    vec2 at = from + step * longer, aside = vec2(-step.y, step.x) / max(length(step), 1e-3);
    if (beyond * longer > max(0.06, least) || any(lessThan(at, vec2(1.0))) || any(greaterThanEqual(at, shadeSize - 1.0))) return 0.0;
    beyond *= longer;
    // Three looks, so that the pixels of the depth do not show.
    return (goesOnAt(at, here, facing, outward, toEdge, below, beyond) + goesOnAt(at + aside, here, facing, outward, toEdge, below, beyond)
      + goesOnAt(at - aside, here, facing, outward, toEdge, below, beyond)) / 3.0;
  }`;
