// The bar below the picture, and the keys.
import { colourModes, kColourNames, type ColourMode } from './colours';
import { icons } from './icons';
import type { Player } from './player';
import type { Take } from './tracks';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 4];
const kKeys: [string, string][] = [
  ['space', 'play or pause'], [', \u2190 and . \u2192', 'one frame back or on (with shift: ten)'], ['home, end', 'first or last frame'],
  ['- and +', 'slower or faster'], ['c', 'colour: material, speed, contact force; where there is mortar its use, its damage'], ['v', 'next camera'], ['a', 'arrows: velocities, forces, none'], ['l', 'loop'], ['p', 'save the picture'], ['r', 'film from here to the end, as a WebM file'], ['f', 'full screen'], ['e', 'figures over time: energy, forces'],
  ['arrows, page up and down, where the picture has the focus (tab)', 'turn, come closer and go back'],
  ['esc', 'let go of the selected brick'], ['h', 'this list'],
];

const kTurn = 0.1; // rad, a press of a key
const kNearer = 1.15; // times as far
const kMostTicks = 40; // of the strongest hits over the time

export function byId<T extends HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

function fill(select: HTMLSelectElement, names: string[], chosen: number): void {
  select.replaceChildren(...names.map((name, k) => new Option(name, String(k), k === chosen, k === chosen)));
}

export interface Actions {
  setColour(mode: ColourMode): void;
  setView(index: number): void;
  savePicture(): void;
  film(): void;
  turn(aside: number, up: number, farther: number): void;
  nextArrows(): void;
  deselect(): void;
}

export class Controls {
  private readonly scrub = byId<HTMLInputElement>('scrub');
  private readonly playButton = byId<HTMLButtonElement>('play');
  private readonly clock = byId<HTMLOutputElement>('clock');
  private readonly speed = byId<HTMLSelectElement>('speed');
  private readonly colour = byId<HTMLSelectElement>('colour');
  private readonly camera = byId<HTMLSelectElement>('camera');
  private readonly loop = byId<HTMLButtonElement>('loop');
  private readonly keys = byId<HTMLDialogElement>('keys');
  private readonly modes: ColourMode[];
  private shownPlaying: boolean | null = null;

  constructor(private readonly take: Take, private readonly player: Player, private readonly actions: Actions, viewNames: string[]) {
    this.scrub.max = String(player.frames - 1);
    fill(this.speed, kSpeeds.map((s) => `${s}\u00d7`), kSpeeds.indexOf(1));
    this.modes = colourModes(take);
    fill(this.colour, this.modes.map((mode) => kColourNames[mode]), 0);
    fill(this.camera, viewNames, 0);
    byId('back').innerHTML = icons.back;
    byId('forward').innerHTML = icons.forward;
    byId('help').innerHTML = icons.help;
    byId('save').innerHTML = icons.save;
    byId('record').innerHTML = icons.record;
    byId('full').innerHTML = icons.full;
    byId('full').hidden = !document.fullscreenEnabled;
    this.loop.innerHTML = icons.loop;
    const rows = kKeys.map(([key, what]) => `<tr><td><kbd>${key}</kbd></td><td>${what}</td></tr>`).join('');
    this.keys.innerHTML = `<table>${rows}</table>`;
    this.listen();
    this.drawActivity();
  }

  private listen(): void {
    const { player } = this;
    this.scrub.oninput = () => {
      player.pause();
      player.seek(Number(this.scrub.value));
    };
    this.playButton.onclick = () => player.toggle();
    byId('back').onclick = () => player.step(-1);
    byId('forward').onclick = () => player.step(1);
    this.speed.onchange = () => (player.speed = kSpeeds[Number(this.speed.value)]);
    this.colour.onchange = () => this.actions.setColour(this.modes[Number(this.colour.value)]);
    this.camera.onchange = () => this.actions.setView(Number(this.camera.value));
    this.loop.onclick = () => this.setLoop(!player.loop);
    byId('help').onclick = () => this.keys.showModal();
    byId('save').onclick = () => this.actions.savePicture();
    byId('record').onclick = () => this.actions.film();
    byId('full').onclick = () => this.fullScreen();
    this.keys.onclick = () => this.keys.close();
    window.addEventListener('keydown', (event) => this.onKey(event));
    window.addEventListener('resize', () => this.drawActivity());
  }

  private onKey(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { player } = this;
    const step = event.shiftKey ? 10 : 1;
    const doIt: Record<string, () => void> = {
      ' ': () => player.toggle(),
      ',': () => player.step(-step), '<': () => player.step(-step), ArrowLeft: () => player.step(-step),
      '.': () => player.step(step), '>': () => player.step(step), ArrowRight: () => player.step(step),
      Home: () => player.seek(0),
      End: () => player.step(player.frames),
      '-': () => this.changeSpeed(-1), '+': () => this.changeSpeed(1), '=': () => this.changeSpeed(1),
      c: () => this.next(this.colour), v: () => this.next(this.camera),
      a: () => this.actions.nextArrows(),
      l: () => this.setLoop(!player.loop),
      p: () => this.actions.savePicture(),
      r: () => this.actions.film(),
      f: () => this.fullScreen(),
      h: () => (this.keys.open ? this.keys.close() : this.keys.showModal()),
      Escape: () => this.actions.deselect(),
    };
    // Who came to the picture by the keyboard turns it; who clicked into it still steps through the frames.
    if (event.target instanceof HTMLCanvasElement && event.target.matches(':focus-visible')) {
      const turns: Record<string, [number, number, number]> = {
        ArrowLeft: [-kTurn, 0, 1], ArrowRight: [kTurn, 0, 1], ArrowUp: [0, kTurn, 1], ArrowDown: [0, -kTurn, 1], PageUp: [0, 0, 1 / kNearer], PageDown: [0, 0, kNearer],
      };
      Object.assign(doIt, Object.fromEntries(Object.entries(turns).map(([key, turn]) => [key, () => this.actions.turn(...turn)])));
    }
    const action = doIt[event.key];
    if (!action || (event.target instanceof HTMLSelectElement && (event.key === ' ' || event.key.startsWith('Arrow')))) return;
    // What has the focus is pressed by it.
    if (event.key === ' ' && event.target instanceof HTMLElement && event.target.closest('button, a')) return;
    event.preventDefault();
    action();
  }

  private fullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else if (document.fullscreenEnabled) void document.documentElement.requestFullscreen();
  }
  private next(select: HTMLSelectElement): void {
    select.selectedIndex = (select.selectedIndex + 1) % select.length;
    select.dispatchEvent(new Event('change'));
  }
  private changeSpeed(by: number): void {
    this.speed.selectedIndex = Math.min(kSpeeds.length - 1, Math.max(0, this.speed.selectedIndex + by));
    this.speed.dispatchEvent(new Event('change'));
  }
  setLoop(on: boolean): void {
    this.player.loop = on;
    this.loop.setAttribute('aria-pressed', String(on));
  }
  setColour(mode: ColourMode): void {
    this.colour.selectedIndex = this.modes.indexOf(mode);
  }
  setView(index: number): void {
    this.camera.selectedIndex = index;
  }
  setSpeed(speed: number): void {
    this.player.speed = speed;
    if (kSpeeds.includes(speed)) this.speed.selectedIndex = kSpeeds.indexOf(speed);
  }

  // How much moves, over the time: where something happens is seen before scrubbing there.
  private drawActivity(): void {
    const canvas = byId<HTMLCanvasElement>('activity');
    const ratio = window.devicePixelRatio || 1;
    const width = (canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio)));
    const height = (canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio)));
    const context = canvas.getContext('2d');
    if (!context) return;
    const { activity, frames } = this.take;
    let most = 1e-6;
    for (const a of activity) most = Math.max(most, a);
    context.beginPath();
    context.moveTo(0, height);
    for (let x = 0; x <= width; x++) {
      const f = Math.min(frames - 1, Math.round((x / width) * (frames - 1)));
      context.lineTo(x, height - Math.sqrt(activity[f] / most) * (height - 2));
    }
    context.lineTo(width, height);
    const fill = context.createLinearGradient(0, 0, 0, height);
    fill.addColorStop(0, 'rgba(232, 131, 95, 0.75)');
    fill.addColorStop(1, 'rgba(232, 131, 95, 0.12)');
    context.fillStyle = fill;
    context.fill();
    // Ticks of the strongest hits, the longer the harder.
    const hits = [...this.take.hits].sort((a, b) => b.impulse - a.impulse).slice(0, kMostTicks);
    context.fillStyle = 'rgba(255, 226, 122, 0.85)';
    for (const hit of hits) {
      const long = Math.max(2, Math.sqrt(hit.impulse / hits[0].impulse) * height * 0.45);
      context.fillRect(Math.round((hit.frame / Math.max(1, frames - 1)) * (width - ratio)), 0, ratio, long);
    }
  }

  show(): void {
    const { player, take } = this;
    const frame = player.frame;
    this.scrub.value = String(frame);
    this.scrub.setAttribute('aria-valuetext', `${take.times[frame].toFixed(2)} seconds`);
    this.scrub.style.setProperty('--done', `${(100 * player.position) / Math.max(1, player.frames - 1)}%`);
    const total = take.times[take.frames - 1];
    const digits = String(take.frames - 1).length;
    this.clock.innerHTML = `${take.times[frame].toFixed(2)} s <small>of ${total.toFixed(2)} s \u00b7 frame ${String(frame).padStart(digits, '\u2007')}</small>`;
    if (this.shownPlaying !== player.playing) {
      this.shownPlaying = player.playing;
      this.playButton.innerHTML = player.playing ? icons.pause : icons.play;
      this.playButton.setAttribute('aria-label', player.playing ? 'Pause' : 'Play');
    }
  }
}
