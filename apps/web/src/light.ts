// The light of window, page and film (apps/appearance/light.glsl), for shaders and for the script.
import { Color, ShaderChunk, Vector3 } from 'three';
import kLight from './light.glsl';

// A colour of it by its name.
function lightNamed(name: string): Color {
  const found = new RegExp(`vec3 ${name} = vec3\\(([^)]*)\\)`).exec(kLight);
  if (!found) throw new Error(`light.glsl has no ${name}`);
  const [r, g, b] = found[1].split(',').map(parseFloat);
  return new Color().setRGB(r, g, b);
}
export const kSunLight = lightNamed('kSunLight');

// What shaders put ahead of themselves to light something: three.js puts its tones into most of them, and with these the rest.
export const kLightFunctions = `#ifndef LIGHT_IS_HERE\n#define LIGHT_IS_HERE\n${kLight}\n#endif`;

// Towards the sun: over the left shoulder of a camera. `back`: from what it looks at to the camera. As sunFrom in light.glsl.
export function sunOver(back: Vector3): Vector3 {
  const level = new Vector3(back.x, 0, back.z);
  if (level.lengthSq() === 0) level.z = 1;
  level.normalize();
  const numbers = /vec3 sunFrom[^}]*return vec3\((.*)\);/.exec(kLight)?.[1].match(/\d\.\d+/g)?.map(Number);
  if (numbers?.length !== 5) throw new Error('light.glsl has another sunFrom');
  const [along, aside, up] = numbers;
  return new Vector3(along * level.x - aside * level.z, up, along * level.z + aside * level.x).normalize();
}

// Tones as in all pictures: three.js offers a place for them.
const kPlace = 'vec3 CustomToneMapping( vec3 color ) { return color; }';
if (!ShaderChunk.tonemapping_pars_fragment.includes(kPlace)) throw new Error('three.js has another place for tones');
ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(
  kPlace, `${kLightFunctions}\nvec3 CustomToneMapping(vec3 colour) { return toneMapped(colour * toneMappingExposure * kExposure); }`);
