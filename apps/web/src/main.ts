// The replay page: reads the take that is in the page, shows it, and answers to window.brickfall (which the tests drive).
// In the address, #t=2.5 opens at a time (or #frame=120 at a frame), #camera=side at a camera (or #view=1, by its number), #paused
// does not start playing, #picture shows the scene alone; joined with &.
import { Vector2, Vector3 } from 'three';
import { Bodies } from './bodies';
import { Card, amount } from './card';
import { scaleGradient, type ColourMode } from './colours';
import { byId, Controls } from './controls';
import { Dust } from './dust';
import { Player } from './player';
import { Stage } from './stage';
import { Take, type TakeMeta } from './tracks';
import { applyView, interestingBounds, overviewSide, viewsOf } from './views';

function fail(message: string): void {
  const box = byId('message');
  box.textContent = message;
  box.hidden = false;
  byId('bar').hidden = true;
}

function main(): void {
  const started = performance.now();
  const take = new Take(JSON.parse(byId('meta').textContent ?? '') as TakeMeta, byId('data').textContent ?? '');
  byId('data').textContent = '';
  const decodeMilliseconds = performance.now() - started;

  const bounds = interestingBounds(take);
  let stage: Stage;
  try {
    stage = new Stage(byId<HTMLCanvasElement>('view'), overviewSide(take, bounds));
  } catch {
    fail('This replay needs WebGL 2, which this browser does not offer (or has switched off).');
    return;
  }
  const { meta } = take;
  const bricks = meta.bodies.filter((body) => body.role === 'brick').length;
  byId('title').textContent = meta.title || meta.scene;
  byId('subtitle').textContent = `${bricks > 0 ? `${bricks} bricks` : `${take.bodies} bodies`} \u00b7 ${take.times[take.frames - 1].toFixed(1)} s \u00b7 Brickfall ${meta.engineVersion}`;

  const player = new Player(take.frames, meta.framesPerSecond);
  const bodies = new Bodies(take, stage.scene);
  const dust = new Dust(take, stage.scene);
  const card = new Card(byId('card'), take);
  stage.resize();
  stage.fitShadows(bounds.all);
  const plane = meta.bodies.findIndex((body) => body.parts.some((part) => meta.shapes[part.shape].type === 'plane'));
  if (plane >= 0) stage.addGround(take.position(0, plane)[1]);

  // In shares of the picture: what the title and the bar leave.
  const freeHeight = () => {
    const height = Math.max(1, window.innerHeight);
    return { top: 1 - (2 * byId('head').getBoundingClientRect().bottom) / height, bottom: 1 - (2 * byId('bar').getBoundingClientRect().top) / height };
  };
  const picture = new URLSearchParams(location.hash.slice(1)).has('picture');
  const free = () => (picture ? { top: 1, bottom: -1 } : freeHeight());
  const views = viewsOf(take, bounds, stage.camera.aspect, free());
  let view = views[0];
  let untouched = true; // since the view was chosen
  let dirty = true;
  const followed = { last: new Vector3(), now: new Vector3() };

  const select = (body: number): void => {
    bodies.select(body);
    card.select(body);
    dirty = true;
  };
  const setView = (index: number): void => {
    view = views[index] ?? views[0];
    applyView(stage, view, view === views[0] || view.follows >= 0);
    untouched = true;
    if (view.follows >= 0) {
      followed.last.copy(view.target);
      followed.now.copy(view.target);
    }
    dirty = true;
  };
  const setColour = (mode: ColourMode): void => {
    bodies.setColourMode(mode);
    byId('legend').hidden = mode === 'material';
    byId('legend-low').textContent = '0';
    byId('legend-high').textContent = mode === 'speed' ? amount(take.topSpeed, 'm/s') : amount(take.topForce, 'N');
    dirty = true;
  };
  byId('legend-bar').style.background = scaleGradient();
  const savePicture = (): void => {
    draw();
    stage.renderer.domElement.toBlob((blob) => blob && offer(blob, `${meta.scene}_${take.times[player.frame].toFixed(2)}s.png`), 'image/png');
  };
  const controls = new Controls(take, player, { setColour, setView, savePicture, deselect: () => select(-1) }, views.map((v) => v.name));
  player.onChange = () => (dirty = true);
  card.onSeek = (frame) => {
    player.pause();
    player.seek(frame);
  };
  card.onClose = () => select(-1);
  stage.controls.addEventListener('change', () => (dirty = true));
  stage.controls.addEventListener('start', () => (untouched = false));
  setView(meta.cameras.length > 0 ? 1 : 0);
  controls.setView(views.indexOf(view));
  listenForClicks(stage.renderer.domElement, (x, y) => select(bodies.pick(new Vector2(x, y), stage.camera)));

  const draw = (): void => {
    bodies.show(player.position);
    const half = Math.tan((stage.camera.fov * Math.PI) / 360);
    dust.show(player.position, stage.renderer.domElement.height / (2 * half));
    controls.show();
    card.show(player.frame);
    stage.render();
  };
  let last = performance.now();
  const tick = (now: number): void => {
    player.advance(Math.min(0.25, (now - last) / 1000));
    last = now;
    if (stage.resize()) {
      dirty = true;
      Object.assign(views[0], viewsOf(take, bounds, stage.camera.aspect, free())[0]);
      if (untouched && view.follows < 0) applyView(stage, view, view === views[0]);
    }
    if (view.follows >= 0 && dirty) {
      followed.now.set(...take.position(player.frame, view.follows));
      const shift = followed.now.clone().sub(followed.last);
      stage.camera.position.add(shift);
      stage.controls.target.add(shift);
      followed.last.copy(followed.now);
    }
    stage.controls.update();
    if (dirty) {
      dirty = false;
      draw();
      api.drawn++;
    }
    requestAnimationFrame(tick);
  };

  const project = (body: number): [number, number] => {
    const p = new Vector3(...take.position(player.frame, body)).project(stage.camera);
    const canvas = stage.renderer.domElement;
    return [((p.x + 1) / 2) * canvas.clientWidth, ((1 - p.y) / 2) * canvas.clientHeight];
  };
  const api = {
    ready: false, drawn: 0, frameCount: take.frames, bodyCount: take.bodies, hitCount: take.hits.length, decodeMilliseconds,
    get frame() { return player.frame; },
    get time() { return take.times[player.frame]; },
    get playing() { return player.playing; },
    get selected() { return bodies.selected; },
    get view() { return views.indexOf(view); },
    names: meta.bodies.map((body) => body.name),
    views: views.map((v) => v.name),
    play: () => player.play(),
    pause: () => player.pause(),
    seek: (frame: number) => { player.pause(); player.seek(frame); },
    setSpeed: (speed: number) => controls.setSpeed(speed),
    setLoop: (on: boolean) => controls.setLoop(on),
    setColour: (mode: ColourMode) => { controls.setColour(mode); setColour(mode); },
    setView: (index: number) => { controls.setView(index); setView(index); },
    lookFrom: (position: [number, number, number], target: [number, number, number]) => {
      applyView(stage, { ...view, position: new Vector3(...position), target: new Vector3(...target), follows: -1 }, true);
      dirty = true;
    },
    select,
    pick: (x: number, y: number) => {
      const canvas = stage.renderer.domElement;
      return bodies.pick(new Vector2((x / canvas.clientWidth) * 2 - 1, 1 - (y / canvas.clientHeight) * 2), stage.camera);
    },
    isThere: (body: number, frame = player.frame) => take.isThere(frame, body),
    position: (body: number, frame = player.frame) => take.position(frame, body),
    rotation: (body: number, frame = player.frame) => take.rotation(frame, body),
    speed: (body: number, frame = player.frame) => take.speed(frame, body),
    contactForce: (body: number, frame = player.frame) => take.force(frame, body),
    project,
  };
  Object.assign(window, { brickfall: api });

  const takeWishes = (): URLSearchParams => {
    const wishes = new URLSearchParams(location.hash.slice(1));
    document.body.classList.toggle('picture', wishes.has('picture'));
    const camera = wishes.get('camera');
    const named = views.findIndex((v) => v.name.toLowerCase() === camera?.toLowerCase());
    if (wishes.has('view')) api.setView(Number(wishes.get('view')));
    else if (named >= 0) api.setView(named);
    if (wishes.has('t')) player.seek(take.frameAt(Number(wishes.get('t'))));
    else if (wishes.has('frame')) player.seek(Number(wishes.get('frame')));
    if (wishes.has('paused')) player.pause();
    return wishes;
  };
  const wishes = takeWishes();
  window.addEventListener('hashchange', takeWishes);
  draw();
  api.ready = true;
  if (!wishes.has('paused') && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) player.play();
  requestAnimationFrame((now) => {
    last = now;
    tick(now);
  });
}

// A file for the visitor to keep.
function offer(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// A press that stays where it is and ends soon: a drag turns the camera instead.
function listenForClicks(canvas: HTMLCanvasElement, onClick: (x: number, y: number) => void): void {
  let start: PointerEvent | null = null;
  canvas.addEventListener('pointerdown', (event) => (start = event.isPrimary ? event : null));
  canvas.addEventListener('pointerup', (event) => {
    if (!start || Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) > 5) return;
    onClick((event.clientX / canvas.clientWidth) * 2 - 1, 1 - (event.clientY / canvas.clientHeight) * 2);
  });
}

try {
  main();
} catch (error) {
  fail(`This replay cannot be shown: ${error instanceof Error ? error.message : String(error)}`);
}
