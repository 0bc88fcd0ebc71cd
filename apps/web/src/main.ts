// The replay page: reads the take that is in the page, shows it, and answers to window.brickfall (which the tests drive).
// In the address, #t=2.5 opens at a time (or #frame=120 at a frame), #camera=side at a camera (or #view=1, by its number), #paused
// does not start playing, #arrows=velocity (force) draws arrows, #picture shows the scene alone, #shade=2 (1, 0) holds the shade where bodies meet at a level,
// #check tells of shaders that the device refuses; joined with &.
import { Matrix4, Vector2, Vector3 } from 'three';
import { Arrows, kArrowKinds, type ArrowKind } from './arrows';
import { Bodies } from './bodies';
import { boundsOf, sizeOf } from './bounds';
import { Card } from './card';
import { Chart } from './chart';
import { legendOf, scaleGradient, type ColourMode } from './colours';
import { byId, Controls } from './controls';
import { Dust } from './dust';
import { kindOf } from './materials';
import { Mortar } from './mortar';
import { Player } from './player';
import { kMostShade } from './shade';
import { Stage } from './stage';
import { Take, type TakeMeta } from './tracks';
import { applyView, firstSide, viewsOf, type View } from './views';

const kLastShown = 400; // ms, of the last picture of a film

function fail(message: string): void {
  const box = byId('message');
  box.textContent = message;
  box.hidden = false;
  byId('bar').hidden = true;
  document.getElementById('poster')?.style.setProperty('opacity', '0.25'); // the words are over it
}

function main(): void {
  const started = performance.now();
  const take = new Take(JSON.parse(byId('meta').textContent ?? '') as TakeMeta, byId('data').textContent ?? '');
  byId('data').textContent = '';
  const decodeMilliseconds = performance.now() - started;

  const bounds = boundsOf(take);
  const asked = new URLSearchParams(location.hash.slice(1));
  const picture = asked.has('picture');
  let stage: Stage;
  try {
    stage = new Stage(byId<HTMLCanvasElement>('view'), firstSide(take, bounds), picture, asked.has('check'));
  } catch {
    fail('This replay needs WebGL 2, which this browser does not offer (or has switched off).');
    return;
  }
  const { meta } = take;
  const bricks = meta.bodies.filter((body) => body.role === 'brick').length;
  const movable = meta.bodies.filter((body) => body.mass > 0).length;
  byId('title').textContent = meta.title || meta.scene;
  byId('subtitle').textContent = `${bricks > 0 ? counted(bricks, 'brick', 'bricks') : counted(movable, 'body', 'bodies')} \u00b7 ${take.times[take.frames - 1].toFixed(1)} s \u00b7 Brickfall ${meta.engineVersion}`;

  const player = new Player(take.frames, meta.framesPerSecond);
  const bodies = new Bodies(take, stage.scene, stage);
  const mortar = new Mortar(take, bodies, stage.scene);
  const dust = new Dust(take, stage.scene);
  const arrows = new Arrows(take, stage.scene);
  const card = new Card(byId('card'), take);
  stage.resize();
  stage.fitShadows(bounds.most.clone().expandByScalar(0.1 * bounds.most.getSize(new Vector3()).length()));
  stage.shade.setReach(usualSize(take));

  // In shares of the picture: what the title and the bar leave. The style sheet is told, too.
  const freeHeight = () => {
    const height = Math.max(1, window.innerHeight);
    const head = byId('head').getBoundingClientRect().bottom;
    const bar = byId('bar').getBoundingClientRect().top;
    document.documentElement.style.setProperty('--head', `${head}px`);
    document.documentElement.style.setProperty('--bar', `${height - bar}px`);
    return { top: 1 - (2 * head) / height, bottom: 1 - (2 * bar) / height };
  };
  for (const id of ['head', 'bar']) new ResizeObserver(freeHeight).observe(byId(id));
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
  const seenBy = (one: View): Vector3 | null => {
    if (one.turnsAfter === undefined || !take.isThere(player.frame, one.turnsAfter)) return null;
    return new Vector3().setFromMatrixPosition(bodies.pose(one.turnsAfter, player.position, new Matrix4()));
  };
  const placeCamera = (): void =>
    applyView(stage, view, view === views[0] || view.follows >= 0, take.timeAt(player.position), bounds, seenBy(view));
  const setView = (index: number): void => {
    view = views[index] ?? views[0];
    placeCamera();
    untouched = true;
    if (view.follows >= 0) {
      followed.last.copy(view.target);
      followed.now.copy(view.target);
    }
    dirty = true;
  };
  const setColour = (mode: ColourMode): void => {
    bodies.setColourMode(mode);
    mortar.setColourMode(mode);
    byId('legend').hidden = mode === 'material';
    const [low, middle, high] = legendOf(mode, take);
    byId('legend-low').textContent = low;
    byId('legend-bar').textContent = middle;
    byId('legend-high').textContent = high;
    dirty = true;
  };
  byId('legend-bar').style.background = scaleGradient();
  const savePicture = (): void => {
    draw();
    stage.renderer.domElement.toBlob((blob) => blob && offer(blob, `${meta.scene}_${take.times[player.frame].toFixed(2)}s.png`), 'image/png');
  };
  const turn = (aside: number, up: number, farther: number): void => {
    stage.turn(aside, up, farther);
    untouched = false;
    dirty = true;
  };
  const setArrows = (kind: ArrowKind): void => {
    arrows.kind = kArrowKinds.includes(kind) ? kind : 'none';
    dirty = true;
  };
  const nextArrows = (): void => {
    arrows.next();
    dirty = true;
  };
  // From here to the end, in the time that it takes to show; pressed again it ends there.
  let recorder: MediaRecorder | null = null;
  let filmed = 0; // ms, until when the run was playing; 0: it has not begun
  const film = (): void => {
    if (byId('record').hidden) return;
    if (recorder) return recorder.stop();
    const chunks: Blob[] = [];
    filmed = 0;
    recorder = new MediaRecorder(stage.renderer.domElement.captureStream(60), { videoBitsPerSecond: 12e6 });
    recorder.ondataavailable = (event) => chunks.push(event.data);
    recorder.onstop = () => {
      offer(new Blob(chunks, { type: 'video/webm' }), `${meta.scene}.webm`);
      recorder = null;
      byId('record').setAttribute('aria-pressed', 'false');
    };
    // It goes on from here once somebody takes it in: the last tenths of a second would be over before.
    recorder.onstart = () => {
      player.play();
      filmed = performance.now();
    };
    byId('record').setAttribute('aria-pressed', 'true');
    controls.setLoop(false);
    recorder.start();
  };
  byId('record').hidden = typeof MediaRecorder === 'undefined' || !MediaRecorder.isTypeSupported('video/webm');
  const controls = new Controls(take, player, { setColour, setView, savePicture, film, turn, nextArrows, deselect: () => select(-1) }, views.map((v) => v.name));
  const chart = new Chart(take, player);
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
    mortar.show(player.position);
    const half = Math.tan((stage.camera.fov * Math.PI) / 360);
    dust.show(player.position, stage.renderer.domElement.height / (2 * half));
    arrows.show(player.frame, stage.camera.position);
    controls.show();
    chart.show(take.timeAt(player.position));
    card.show(player.frame);
    stage.render(shown !== player.position);
    shown = player.position;
  };
  let shown = -1; // the place in time that the picture has
  let last = performance.now();
  let ticks = 0;
  let inRow = 0; // pictures that were drawn one after the other
  const tick = (now: number): void => {
    // Time counts from the first picture that is seen: shaders are made until then.
    if (ticks++ > 1) player.advance(Math.min(0.25, (now - last) / 1000));
    // It takes in what was shown for a while: the last picture, too.
    if (player.playing) filmed = now;
    if (recorder?.state === 'recording') {
      dirty = true; // a picture is taken in when it is drawn
      if (filmed > 0 && now - filmed > kLastShown) recorder.stop();
    }
    if (inRow > 1) stage.shade.judge(now - last);
    last = now;
    if (stage.resize()) {
      dirty = true;
      Object.assign(views[0], viewsOf(take, bounds, stage.camera.aspect, free())[0]);
      if (untouched && view.follows < 0) placeCamera();
    }
    if (dirty && untouched && (view.path || view.turnsAfter !== undefined)) placeCamera();
    if (view.follows >= 0 && dirty) {
      followed.now.set(...take.position(player.frame, view.follows));
      const shift = followed.now.clone().sub(followed.last);
      stage.camera.position.add(shift);
      stage.controls.target.add(shift);
      followed.last.copy(followed.now);
    }
    stage.controls.update();
    inRow = dirty ? inRow + 1 : 0;
    if (dirty) {
      dirty = false;
      draw();
      api.drawn++;
    }
    requestAnimationFrame(tick);
  };

  const project = (body: number | [number, number, number]): [number, number] => {
    const p = new Vector3(...(typeof body === 'number' ? take.position(player.frame, body) : body)).project(stage.camera);
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
    meshes: bodies.meshes,
    names: meta.bodies.map((body) => body.name),
    kinds: meta.bodies.map((body) => body.parts.map((_, part) => kindOf(body, part))),
    views: views.map((v) => v.name),
    play: () => player.play(),
    pause: () => player.pause(),
    seek: (frame: number) => { player.pause(); player.seek(frame); },
    setSpeed: (speed: number) => controls.setSpeed(speed),
    setLoop: (on: boolean) => controls.setLoop(on),
    setColour: (mode: ColourMode) => { controls.setColour(mode); setColour(mode); },
    setArrows,
    get arrows() { return { kind: arrows.kind, count: arrows.count }; },
    velocity: (body: number, frame = player.frame) => arrows.velocity(frame, body)?.toArray() ?? null,
    netForce: (body: number, frame = player.frame) => arrows.force(frame, body)?.toArray() ?? null,
    setView: (index: number) => { controls.setView(index); setView(index); },
    get chartShown() { return chart.shown; },
    setShade: (level: number) => { stage.shade.hold(level); dirty = true; },
    lookFrom: (position: [number, number, number], target: [number, number, number]) => {
      stage.look(new Vector3(...position), new Vector3(...target), view.fieldOfView);
      untouched = false;
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
    mortar: (joint: number, frame = player.frame) => take.mortar(frame, joint),
    contactForce: (body: number, frame = player.frame) => take.force(frame, body),
    get camera() {
      return { position: stage.camera.position.toArray(), target: stage.controls.target.toArray(), fieldOfView: stage.camera.fov };
    },
    project,
  };
  Object.assign(window, { brickfall: api });

  const takeWishes = (): URLSearchParams => {
    const wishes = new URLSearchParams(location.hash.slice(1));
    document.body.classList.toggle('picture', wishes.has('picture'));
    if (wishes.has('shade')) api.setShade(Number(wishes.get('shade')));
    else if (wishes.has('picture')) api.setShade(kMostShade);
    if (wishes.has('arrows')) setArrows(wishes.get('arrows') as ArrowKind);
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
  dirty = false; // it is seen until something changes: drawn twice it would come twice as late where no graphics card draws
  api.drawn = 1;
  api.ready = true;
  if (!wishes.has('paused') && !window.matchMedia('(prefers-reduced-motion: reduce)').matches) player.play();
  requestAnimationFrame((now) => {
    document.getElementById('poster')?.remove();
    last = now;
    tick(now);
  });
}

function counted(count: number, one: string, many: string): string {
  return `${count} ${count === 1 ? one : many}`;
}

// m: half of the bodies are larger.
function usualSize(take: Take): number {
  const sizes = take.meta.bodies.map((body, k) => (body.role === 'ground' ? 0 : sizeOf(take, k))).filter((size) => size > 0);
  return sizes.sort((a, b) => a - b)[Math.floor(sizes.length / 2)] ?? 0.15;
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
