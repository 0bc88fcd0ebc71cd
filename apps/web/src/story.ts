// Of the selected body: how its mortar is, and why it fell. docs/mortar.md says what the words mean.
import { amountOf } from './colours';
import type { BreakMeta, Take } from './tracks';

const kFell = 0.02; // m: what moved less stands
const kMostOpened = 6;

function line(tag: string, content: string, className = ''): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = content;
  if (className) element.className = className;
  return element;
}

function percent(share: number): string {
  return `${Math.round(100 * share)}\u00a0%`;
}

export function modeWords(broken: BreakMeta): string {
  if (broken.mode === 'crushing') return 'crushed';
  const words = broken.mode === 'shear' ? 'sheared off' : 'pulled open';
  const both = broken.tension > 0.005 && broken.shear > 0.005;
  return both ? `${words} (${percent(broken.shear)} of its energy in shear, ${percent(broken.tension)} in tension)` : words;
}

export class Story {
  private readonly joints = new Map<number, number[]>(); // by body
  private readonly breakOf = new Map<number, number>(); // by joint: which of the breaks
  private readonly first = new Map<number, number>(); // by body: which of the breaks
  private readonly box = document.createElement('div');
  private body = -1;
  private shown = '';

  constructor(private readonly take: Take, private readonly onSeek: (frame: number) => void) {
    take.meta.mortar?.forEach((joint, k) => {
      for (const body of [joint.a, joint.b]) this.joints.set(body, [...(this.joints.get(body) ?? []), k]);
    });
    take.meta.breaks?.forEach((broken, k) => this.breakOf.set(broken.joint, k));
    take.meta.falls?.forEach(([body, broken]) => this.first.set(body, broken));
    this.box.className = 'story';
  }

  select(body: number): HTMLElement {
    this.body = body;
    this.shown = '';
    this.box.replaceChildren();
    return this.box;
  }

  private name(body: number): string {
    return this.take.meta.bodies[body].name;
  }

  private moment(broken: BreakMeta): HTMLElement {
    const frame = this.take.frameAt(broken.time);
    const link = document.createElement('a');
    link.href = '#';
    link.textContent = `${broken.time.toFixed(2)} s`;
    link.onclick = (event) => {
      event.preventDefault();
      this.onSeek(frame);
    };
    return link;
  }

  private why(broken: BreakMeta): HTMLElement[] {
    const joint = this.take.meta.mortar![broken.joint];
    const own = joint.a === this.body || joint.b === this.body;
    const head = line('p', '');
    head.append(this.moment(broken), ` ${own ? 'its' : 'the'} mortar ${own ? `to ${this.name(joint.a === this.body ? joint.b : joint.a)}` : `of ${this.name(joint.a)} and ${this.name(joint.b)}`} gave way first: ${modeWords(broken)}. It had borne ${amountOf(broken.force, 'N')}.`);
    const out = [head];
    if (broken.takers.length > 0) {
      out.push(line('p', 'Its load went to:'));
      const list = document.createElement('ul');
      for (const taker of broken.takers) {
        const what = taker.joint < 0 ? 'contact of ' : 'mortar of ';
        list.append(line('li', `${what}${this.name(taker.a)} and ${this.name(taker.b)}: ${amountOf(taker.before, 'N')} \u2192 ${amountOf(taker.after, 'N')}`));
      }
      out.push(list);
    } else {
      out.push(line('p', 'Nothing beside it bore more afterwards.'));
    }
    return out;
  }

  private opened(broken: BreakMeta): HTMLElement {
    const joint = this.take.meta.mortar![broken.joint];
    const item = line('li', '');
    item.append(this.moment(broken), line('span', this.name(joint.a === this.body ? joint.b : joint.a)), line('span', broken.mode));
    return item;
  }

  // moved: m, from where it was first.
  show(frame: number, moved: number): void {
    const joints = this.joints.get(this.body);
    if (this.body < 0 || !joints) return;
    const states = joints.map((joint) => this.take.mortar(frame, joint)).filter((state) => state !== null);
    const holds = states.filter((state) => state[1] < 1);
    const used = Math.max(0, ...holds.map((state) => state[0]));
    const time = this.take.times[frame] + 1e-6;
    const first = this.take.meta.breaks?.[this.first.get(this.body) ?? -1];
    const fell = first !== undefined && first.time <= time && moved > kFell ? first : undefined;
    const breaks = joints.map((joint) => this.take.meta.breaks?.[this.breakOf.get(joint) ?? -1]);
    const opened = breaks.filter((broken) => broken !== undefined && broken.time <= time).map((broken) => broken!);
    const key = `${holds.length} ${states.length} ${Math.round(100 * used)} ${fell?.joint} ${opened.length}`;
    if (key === this.shown) return;
    this.shown = key;
    const counts = holds.length > 0 ? `${holds.length} of ${states.length} joints hold, used up to ${percent(used)}` : `none of ${states.length} joints holds`;
    this.box.replaceChildren(line('h3', 'Mortar'), line('p', counts));
    if (fell) this.box.append(line('h3', 'Why it fell'), ...this.why(fell));
    if (opened.length === 0) return;
    const list = document.createElement('ol');
    opened.sort((a, b) => a.time - b.time);
    list.append(...opened.slice(0, kMostOpened).map((broken) => this.opened(broken)));
    this.box.append(line('h3', `Its joints that broke: ${opened.length}`), list);
  }
}
