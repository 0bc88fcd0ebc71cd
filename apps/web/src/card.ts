// The card of the selected body: what it is, what it does at this moment, what it has taken.
import { amountOf as amount } from './colours';
import { Story } from './story';
import type { Hit, Take } from './tracks';

const kMostHits = 8;

function text(tag: string, content: string, className = ''): HTMLElement {
  const element = document.createElement(tag);
  element.textContent = content;
  if (className) element.className = className;
  return element;
}

export class Card {
  private values = new Map<string, HTMLElement>();
  private hits: Hit[] = [];
  private items: HTMLElement[] = [];
  private body = -1;
  private readonly story: Story;
  onSeek: (frame: number) => void = () => {};
  onClose: () => void = () => {};

  constructor(private readonly element: HTMLElement, private readonly take: Take) {
    this.story = new Story(take, (frame) => this.onSeek(frame));
  }

  select(body: number): void {
    this.body = body;
    this.element.hidden = body < 0;
    this.element.replaceChildren();
    this.values.clear();
    if (body < 0) return;
    const meta = this.take.meta.bodies[body];
    const title = text('h2', meta.name || `body ${body}`);
    const swatch = text('span', '', 'swatch');
    swatch.style.background = `#${meta.colour.toString(16).padStart(6, '0')}`;
    title.prepend(swatch);
    const close = text('button', '\u00d7', 'close');
    close.setAttribute('aria-label', 'Close');
    close.onclick = () => this.onClose();
    const list = document.createElement('dl');
    for (const name of ['Number', 'Kind', 'Mass', 'Speed', 'Contact force', 'Height', 'Moved']) {
      const value = document.createElement('dd');
      this.values.set(name, value);
      list.append(text('dt', name), value);
    }
    this.element.append(close, title, list, this.story.select(body), this.hitList(body));
    this.values.get('Number')!.textContent = String(body);
    this.values.get('Kind')!.textContent = meta.role;
    this.values.get('Mass')!.textContent = meta.mass > 0 ? amount(meta.mass, 'kg') : 'fixed';
  }

  // The strongest hits, in the order of time; each leads to its moment.
  private hitList(body: number): HTMLElement {
    const all = this.take.hits.filter((hit) => hit.a === body || hit.b === body);
    this.hits = [...all].sort((a, b) => b.impulse - a.impulse).slice(0, kMostHits).sort((a, b) => a.frame - b.frame);
    const box = document.createElement('div');
    box.append(text('h3', all.length > kMostHits ? `Hits taken: ${all.length}, the strongest` : `Hits taken: ${all.length}`));
    const list = document.createElement('ol');
    this.items = this.hits.map((hit) => {
      const other = this.take.meta.bodies[hit.a === body ? hit.b : hit.a];
      const item = document.createElement('li');
      const link = document.createElement('a');
      link.href = '#';
      link.append(text('span', `${this.take.times[hit.frame].toFixed(2)} s`), text('span', other.name), text('span', amount(hit.impulse, 'N s')));
      link.onclick = (event) => {
        event.preventDefault();
        this.onSeek(hit.frame);
      };
      item.append(link);
      list.append(item);
      return item;
    });
    box.append(list);
    return box;
  }

  show(frame: number): void {
    if (this.body < 0) return;
    const { take, body } = this;
    const here = take.position(frame, body);
    const start = take.position(0, body); // or where it came
    const moved = Math.hypot(here[0] - start[0], here[1] - start[1], here[2] - start[2]);
    const set = (name: string, value: string): void => {
      this.values.get(name)!.textContent = value;
    };
    const missing = frame < take.births[body] ? 'not there yet' : frame >= take.ends[body] ? 'no longer there' : '';
    set('Speed', missing || amount(take.speed(frame, body), 'm/s'));
    set('Contact force', amount(take.force(frame, body), 'N'));
    set('Height', amount(here[1], 'm'));
    set('Moved', moved < 0.1 ? amount(moved * 1000, 'mm') : amount(moved, 'm'));
    this.story.show(frame, moved);
    this.items.forEach((item, k) => item.classList.toggle('now', this.hits[k].frame === frame));
  }
}
