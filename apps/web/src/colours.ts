// Colours of bodies: of their material, with a touch of difference from brick to brick, or of a scale for speed and force.
import { Color } from 'three';
import { kindOf, kKinds, kNumbers } from './materials';
import type { BodyMeta, Take, TakeMeta } from './tracks';

export type ColourMode = 'material' | 'speed' | 'force' | 'utilisation' | 'damage';
// Those that a take can show; of mortar only where it has some.
export function colourModes(take: Take): ColourMode[] {
  const modes: ColourMode[] = ['material', 'speed', 'force'];
  return take.meta.mortar?.length ? [...modes, 'utilisation', 'damage'] : modes;
}
export const kColourNames: Record<ColourMode, string> = {
  material: 'Material', speed: 'Speed', force: 'Contact force', utilisation: 'Mortar use', damage: 'Mortar damage',
};
// Values at the two ends of the scale and in its middle.
export function legendOf(mode: ColourMode, take: Take): [string, string, string] {
  if (mode === 'speed') return ['0', '', amountOf(take.topSpeed, 'm/s')];
  if (mode === 'force') return ['0', '', amountOf(take.topForce, 'N')];
  return mode === 'utilisation' ? ['load 0 %', '50', '100 % of its strength'] : ['damage 0 %', '50', '100 %: broken'];
}
// Of bodies while it is the mortar that is coloured.
export const kBehindMortar = new Color('#c9c6c0');

// Blue to pale yellow, rising evenly in lightness, so that it also reads without colour vision.
const kScale = ['#3c4f96', '#5d52ab', '#8f52a5', '#c0548a', '#e0655c', '#f29348', '#f8c862', '#fdf5c0'].map((c) => new Color(c));

export function scaleColour(share: number, out: Color): Color {
  const x = Math.min(1, Math.max(0, share)) * (kScale.length - 1);
  const k = Math.min(kScale.length - 2, Math.floor(x));
  return out.copy(kScale[k]).lerp(kScale[k + 1], x - k);
}

export function scaleGradient(): string {
  return `linear-gradient(90deg, ${kScale.map((c) => c.getStyle()).join(', ')})`;
}

// Of a body, by which it differs from others of its stuff, in all pictures alike.
export function lookNumber(meta: TakeMeta, body: number): number {
  return meta.bodies[body].look ?? body;
}

// 0 .. 1, fixed for each pair. As in apps/appearance/noise.h.
export function chance(body: number, salt: number): number {
  let h = (body * 374761393 + salt * 668265263) >>> 0;
  h = Math.imul(h ^ (h >>> 13), 1274126177) >>> 0;
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}

// As apps/appearance/look.cpp has it; the numbers are those of kinds.inc.
function fire(colour: Color, number: number): Color {
  const grey = 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;
  colour.lerp(scratch.setRGB(grey, grey, grey), kNumbers.BrickDust);
  const light = 1 + kNumbers.BrickLightness * (chance(number, 1) + chance(number, 2) - 1);
  const hue = kNumbers.BrickHue * (chance(number, 3) - 0.5);
  const isBurnt = chance(number, 4) < kNumbers.BurntShare;
  const dark = isBurnt ? kNumbers.BurntLightness : 1;
  return colour.setRGB(colour.r * light * dark, colour.g * light * (1 + 1.6 * hue) * dark, colour.b * light * (1 - hue) * (isBurnt ? kNumbers.BurntBlue : 1));
}
const scratch = new Color();

// Of a part of another material than its body, whose colour the take does not know: the usual one of its stuff.
function ownColour(meta: BodyMeta, part: number): number {
  const colour = meta.partColours?.[part];
  if (colour !== undefined) return colour;
  const material = meta.partMaterials?.[part];
  return material === undefined || material === meta.material ? meta.colour : kKinds[kindOf(meta, part)].colour;
}

// Of a part of a body, differing a little from one body to the next as its stuff does.
export function materialColour(take: Take, body: number, part: number, out: Color): Color {
  const meta = take.meta.bodies[body];
  const kind = kindOf(meta, part);
  const number = lookNumber(take.meta, body);
  out.setHex(ownColour(meta, part));
  if (kind === 'brick') return fire(out, number);
  if (kind === 'ground') {
    // Ground of "brick" (scenes name a material for its friction) is no red plain, but screed.
    if (kindOf({ ...meta, role: 'body' }, part) === 'brick') out.setHex(kKinds.concrete.colour);
    return out.multiplyScalar(kNumbers.GroundLightness);
  }
  return out.multiplyScalar(1 + kKinds[kind].spread * (chance(number, 1) - 0.5));
}

export function amountOf(value: number, unit: string): string {
  const size = Math.abs(value);
  const digits = size >= 100 || size === 0 ? 0 : size >= 10 ? 1 : 2;
  return `${value.toFixed(digits)} ${unit}`;
}

export function speedShare(take: Take, speed: number): number {
  return Math.sqrt(speed / take.topSpeed);
}

export function forceShare(take: Take, force: number): number {
  return Math.log2(1 + force) / Math.log2(1 + take.topForce);
}
