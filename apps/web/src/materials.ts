// What stuff a part of a body is, by the name of its material; where a take names none (those before format version 3), by the role
// of its body. The same words as in apps/appearance/look.cpp: page, viewer and renderer show one look for one material.
import type { BodyMeta } from './tracks';

export type Kind = 'brick' | 'concrete' | 'stone' | 'wood' | 'steel' | 'rubber' | 'ground' | 'plain';

const kWords: [Kind, string[]][] = [
  ['brick', ['brick', 'clay', 'terracotta', 'tile']],
  ['concrete', ['concrete', 'mortar', 'cement', 'plaster']],
  ['stone', ['stone', 'granite', 'marble', 'slate', 'rock', 'basalt']],
  ['wood', ['wood', 'oak', 'pine', 'timber', 'plank']],
  ['steel', ['steel', 'iron', 'metal', 'lead', 'copper', 'brass', 'chrome']],
  ['rubber', ['rubber', 'tyre']],
  ['ground', ['earth', 'soil', 'grass', 'sand', 'gravel', 'ground']],
];

// `part`: its number; left out: what the body is for the most part.
export function kindOf(body: BodyMeta, part?: number): Kind {
  if (body.role === 'ground') return 'ground';
  const name = ((part === undefined ? undefined : body.partMaterials?.[part]) ?? body.material ?? '').toLowerCase();
  for (const [kind, words] of kWords) if (words.some((word) => name.includes(word))) return kind;
  return body.role === 'brick' ? 'brick' : body.role === 'ball' && name === '' ? 'steel' : 'plain';
}
