// shadow_test.mjs WEB_FOLDER: the page's look into its map of shadows. Shadows had grain: samples were turned anew at each pixel.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';

const [webFolder] = process.argv.slice(2);
const { buildSync } = createRequire(`${webFolder}/package.json`)('esbuild');
const { outputFiles } = buildSync({ entryPoints: [`${webFolder}/src/shadows.ts`], bundle: true, write: false, format: 'esm', logLevel: 'error' });
const { shadowLookup } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString('base64')}`);

for (const across of [2, 3]) {
  const shader = shadowLookup(across);
  const from = shader.indexOf('vec2 apart');
  const lookup = shader.slice(from, shader.indexOf('return', from)); // of a directional light: the first
  assert.ok(from > 0 && lookup.includes(`i < ${across * across};`), `no square of ${across} x ${across} samples`);
  assert.doesNotMatch(lookup, /gl_FragCoord|interleavedGradientNoise|\bphi\b|vogelDisk/, 'a sample goes by the pixel');
  // Around the point, and evenly: their places add up to nothing.
  const middle = Number(/i \/ \d\) - ([\d.]+);/.exec(lookup)[1]);
  assert.equal(middle, (across - 1) / 2);
}
console.log('ok a shadow is looked up by a fixed square of samples');
