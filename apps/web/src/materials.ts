// What stuff a part of a body is, by the name of its material; where a take names none (those before format version 3), by the role
// of its body; and how that looks. Words and figures are those of apps/appearance/kinds.inc, which window and film have too.
import kTable from './kinds.inc';
import type { BodyMeta } from './tracks';

export type Kind = 'brick' | 'concrete' | 'stone' | 'wood' | 'steel' | 'rubber' | 'ground' | 'plain';
export interface KindRow {
  colour: number;
  roughness: number;
  metalness: number;
  relief: number; // m
  spread: number;
  words: string[];
}

const rowsOf = (form: RegExp): string[][] => [...kTable.matchAll(form)].map((match) => match[1].split(',').map((cell) => cell.trim()));
export const kKinds = Object.fromEntries(rowsOf(/^KIND\((.*)\)$/gm).map(([name, ...cells]) => {
  const [colour, roughness, metalness, relief, spread] = cells.map(Number);
  return [name, { colour, roughness, metalness, relief, spread, words: cells[5].replace(/"/g, '').split(' ').filter((word) => word !== '') }];
})) as Record<Kind, KindRow>;
export const kNumbers = Object.fromEntries(rowsOf(/^NUMBER\((.*)\)$/gm).map(([name, value]) => [name, Number(value)]));

// `part`: its number; left out: what the body is for the most part.
export function kindOf(body: BodyMeta, part?: number): Kind {
  if (body.role === 'ground') return 'ground';
  const name = ((part === undefined ? undefined : body.partMaterials?.[part]) ?? body.material ?? '').toLowerCase();
  for (const kind of Object.keys(kKinds) as Kind[]) if (kKinds[kind].words.some((word) => name.includes(word))) return kind;
  return body.role === 'brick' ? 'brick' : body.role === 'ball' && name === '' ? 'steel' : 'plain';
}
