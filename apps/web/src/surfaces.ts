// The materials of bodies and ground: how rough, how much metal, and shaders with the patterns of their stuff, worn edges, and
// joints where bricks meet.
import { MeshStandardMaterial, ShaderChunk } from 'three';
import { kBevelled } from './geometry';
import { kLightFunctions } from './light';
import { kKinds, type Kind } from './materials';
import { patternsOf } from './patterns';
import { kJointFunction } from './shade';
import { shadowLookup } from './shadows';
import type { Stage } from './stage';

const kArris = 0.0035; // m, of an edge that is rubbed off
const kWearing: Partial<Record<Kind, number>> = { brick: 1, concrete: 1, stone: 1, wood: 0.35 }; // how much; others not at all
const kJoint = 0.1; // of the least half extent, as half of the crack that shows between two bricks; m:
const kLeastJoint = 0.002;
const kMostJoint = 0.012;
const kJointFromAfar = 0.2; // of its darkness stays as long as single bricks can be told

// Sky and ground light all surfaces by the formula of all pictures.
const kFromAround = ShaderChunk.lights_fragment_begin.replace(
  'getAmbientLightIrradiance( ambientLightColor )', 'PI * ambientLight(inverseTransformDirection(normal, viewMatrix), sunTowards)');
if (!kFromAround.includes('sunTowards')) throw new Error('three.js adds up light in another way');

const kVertexInputs = `
  attribute float seed;
  varying vec3 vLocal, vFacing;
  varying float vSeed;
  flat varying mat3 vTurn;
  flat varying vec3 uHalf;`;

const kVertexWork = `
  vFacing = normal;
  vSeed = seed;
  vLocal = position;
  uHalf = vec3(0.0);
  #ifdef USE_INSTANCING
    vTurn = mat3(modelViewMatrix) * mat3(instanceMatrix);
  #else
    vTurn = mat3(modelViewMatrix);
  #endif`;
const kBoxVertexWork = `
  ${kBevelled}
  transformed = onBox;
  vLocal = onBox * boxHalf;
  uHalf = boxHalf;
  vTurn = mat3(vTurn[0] / boxHalf.x, vTurn[1] / boxHalf.y, vTurn[2] / boxHalf.z);`;

// What a box has besides: where its edges are worn, and which of them are joints. Its faces are told by how deep a point lies below
// each; the nearest edge is where the second of them is.
const kBoxWork = `
  vec3 depth = uHalf - abs(vLocal), side = vec3(vLocal.x < 0.0 ? -1.0 : 1.0, vLocal.y < 0.0 ? -1.0 : 1.0, vLocal.z < 0.0 ? -1.0 : 1.0);
  vec3 face = depth.x <= depth.y && depth.x <= depth.z ? vec3(1, 0, 0) : depth.y <= depth.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
  vec3 others = depth + face * 1e3;
  vec3 next = others.x <= others.y && others.x <= others.z ? vec3(1, 0, 0) : others.y <= others.z ? vec3(0, 1, 0) : vec3(0, 0, 1);
  float toEdge = max(0.0, dot(depth, next));
  if (toEdge < 0.02 && uWearing > 0.0) {
    float uneven = noiseAt(vLocal * 45.0 + placeOf(11.0)), rough = noiseAt(vLocal * 160.0 + placeOf(12.0));
    // Here and there a piece of the edge is gone.
    float chipped = smoothstep(0.35, 0.75, noiseAt(vLocal * 28.0 + placeOf(13.0))) * (0.7 + 0.3 * rough);
    float worn = ${kArris} * (1.0 + 0.8 * uneven + 0.4 * rough + 1.6 * chipped);
    wear = (1.0 - smoothstep(0.2 * worn, worn, toEdge)) * seenShare(0.006, pixel);
    edgeSlope = next * side * wear * uWearing * (0.55 + 0.35 * rough + 0.3 * chipped);
  }
  // Along an edge the shade is that of the face beside it: on the edge itself it would be torn by the pixels of its map.
  float inset = max(0.0, 0.0025 + 1.2 * pixel * shadeSize.x * shadeScale.x - toEdge);
  shadeAt = shadePixel(-vViewPosition - vTurn * (next * side) * inset) / shadeSize;
  float least = min(uHalf.x, min(uHalf.y, uHalf.z)), width = clamp(${kJoint} * least, ${kLeastJoint}, ${kMostJoint});
  float crack = width + 0.7 * pixel, dark = max(width / crack, ${kJointFromAfar} * (1.0 - smoothstep(0.2, 0.45, pixel / least)));
  if (toEdge < crack * 1.5) {
    // As a point of the one face and of the other: on the rounded edge, or where one looks into the crack, only one of them is seen.
    float below = max(0.0, dot(depth, face));
    joint = max(jointShare(-vViewPosition, vTurn * (face * side), vTurn * (next * side), toEdge, below, least),
                jointShare(-vViewPosition, vTurn * (next * side), vTurn * (face * side), below, toEdge, least));
    joint *= (below > 1e-4 ? 1.0 : 1.0 - smoothstep(0.25 * crack, 1.5 * crack, toEdge)) * dark;
  }`;

function withSurface(material: MeshStandardMaterial, kind: Kind, isBox: boolean, isFloor: boolean, stage: Stage): MeshStandardMaterial {
  const hasEdges = isBox && kind !== 'ground';
  material.customProgramCacheKey = () => `${kind} ${isBox} ${isFloor}`;
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uWearing = { value: kWearing[kind] ?? 0 };
    shader.uniforms.sunTowards = { value: stage.sunDirection };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${kVertexInputs}`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>\n${kVertexWork}\n${isBox ? kBoxVertexWork : ''}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>
        ${kLightFunctions}
        uniform vec3 sunTowards;
        uniform float uWearing;
        varying vec3 vLocal, vFacing;
        varying float vSeed;
        flat varying mat3 vTurn;
        flat varying vec3 uHalf;
        ${patternsOf(kind, isFloor)}
        ${hasEdges ? kJointFunction : ''}`)
      .replace('#include <shadowmap_pars_fragment>', shadowLookup(stage.shadowSamples))
      .replace('#include <lights_fragment_begin>', kFromAround)
      .replace('#include <color_fragment>', `#include <color_fragment>
        float pixel = max(length(dFdx(vLocal)), length(dFdy(vLocal)));
        float wear = 0.0, joint = 0.0, roughnessHere = 0.0;
        vec3 edgeSlope = vec3(0.0);
        vec2 shadeAt = gl_FragCoord.xy * shadeScale;
        {
          ${hasEdges ? kBoxWork : ''}
          diffuseColor.rgb = paintAt(diffuseColor.rgb, vLocal, vFacing, wear, pixel, roughnessHere) * (1.0 - 0.25 * joint);
        }`)
      .replace('#include <roughnessmap_fragment>', '#include <roughnessmap_fragment>\nroughnessFactor = clamp(roughnessFactor + roughnessHere, 0.05, 1.0);')
      .replace('#include <normal_fragment_maps>', `#include <normal_fragment_maps>
        {
          vec3 slope = vTurn * (reliefAt(vLocal, pixel) - edgeSlope);
          normal = normalize(normal - (slope - normal * dot(slope, normal)));
        }`);
    // Rough stuff mirrors nothing, and so keeps all light for its colour.
    shader.fragmentShader = shader.fragmentShader.replace('#include <lights_physical_fragment>', `#include <lights_physical_fragment>
      {
        float shiny = 1.0 - smoothstep(0.7, 0.8, roughnessFactor);
        material.specularColor *= shiny;
        material.specularColorBlended *= shiny;
        material.specularF90 *= shiny;
      }`);
    if (kKinds[kind].metalness > 0) {
      // What it mirrors: sky and ground, as the window has it.
      shader.fragmentShader = shader.fragmentShader.replace('#include <lights_fragment_end>', `#include <lights_fragment_end>
        {
          vec3 towards = inverseTransformDirection(geometryViewDir, viewMatrix), outward = inverseTransformDirection(normal, viewMatrix);
          float edge = 1.0 - max(dot(outward, towards), 0.0), rough = material.roughness;
          vec3 strength = material.specularColorBlended;
          strength += (1.0 - strength) * edge * edge * edge * edge * edge * (1.0 - rough) * 0.6;
          vec3 seen = mix(skyLight(reflect(-towards, outward), sunTowards), ambientLight(outward, sunTowards), 0.5 * rough);
          reflectedLight.indirectSpecular += strength * seen;
        }`);
    }
    if (kind === 'ground') {
      shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', `{
          vec3 towards = inverseTransformDirection(normalize(-vViewPosition), viewMatrix);
          outgoingLight = mix(outgoingLight, hazeLight(towards, sunTowards), hazeShare(length(vViewPosition)));
        }
        #include <opaque_fragment>`);
    }
    if (hasEdges) {
      // No light falls into a joint: shadows are not so fine.
      shader.fragmentShader = shader.fragmentShader.replace('#include <aomap_fragment>', `#include <aomap_fragment>
        reflectedLight.directDiffuse *= 1.0 - 0.65 * joint;
        reflectedLight.directSpecular *= 1.0 - joint;
        reflectedLight.indirectDiffuse *= 1.0 - 0.6 * joint;
        reflectedLight.indirectSpecular *= 1.0 - joint;`);
    }
    stage.shade.receive(shader);
  };
  return material;
}

// `isBox`: its edges are worn, unless it is ground; `isFloor`: of ground without end.
export function surfaceOf(kind: Kind, isBox: boolean, isFloor: boolean, stage: Stage): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: kKinds[kind].roughness, metalness: kKinds[kind].metalness });
  return withSurface(material, kind, isBox, isFloor, stage);
}
