// node apps/web/picture.mjs REPLAY.html OUT.png [frame=76] [view=0] [size=1280x640] [scale=1] [web=build/web]
// A still of a replay page, drawn by a browser without a screen: to see what a change of the page looks like. Needs chromium
// (or CHROMIUM=path) and the packages that building the page has put into build/web.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [page, out, ...rest] = process.argv.slice(2);
if (!page || !out) {
  console.error('usage: node picture.mjs REPLAY.html OUT.png [frame=76] [view=0] [size=1280x640] [scale=1] [web=build/web]');
  process.exit(2);
}
const options = { frame: '0', view: '0', size: '1280x640', scale: '1', web: 'build/web', ...Object.fromEntries(rest.map((o) => o.split('='))) };
const { chromium } = createRequire(pathToFileURL(resolve(options.web, 'package.json')))('playwright-core');
const [width, height] = options.size.split('x').map(Number);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
try {
  const tab = await browser.newPage({ viewport: { width, height }, deviceScaleFactor: Number(options.scale) });
  await tab.goto(`${pathToFileURL(resolve(page))}#paused&picture&frame=${options.frame}&view=${options.view}`, { timeout: 180_000 });
  await tab.waitForFunction(() => window.brickfall?.ready && window.brickfall.drawn > 0, null, { timeout: 180_000 });
  await tab.screenshot({ path: out, timeout: 180_000 });
} finally {
  await browser.close();
}
