// Bundles the replay page: src/*.ts with three.js into one script, put with the style into the page, and that page written
// twice: as replay_template.html to look at, and as replay_template.cpp for the library to embed. Runs in the build folder.
import { readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const places = ['{{BRICKFALL_TITLE}}', '{{BRICKFALL_PREVIEW}}', '{{BRICKFALL_POSTER}}', '{{BRICKFALL_META}}', '{{BRICKFALL_DATA}}'];

// The texts of apps/appearance, which CMake puts beside src: without their comments.
const look = {
  name: 'look',
  setup: (made) => made.onLoad({ filter: /\.(glsl|inc)$/ }, async ({ path }) => (
    { loader: 'text', contents: (await readFile(path, 'utf8')).replace(/ *\/\/.*/g, '').replace(/\n\n+/g, '\n') })),
};

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, 'src', entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: ['es2020', 'chrome90', 'firefox90', 'safari15'],
    charset: 'ascii',
    plugins: [look],
    legalComments: 'inline',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

const script = await bundle('main.ts');
const style = await bundle('style.css');
let page = await readFile(join(here, 'src', 'page.html'), 'utf8');
// Functions as replacements: "$&" in the bundle must stay as it is.
page = page.replace('/*STYLE*/', () => style).replace('/*SCRIPT*/', () => script);
let from = 0;
for (const place of places) {
  const at = page.indexOf(place, from);
  if (at < 0 || page.indexOf(place, at + 1) >= 0) throw new Error(`page.html: ${place} must come once, in order`);
  from = at;
}
await writeFile(join(here, 'replay_template.html'), page);

const bytes = Buffer.from(page, 'utf8');
const pieces = [];
for (let at = 0; at < bytes.length; at += 8000) {
  let text = '';
  for (const b of bytes.subarray(at, at + 8000)) {
    const c = String.fromCharCode(b);
    if (c === '"' || c === '\\') text += '\\' + c;
    else if (c === '\n') text += '\\n';
    else if (b < 32 || b > 126 || c === '?') text += '\\' + b.toString(8).padStart(3, '0');
    else text += c;
  }
  pieces.push(`    std::string_view("${text}", ${Math.min(8000, bytes.length - at)}),`);
}
await writeFile(
  join(here, 'replay_template.cpp'),
  `// Made by apps/web/build.mjs.\n#include "output/replay_template.h"\n\nnamespace brickfall {\nnamespace {\n` +
    `constexpr std::string_view kPieces[] = {\n${pieces.join('\n')}\n};\n}  // namespace\n\n` +
    `std::span<const std::string_view> replayTemplate() { return kPieces; }\n\n}  // namespace brickfall\n`,
);
