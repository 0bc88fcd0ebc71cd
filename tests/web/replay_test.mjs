// replay_test.mjs WEB_FOLDER CHROMIUM PAGE BREAKING SLOPE SLAB OUT_FOLDER: the replay page as a visitor has it, from disk, without a network,
// drawn in software. What the page says of itself is checked against what its picture shows.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';

const [webFolder, executablePath, file, breaking, slope, slab, outFolder] = process.argv.slice(2);
const { chromium } = createRequire(`${webFolder}/package.json`)('playwright-core');
const patience = { timeout: 180_000 };
const kHitFrame = 60; // of the synthetic take

const browser = await chromium.launch({
  executablePath,
  headless: true,
  timeout: 120_000,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
    '--disable-background-networking', '--disable-quic', '--no-first-run', '--disable-component-update', '--disable-sync'],
});
const page = await browser.newPage({ viewport: { width: 640, height: 360 } });
page.setDefaultTimeout(patience.timeout);
const faults = [];
const requests = [];
page.on('console', (message) => ['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text()) && faults.push(message.text()));
page.on('pageerror', (error) => faults.push(error.message));
page.on('request', (request) => /^(data|blob):/.test(request.url()) || requests.push(request.url()));

async function check(name, body) {
  const start = Date.now();
  await body();
  console.log(`ok ${name} (${Date.now() - start} ms)`);
}
// Does something to the page and waits until it has been drawn. Both in one call: a picture that what came before had asked
// for, drawn between two calls, would be taken for this one.
async function drawn(action, argument) {
  const before = await page.evaluate(`(() => { const { drawn } = window.brickfall; (${action})(${JSON.stringify(argument)}); return drawn; })()`);
  await page.waitForFunction((n) => window.brickfall.drawn > n, before, patience);
}
// The page learns how high its title and bar are from an observer, which is told within a frame of the layout, not at once.
const laidOut = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const seek = (frame) => drawn((f) => window.brickfall.seek(f), frame);

// What the canvas shows: mean and spread of its lightness, and how many points of each row are brick red.
async function picture() {
  return page.evaluate(() => {
    const view = document.getElementById('view');
    const copy = document.createElement('canvas');
    copy.width = view.width;
    copy.height = view.height;
    const context = copy.getContext('2d');
    context.drawImage(view, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let sum = 0;
    let squares = 0;
    const rows = [];
    for (let y = 0; y < copy.height; y++) {
      let red = 0;
      for (let x = 0; x < copy.width; x++) {
        const at = (y * copy.width + x) * 4;
        const light = (data[at] + data[at + 1] + data[at + 2]) / 3;
        sum += light;
        squares += light * light;
        if (data[at] > 1.5 * data[at + 2] && data[at] > 1.25 * data[at + 1] && data[at] > 50) red++;
      }
      rows.push(red);
    }
    const count = copy.width * copy.height;
    const redRows = rows.map((n, y) => (n > 8 ? y : -1)).filter((y) => y >= 0);
    return {
      mean: sum / count, spread: Math.sqrt(squares / count - (sum / count) ** 2), width: copy.width, height: copy.height,
      red: rows.reduce((a, b) => a + b, 0), top: redRows[0] ?? -1, bottom: redRows.at(-1) ?? -1,
    };
  });
}
// Lightness, 0 .. 255, of the picture around points of the scene.
const lightAt = (points) => page.evaluate((list) => {
  const view = document.getElementById('view');
  const copy = document.createElement('canvas');
  copy.width = view.width;
  copy.height = view.height;
  const context = copy.getContext('2d', { willReadFrequently: true });
  context.drawImage(view, 0, 0);
  return list.map((point) => {
    const [x, y] = window.brickfall.project(point).map((v) => (v * view.width) / view.clientWidth);
    const { data } = context.getImageData(Math.round(x) - 1, Math.round(y) - 1, 3, 3);
    let sum = 0;
    for (let k = 0; k < data.length; k++) sum += k % 4 < 3 ? data[k] : 0;
    return sum / 27;
  });
}, points);
const heights = () => page.evaluate(() => {
  const { brickfall: b } = window;
  return b.names.map((name, k) => (name.startsWith('brick ') ? b.position(k)[1] : -1)).filter((y) => y >= 0);
});
const mean = (list) => list.reduce((a, b) => a + b, 0) / list.length;
const frame = () => page.evaluate(() => window.brickfall.frame);

try {
  // At one level of shade, whatever this machine keeps up with: the same pictures everywhere.
  await page.goto(`file://${file}#paused&shade=0&check`, patience);
  await page.waitForFunction(() => window.brickfall?.ready, null, patience);
  let standing;

  await check('the first picture is drawn once', async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
    assert.equal(await page.evaluate(() => window.brickfall.drawn), 1);
  });

  await check('the first picture is as all that follow', async () => {
    const other = await browser.newPage({ viewport: { width: 480, height: 270 } });
    await other.goto(`file://${file}#paused&picture&shade=1`, patience);
    await other.waitForFunction(() => window.brickfall?.ready, null, patience);
    const first = await other.screenshot(patience);
    await other.evaluate(() => window.brickfall.setShade(1));
    await other.waitForFunction(() => window.brickfall.drawn > 1, null, patience);
    assert.ok(first.equals(await other.screenshot(patience)));
    await other.close();
  });

  await check('opens from disk and asks for nothing else', async () => {
    assert.deepEqual(requests.map((url) => url.split('#')[0]), [`file://${file}`]);
    assert.equal(await page.evaluate(() => window.brickfall.frameCount), 240);
    assert.equal(await page.evaluate(() => window.brickfall.bodyCount), 105);
    assert.match(await page.textContent('#title'), /pretends <to fall> & "lie"/);
    assert.ok(await page.evaluate(() => window.brickfall.decodeMilliseconds) < 10_000);
  });

  await check('begins at the first camera of the scene', async () => {
    assert.equal(await page.evaluate(() => window.brickfall.views[window.brickfall.view]), 'front');
    await drawn(() => window.brickfall.setView(0));
  });

  await check('the overview has all bricks between title and bar, from start to end', async () => {
    for (const [width, height] of [[640, 360], [390, 700]]) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction((w) => document.getElementById('view').width >= w && document.getElementById('view').clientWidth === w, width, patience);
      await seek(kHitFrame - 5);
      for (const f of [0, kHitFrame, 100, 140, 239]) {
        const seen = await page.evaluate((at) => {
          const { brickfall: b } = window;
          b.seek(at);
          const points = b.names.map((name, k) => (name.startsWith('brick ') ? b.project(k) : null)).filter((p) => p);
          return { points, top: document.getElementById('head').getBoundingClientRect().bottom, bottom: document.getElementById('bar').getBoundingClientRect().top };
        }, f);
        const outside = seen.points.filter(([x, y]) => !(x > 0 && x < width && y > seen.top && y < seen.bottom));
        assert.equal(outside.length, 0, `${outside[0]} at ${width} x ${height} in frame ${f}`);
      }
    }
    await page.setViewportSize({ width: 640, height: 360 });
  });

  await check('title, card, bar and window edges keep apart', async () => {
    // The first: the ground, which takes more hits than the card has room for.
    for (const [width, height, body] of [[667, 375, 0], [844, 390, 0], [568, 320, 0], [390, 700, 0], [800, 500, 3], [640, 360, 3],
      [1280, 720, 3], [1130, 500, 3], [970, 500, 3], [730, 500, 3]]) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction((w) => document.getElementById('view').clientWidth === w, width, patience);
      await page.evaluate((k) => window.brickfall.select(k), body);
      await laidOut();
      if (body === 0) assert.equal(await page.locator('#card li').count(), 8);
      const rects = await page.evaluate(() => [...['head', 'card', 'bar'].map((id) => document.getElementById(id)),
        ...document.querySelectorAll('#bar button, #bar select')].filter((e) => e.offsetParent !== null || e.id)
        .map((e) => ({ id: e.id, ...e.getBoundingClientRect().toJSON() })).filter((r) => r.width > 0));
      const by = Object.fromEntries(rects.map((r) => [r.id, r]));
      const apart = (p, q) => p.right <= q.left || q.right <= p.left || p.bottom <= q.top || q.bottom <= p.top;
      for (const [p, q] of [['head', 'card'], ['card', 'bar'], ['head', 'bar']])
        assert.ok(apart(by[p], by[q]), `${p} and ${q} at ${width} x ${height}`);
      assert.ok(by.card.top >= 0 && by.card.height > 60, `card from ${by.card.top}, ${by.card.height} high at ${width} x ${height}`);
      for (const r of rects.slice(3))
        assert.ok(r.left >= by.bar.left && r.right <= by.bar.right && r.bottom <= by.bar.bottom, `${r.id} at ${width} x ${height}`);
      await page.evaluate(() => window.brickfall.select(-1));
    }
  });

  await check('the address opens at a time and a camera', async () => {
    await page.evaluate(() => new Promise((done) => {
      window.addEventListener('hashchange', done, { once: true }); // told after the page has been
      location.hash = '#paused&shade=0&t=1.5&camera=side';
    }));
    const state = await page.evaluate(() => ({ time: window.brickfall.time, view: window.brickfall.views[window.brickfall.view] }));
    assert.ok(Math.abs(state.time - 1.5) < 0.02, `${state.time} s`);
    assert.equal(state.view, 'side');
    await drawn(() => window.brickfall.setView(0));
  });

  await check('a camera with a path goes along it, as in films, until the mouse takes it', async () => {
    await page.setViewportSize({ width: 480, height: 300 }); // as wide as cameras are set up for: in a narrower one they step back
    await page.waitForFunction(() => document.getElementById('view').clientWidth === 480, null, patience);
    const { moving } = JSON.parse(await readFile(`${outFolder}/poses.json`, 'utf8'));
    assert.equal(moving.length, 5);
    await drawn(() => window.brickfall.setView(window.brickfall.views.indexOf('side')));
    const camera = () => page.evaluate(() => window.brickfall.camera);
    const far = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    for (const want of moving) {
      await seek(want.frame);
      const found = await camera();
      assert.ok(far(found.position, want.position) < 1e-3 && far(found.target, want.target) < 1e-3
        && Math.abs(found.fieldOfView - want.fieldOfView) < 1e-3, `frame ${want.frame}: ${JSON.stringify(found)}, in films ${JSON.stringify(want)}`);
    }
    await page.mouse.move(240, 110);
    await page.mouse.down();
    await page.mouse.move(300, 115, { steps: 3 });
    await page.mouse.up();
    await seek(moving[1].frame);
    const away = far((await camera()).position, moving[1].position);
    assert.ok(away > 0.5, `taken by the mouse it is still ${away} m from its path`);
    await drawn(() => window.brickfall.setView(window.brickfall.views.indexOf('side')));
    assert.ok(far((await camera()).position, moving[1].position) < 1e-3, 'chosen again it goes along again');
    await page.setViewportSize({ width: 640, height: 360 });
    await page.waitForFunction(() => document.getElementById('view').clientWidth === 640, null, patience);
    await drawn(() => window.brickfall.setView(0));
  });

  await check('it is darker where bricks meet, and nowhere else', async () => {
    await seek(0);
    const at = await page.evaluate(() => window.brickfall.position(window.brickfall.names.indexOf('brick 4')));
    const front = at[2] + 0.0575;
    await drawn(([x, y, z]) => window.brickfall.lookFrom([x, y + 0.12, z + 0.6], [x, y + 0.02, z]), at);
    const mean = (list) => list.reduce((a, b) => a + b, 0) / list.length;
    // Along the middle of the brick, along the joint above it, and on the ground a little and far before its foot.
    const row = (y, z) => Array.from({ length: 15 }, (_, k) => [at[0] - 0.07 + 0.01 * k, y, z]);
    const rows = { face: row(at[1] + 0.01, front), joint: row(at[1] + 0.0355, front), foot: row(0, front + 0.012), ground: row(0, front + 0.22) };
    const lights = async () => Object.fromEntries(await Promise.all(Object.entries(rows).map(async ([name, list]) => [name, mean(await lightAt(list))])));
    const held = async (level) => {
      await drawn((n) => window.brickfall.setShade(n), level);
      return lights();
    };
    const [without, fine] = [await held(0), await held(2)];
    for (const found of [without, fine]) assert.ok(found.joint < 0.75 * found.face, `joint ${found.joint}, face ${found.face}`);
    assert.ok(fine.foot < 0.9 * without.foot, `at the foot ${fine.foot}, without shade ${without.foot}`);
    assert.ok(fine.ground > 0.96 * without.ground, `on open ground ${fine.ground}, without shade ${without.ground}`);
    // A brick alone in the air: as light at its edges as between them, at every level.
    await drawn(() => window.brickfall.setView(0));
    const alone = await page.evaluate(() => {
      const { brickfall: b } = window;
      const far = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      let best = { room: 0 };
      for (let f = 70; f < 140; f += 5) {
        b.seek(f);
        b.names.forEach((name, k) => {
          const p = b.position(k);
          if (!name.startsWith('brick ') || p[1] < 0.5) return;
          const room = Math.min(...b.names.map((_, j) => (j === k || j === 0 ? 9 : far(p, b.position(j)))));
          if (room > best.room) best = { room, frame: f, body: k };
        });
      }
      return best;
    });
    assert.ok(alone.room > 0.2, `the loneliest brick is ${alone.room} m from the next`);
    await seek(alone.frame);
    for (const level of [0, 2]) {
      await drawn(([n, body]) => {
        const { brickfall: b } = window;
        b.setShade(n);
        const [x, y, z] = b.position(body);
        const q = b.rotation(body);
        const turned = (v) => { // by the quaternion
          const t = [2 * (q[1] * v[2] - q[2] * v[1]), 2 * (q[2] * v[0] - q[0] * v[2]), 2 * (q[0] * v[1] - q[1] * v[0])];
          return [v[0] + q[3] * t[0] + q[1] * t[2] - q[2] * t[1], v[1] + q[3] * t[1] + q[2] * t[0] - q[0] * t[2], v[2] + q[3] * t[2] + q[0] * t[1] - q[1] * t[0]];
        };
        window.onBrick = (v) => { const t = turned(v); return [x + t[0], y + t[1], z + t[2]]; };
        b.lookFrom(window.onBrick([0, 0.02, 0.36]), [x, y, z]);
      }, [level, alone.body]);
      const points = await page.evaluate(() => {
        const list = (y) => Array.from({ length: 19 }, (_, k) => window.onBrick([-0.09 + 0.01 * k, y, 0.0575]));
        return { edges: [...list(0.032), ...list(-0.032)], middle: [...list(0.012), ...list(-0.012)] };
      });
      const [edges, middle] = [mean(await lightAt(points.edges)), mean(await lightAt(points.middle))];
      assert.ok(edges > 0.92 * middle, `edges ${edges}, between them ${middle}, at level ${level}`);
    }
    await drawn(() => { window.brickfall.setShade(0); window.brickfall.setView(0); });
  });

  await check('saves the picture', async () => {
    const [download] = await Promise.all([page.waitForEvent('download', patience), page.click('#save')]);
    assert.match(download.suggestedFilename(), /\.png$/);
    const bytes = await readFile(await download.path());
    assert.deepEqual([...bytes.subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
    assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [640, 360]);
  });

  await check('films from here to the end, the last tenths of a second, too', async () => {
    assert.equal(await page.locator('#record').isVisible(), true);
    await seek(222);
    const [download] = await Promise.all([page.waitForEvent('download', patience), page.keyboard.press('r')]);
    assert.match(download.suggestedFilename(), /\.webm$/);
    const bytes = await readFile(await download.path());
    assert.deepEqual([...bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]); // of EBML, which WebM is written in
    assert.ok(bytes.length > 2000, `${bytes.length} bytes`);
    assert.equal(await page.getAttribute('#record', 'aria-pressed'), 'false');
  });

  await check('space presses the button that has the focus, and else plays', async () => {
    await seek(10);
    await page.focus('#forward');
    await page.keyboard.press(' ');
    assert.equal(await frame(), 11);
    assert.equal(await page.evaluate(() => window.brickfall.playing), false);
    await page.focus('#loop');
    await page.keyboard.press(' ');
    assert.equal(await page.getAttribute('#loop', 'aria-pressed'), 'true');
    assert.equal(await page.evaluate(() => window.brickfall.playing), false);
    await page.keyboard.press(' ');
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.brickfall.playing), true);
    await page.keyboard.press(' ');
  });

  await check('the wall stands before the hit', async () => {
    await seek(kHitFrame - 5);
    standing = { heights: await heights(), picture: await picture() };
    assert.equal(standing.heights.length, 100);
    assert.ok(mean(standing.heights) > 0.3, `mean height ${mean(standing.heights)}`);
    assert.ok(standing.picture.spread > 10, `picture of spread ${standing.picture.spread}`);
    assert.ok(standing.picture.red > 2000, `${standing.picture.red} points of brick`);
    await page.screenshot({ path: `${outFolder}/standing.png`, ...patience });
  });

  await check('and lies after it', async () => {
    await seek(239);
    const lying = { heights: await heights(), picture: await picture() };
    assert.ok(mean(lying.heights) < 0.5 * mean(standing.heights), `mean height ${mean(lying.heights)}`);
    assert.ok(lying.picture.red > 500, `${lying.picture.red} points of brick`);
    assert.ok(lying.picture.spread > 10);
    await page.screenshot({ path: `${outFolder}/lying.png`, ...patience });
    // From the side: the highest brick in the picture sinks by more than a third of the wall's height in it.
    const side = [[-4, 0.4, 0.01], [0, 0.35, 0]];
    await drawn(([p, t]) => window.brickfall.lookFrom(p, t), side);
    const low = await picture();
    await seek(kHitFrame - 5);
    const high = await picture();
    assert.ok(low.top - high.top > (high.bottom - high.top) / 3, `top row ${high.top} before, ${low.top} after`);
    await drawn(() => window.brickfall.setView(0));
  });

  await check('scrubbing shows the frame that was asked for', async () => {
    await page.evaluate(() => {
      const scrub = document.getElementById('scrub');
      scrub.value = '100';
      scrub.dispatchEvent(new Event('input'));
    });
    assert.equal(await frame(), 100);
    await seek(1e9);
    assert.equal(await frame(), 239);
    await seek(-5);
    assert.equal(await frame(), 0);
  });

  await check('the same frame gives the same picture, whatever came before', async () => {
    await seek(90);
    const first = await picture();
    await seek(200);
    await seek(90);
    assert.deepEqual(await picture(), first);
  });

  await check('plays, pauses, changes speed, loops', async () => {
    await seek(0);
    await page.evaluate(() => window.brickfall.setSpeed(4));
    await page.click('#play');
    await page.waitForFunction(() => window.brickfall.frame > 20, null, patience);
    await page.click('#play');
    const here = await frame();
    assert.equal(await page.evaluate(() => window.brickfall.playing), false);
    await page.evaluate(() => new Promise((done) => setTimeout(done, 300)));
    assert.equal(await frame(), here);
    await page.evaluate(() => { window.brickfall.seek(230); window.brickfall.play(); });
    await page.waitForFunction(() => !window.brickfall.playing && window.brickfall.frame === 239, null, patience);
    await page.evaluate(() => { window.brickfall.setLoop(true); window.brickfall.seek(235); window.brickfall.play(); });
    await page.waitForFunction(() => window.brickfall.frame < 200, null, patience);
    await page.evaluate(() => { window.brickfall.pause(); window.brickfall.setLoop(false); window.brickfall.setSpeed(1); });
  });

  await check('keys step, jump, play and change the colours', async () => {
    await seek(50);
    await page.keyboard.press('.');
    assert.equal(await frame(), 51);
    await page.keyboard.press(',');
    await page.keyboard.press('ArrowLeft');
    assert.equal(await frame(), 49);
    await page.keyboard.press('Shift+ArrowRight');
    assert.equal(await frame(), 59);
    await page.keyboard.press('Home');
    assert.equal(await frame(), 0);
    await page.keyboard.press('End');
    assert.equal(await frame(), 239);
    await page.keyboard.press('Home');
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.brickfall.playing), true);
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.brickfall.playing), false);
    await page.keyboard.press('c');
    assert.equal(await page.inputValue('#colour'), '1');
    assert.equal(await page.isVisible('#legend'), true);
    await page.keyboard.press('c');
    await page.keyboard.press('c');
    assert.equal(await page.isVisible('#legend'), false);
  });

  await check('arrows show velocities and forces for who asks', async () => {
    const arrows = () => page.evaluate(() => window.brickfall.arrows);
    await seek(90);
    const fastest = await page.evaluate(() => window.brickfall.names.map((_, k) => k).sort((a, b) => window.brickfall.speed(b) - window.brickfall.speed(a))[0]);
    const found = await page.evaluate((k) => {
      const b = window.brickfall, t = 2 / 60;
      const [before, now, after] = [88, 90, 92].map((frame) => b.position(k, frame));
      return { velocity: b.velocity(k), speeds: [b.speed(k, 90), b.speed(k, 91)], force: b.netForce(k), bend: now.map((x, i) => (before[i] + after[i] - 2 * x) / (t * t)) };
    }, fastest);
    assert.ok(found.speeds[0] > 0.5, `something moves: ${found.speeds}`);
    assert.ok(Math.hypot(...found.velocity) <= Math.max(...found.speeds) + 1e-6 && Math.hypot(...found.velocity) > 0.5 * Math.min(...found.speeds));
    const mass = found.force[1] / found.bend[1]; // one factor for all axes
    for (const i of [0, 1, 2]) assert.ok(Math.abs(found.force[i] - mass * found.bend[i]) < 1e-3 * Math.abs(mass) * (1 + Math.abs(found.bend[i])), `${found.force} ${found.bend}`);
    await page.keyboard.press('a');
    await page.waitForFunction(() => window.brickfall.arrows.kind === 'velocity' && window.brickfall.arrows.count > 0);
    const moving = (await arrows()).count;
    await seek(0);
    await page.waitForFunction((moving) => window.brickfall.arrows.count < moving, moving);
    await seek(90);
    await page.keyboard.press('a');
    assert.equal((await arrows()).kind, 'force');
    await page.keyboard.press('a');
    await page.waitForFunction(() => window.brickfall.arrows.kind === 'none' && window.brickfall.arrows.count === 0);
  });

  await check('figures over time are shown for who asks, with the value at the moment', async () => {
    assert.equal(await page.evaluate(() => window.brickfall.chartShown), false);
    await seek(90);
    await page.keyboard.press('e');
    assert.equal(await page.evaluate(() => window.brickfall.chartShown), true);
    const figure = () => page.evaluate(() => document.getElementById('chart-value').textContent);
    assert.equal(await figure(), 'largest force 0 N');
    await seek(150);
    assert.equal(await figure(), 'largest force 1230 N');
    assert.deepEqual(await page.evaluate(() => [...document.getElementById('chart-choice').options].map((o) => o.text)), ['Largest force']);
    const box = await page.evaluate(() => document.getElementById('chart-canvas').getBoundingClientRect().toJSON());
    await page.mouse.click(box.x + box.width / 4, box.y + box.height / 2);
    assert.ok(Math.abs(await page.evaluate(() => window.brickfall.time) - 239 / 240) < 0.06);
    await page.keyboard.press('e');
    assert.equal(await page.evaluate(() => window.brickfall.chartShown), false);
  });

  await check('colours by speed and by contact force change the picture', async () => {
    await seek(80);
    const clay = await picture();
    await drawn(() => window.brickfall.setColour('speed'));
    const speed = await picture();
    await drawn(() => window.brickfall.setColour('force'));
    const force = await picture();
    assert.ok(speed.red !== clay.red && force.red !== clay.red && speed.mean !== force.mean);
    await drawn(() => window.brickfall.setColour('material'));
  });

  await check('a click on a brick shows its figures', async () => {
    await seek(40);
    const at = await page.evaluate(() => {
      const { brickfall: b } = window;
      const bricks = b.names.map((_, k) => k).filter((k) => b.names[k].startsWith('brick '));
      const body = bricks.find((k) => { const [x, y] = b.project(k); return y < 240 && b.pick(x, y) === k; });
      return { body, point: b.project(body), name: b.names[body] };
    });
    assert.ok(at.body > 0, 'no brick could be picked');
    await page.mouse.click(...at.point);
    await page.waitForFunction(() => window.brickfall.selected >= 0, null, patience);
    assert.equal(await page.evaluate(() => window.brickfall.selected), at.body);
    const card = await page.textContent('#card');
    assert.ok(card.includes(at.name) && card.includes('3.40 kg') && /Hits taken: \d+/.test(card), card);
    await page.keyboard.press('Escape');
    assert.equal(await page.evaluate(() => window.brickfall.selected), -1);
    assert.equal(await page.isVisible('#card'), false);
    // A drag turns the camera and picks nothing.
    const before = await page.evaluate((k) => window.brickfall.project(k), at.body);
    await page.mouse.move(...at.point);
    await page.mouse.down();
    await page.mouse.move(at.point[0] + 60, at.point[1] + 10, { steps: 4 });
    await page.mouse.up();
    await page.waitForFunction(([k, [x]]) => Math.abs(window.brickfall.project(k)[0] - x) > 3, [at.body, before], patience);
    assert.equal(await page.evaluate(() => window.brickfall.selected), -1);
  });

  await check('every camera shows something', async () => {
    const views = await page.evaluate(() => window.brickfall.views);
    assert.deepEqual(views, ['Overview', 'front', 'side', 'Follow the ball']);
    await seek(kHitFrame - 1);
    for (let k = 0; k < views.length; k++) {
      await drawn((index) => window.brickfall.setView(index), k);
      assert.ok((await picture()).red > 500, views[k]);
    }
    await drawn(() => window.brickfall.setView(0));
  });

  await check('fits a phone', async () => {
    await page.setViewportSize({ width: 390, height: 700 });
    await seek(kHitFrame - 5);
    await page.waitForFunction(() => document.getElementById('view').clientWidth === 390, null, patience);
    const right = await page.evaluate(() => Math.max(...[...document.querySelectorAll('#bar button, #bar select')]
      .filter((e) => e.offsetParent).map((e) => e.getBoundingClientRect().right)));
    assert.ok(right <= 390, `a control ends at ${right}`);
    assert.ok((await picture()).red > 500);
    await page.screenshot({ path: `${outFolder}/phone.png`, ...patience });
  });

  await check('bodies are shown only while they are there', async () => {
    await page.setViewportSize({ width: 640, height: 360 });
    await page.goto(`file://${breaking}#paused&shade=0&check`, patience);
    await page.waitForFunction(() => window.brickfall?.ready, null, patience);
    const names = await page.evaluate(() => window.brickfall.names);
    const [brick, piece, passing] = ['brick 0', 'piece 0', 'piece 1'].map((name) => names.indexOf(name));
    assert.ok(brick > 0 && piece > 0 && passing > 0, names.join());
    const there = (frame) => page.evaluate(([f, list]) => list.map((k) => window.brickfall.isThere(k, f)), [frame, [brick, piece, passing]]);
    assert.deepEqual(await there(kHitFrame - 1), [true, false, false]);
    assert.deepEqual(await there(kHitFrame), [false, true, true]);
    assert.deepEqual(await there(kHitFrame + 70), [false, true, false]);
    // From behind, where the ball does not hide them: the one or the other is under the same point of the picture.
    await seek(kHitFrame);
    await drawn(() => window.brickfall.lookFrom([-0.1, 0.5, -1.2], [-0.1, 0.05, 0]));
    // The mortar of the two bricks is coloured, with a legend, and goes with the brick that breaks.
    const mortar = (frame) => page.evaluate((f) => window.brickfall.mortar(0, f), frame);
    assert.notEqual(await mortar(kHitFrame - 1), null);
    assert.equal(await mortar(kHitFrame), null);
    for (const [mode, words] of [['utilisation', /load 0 %.*50.*100 % of its strength/], ['damage', /damage 0 %.*50.*100 %: broken/]]) {
      await drawn((m) => window.brickfall.setColour(m), mode);
      assert.match(await page.textContent('#legend'), words);
    }
    await drawn(() => window.brickfall.setColour('material'));
    const point = await page.evaluate((k) => window.brickfall.project(k), piece);
    const picked = () => page.evaluate(([x, y]) => window.brickfall.pick(x, y), point);
    assert.equal(await picked(), piece);
    await seek(kHitFrame - 1);
    assert.equal(await picked(), brick);
    const before = await picture();
    assert.ok(before.red > 500, `${before.red} points of brick`);
    await page.screenshot({ path: `${outFolder}/whole.png`, ...patience });
    await seek(kHitFrame + 20);
    assert.notDeepEqual(await picture(), before);
    await page.screenshot({ path: `${outFolder}/broken.png`, ...patience });
    // The second piece, of which the others leave a corner to be seen, is in the picture until the frame in which it goes.
    const passes = async (frame) => {
      await seek(frame);
      return page.evaluate((k) => {
        const { brickfall: b } = window;
        const [x, y] = b.project(k);
        for (let dx = -60; dx <= 60; dx += 4) for (let dy = -60; dy <= 60; dy += 4) if (b.pick(x + dx, y + dy) === k) return true;
        return false;
      }, passing);
    };
    const [x, y, z] = await page.evaluate(([k, f]) => window.brickfall.position(k, f), [passing, kHitFrame + 69]);
    await drawn(([p, t]) => window.brickfall.lookFrom(p, t), [[x + 0.1, y + 1, z + 0.1], [x, y, z]]);
    assert.equal(await passes(kHitFrame + 69), true);
    assert.equal(await passes(kHitFrame + 70), false);
    await drawn((k) => window.brickfall.select(k), passing);
    assert.match(await page.textContent('#card'), /no longer there/);
    await seek(kHitFrame - 10);
    assert.match(await page.textContent('#card'), /not there yet/);
    await seek(kHitFrame + 5);
    assert.doesNotMatch(await page.textContent('#card'), /there/);
  });

  await check('a tilted plane is drawn as it lies, and the overview has all of a lone ball\'s way', async () => {
    await page.goto(`file://${slope}#paused&shade=0&view=0`, patience);
    await page.waitForFunction(() => window.brickfall?.ready, null, patience);
    const { names, kinds } = await page.evaluate(() => ({ names: window.brickfall.names, kinds: window.brickfall.kinds }));
    assert.deepEqual(names, ['ground', 'ball', 'plain', 'hammer']);
    assert.deepEqual(kinds, [['ground'], ['steel'], ['plain'], ['wood', 'steel']]); // as kindOf in apps/appearance/look.cpp has it
    for (const f of [0, 60, 119]) {
      await seek(f);
      const [x, y, top, bottom] = await page.evaluate(() => [...window.brickfall.project(1),
        document.getElementById('head').getBoundingClientRect().bottom, document.getElementById('bar').getBoundingClientRect().top]);
      assert.ok(x > 0 && x < 640 && y > top && y < bottom, `the ball at ${x} ${y} in frame ${f}`);
    }
    // Seen along z, the horizon of the plane falls as the plane does: ground below it, sky above.
    await drawn(() => window.brickfall.lookFrom([5, 0, 12], [5, 0, 0]));
    const height = (x) => -x * Math.tan(0.2);
    for (const x of [1, 5, 9]) {
      const [below, above] = await lightAt([[x, height(x) - 0.5, 0], [x, height(x) + 1.2, 0]]);
      assert.ok(below < 0.88 * above, `at x ${x} ${below} below the plane's line, ${above} above it`);
    }
  });

  await check('the overview is not led away by what falls from a slab', async () => {
    await page.goto(`file://${slab}#paused&shade=0&view=0`, patience);
    await page.waitForFunction(() => window.brickfall?.ready, null, patience);
    assert.match(await page.textContent('#subtitle'), /^3 bodies/); // the slab is none of them
    // How far a body slides on it, in the picture.
    const [from, to] = await page.evaluate(() => [0, 239].map((f) => { window.brickfall.seek(f); return window.brickfall.project(2)[0]; }));
    assert.ok(to - from > 0.4 * 640, `its way is ${to - from} points long`);
  });

  await check('a camera that follows turns after its body from where it stands, until the mouse takes it', async () => {
    const look = async (f) => {
      await seek(f);
      return page.evaluate(() => {
        const { brickfall: b } = window;
        const body = b.names.indexOf('left');
        return { at: b.camera.position, seen: b.project(body) };
      });
    };
    await drawn(() => window.brickfall.setView(1));
    for (const f of [10, 120, 239]) {
      const { at, seen } = await look(f);
      assert.ok(Math.hypot(at[0] - 8, at[1] - 3, at[2] - 8) < 1e-3, `frame ${f}: it stands at ${at}`);
      assert.ok(Math.hypot(seen[0] - 320, seen[1] - 180) < 1, `frame ${f}: the body is at ${seen}`);
    }
    await page.mouse.move(240, 110);
    await page.mouse.down();
    await page.mouse.move(300, 115, { steps: 3 });
    await page.mouse.up();
    const { seen } = await look(60);
    assert.ok(Math.hypot(seen[0] - 320, seen[1] - 180) > 20, `taken by the mouse it still looks at it: ${seen}`);
  });

  await check('boxes of all sizes are one mesh, each with its own size', async () => {
    await seek(0);
    // From straight above: how far to the side a body goes, in points from its middle.
    const reach = async (body, from, to) => {
      await drawn(([p, t]) => window.brickfall.lookFrom(p, t), [from, to]);
      return page.evaluate((k) => {
        const { brickfall: b } = window;
        const [x, y] = b.project(k);
        let far = 0;
        while (far < 400 && b.pick(x + far, y - 0.7 * far) === k) far += 0.25;
        return far;
      }, body);
    };
    const ground = await reach(0, [0, 60, 0.01], [0, 0, 0]);
    const box = await reach(3, [1, 3.1, 0.001], [1, 0.1, 0]);
    const points = (half, away) => (half / away) * 180 / Math.tan((22.5 * Math.PI) / 180);
    assert.equal(await page.evaluate(() => window.brickfall.meshes), 3); // ground, boxes, ball
    assert.ok(Math.abs(ground - points(20, 60)) < 3, `the ground ends at ${ground}`);
    assert.ok(Math.abs(box - points(0.1, 2.9)) < 1, `the box ends at ${box}`);
  });

  await check('nothing went wrong on the way', async () => {
    assert.deepEqual(faults, []);
    assert.ok(requests.every((url) => url.startsWith('file://')), requests.join(' '));
  });
} catch (error) {
  await page.screenshot({ path: `${outFolder}/failed.png`, ...patience }).catch(() => {});
  console.error(error);
  process.exitCode = 1;
} finally {
  await browser.close();
}
