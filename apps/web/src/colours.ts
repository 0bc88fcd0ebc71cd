// Colours of bodies: their material with a touch of difference from brick to brick, or a scale for speed and force.
import { Color } from 'three';
import { kindOf } from './materials';
import type { Take } from './tracks';

export type ColourMode = 'material' | 'speed' | 'force';
export const kColourModes: ColourMode[] = ['material', 'speed', 'force'];

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

// 0 .. 1, fixed for each body.
export function chance(body: number, salt: number): number {
  let h = (body * 374761393 + salt * 668265263) >>> 0;
  h = Math.imul(h ^ (h >>> 13), 1274126177) >>> 0;
  return ((h ^ (h >>> 16)) >>> 0) / 4294967296;
}

export function materialColour(take: Take, body: number, out: Color): Color {
  const meta = take.meta.bodies[body];
  out.setHex(meta.colour);
  const kind = kindOf(meta);
  const spread = kind === 'wood' ? 0.1 : kind === 'stone' || kind === 'concrete' ? 0.05 : 0;
  if (kind !== 'brick') return out.offsetHSL(0, 0, spread * (chance(body, 4) - 0.5));
  // As fired clay differs: mostly in lightness, a little in hue; one in nine burnt darker.
  const dark = chance(body, 3) < 0.11 ? -0.09 : 0;
  return out.offsetHSL((chance(body, 1) - 0.5) * 0.02, (chance(body, 2) - 0.5) * 0.1 - 0.06, (chance(body, 4) - 0.5) * 0.09 + dark);
}

export function speedShare(take: Take, speed: number): number {
  return Math.sqrt(speed / take.topSpeed);
}

export function forceShare(take: Take, force: number): number {
  return Math.log2(1 + force) / Math.log2(1 + take.topForce);
}
