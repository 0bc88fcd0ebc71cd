// Figures over time, as series.csv has them: one chart with the moment that is shown.
import { byId } from './controls';
import type { Player } from './player';
import type { Take } from './tracks';

interface Choice {
  name: string;
  unit: string;
  columns: string[];
}
const kChoices: Choice[] = [
  { name: 'Energy', unit: 'J', columns: ['kinetic_way_j', 'kinetic_turn_j', 'potential_j', 'lost_j'] },
  { name: 'Kinetic energy', unit: 'J', columns: ['kinetic_way_j', 'kinetic_turn_j'] },
  { name: 'Momentum', unit: 'kg m/s', columns: ['momentum_x_kg_m_s', 'momentum_y_kg_m_s', 'momentum_z_kg_m_s'] },
  { name: 'Moving bodies', unit: '', columns: ['moving_bodies', 'awake_bodies'] },
  { name: 'Broken', unit: '', columns: ['bricks_moved_50mm', 'broken_mortar', 'broken_joints'] },
  { name: 'Largest force', unit: 'N', columns: ['largest_force_n'] },
];
const kColours = ['#e8835f', '#f2cf7a', '#7fb4d8', '#b5b9bd'];

// "kinetic_way_j" as a word for people: "kinetic way"
const labelOf = (column: string): string => column.replace(/_(j|n|kg_m_s)$/, '').replace(/_/g, ' ');
const short = (value: number): string => (Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 0.01) ? value.toExponential(1) : String(Number(value.toPrecision(3))));

export class Chart {
  private readonly box = byId('chart');
  private readonly canvas = byId<HTMLCanvasElement>('chart-canvas');
  private readonly choice = byId<HTMLSelectElement>('chart-choice');
  private readonly value = byId<HTMLOutputElement>('chart-value');
  private readonly button = byId<HTMLButtonElement>('chart-button');
  private readonly choices: Choice[];
  private time = 0;

  constructor(private readonly take: Take, private readonly player: Player) {
    const series = take.meta.series ?? {};
    this.choices = (series.time_s?.length ?? 0) > 1 ? kChoices.filter((c) => c.columns.every((name) => name in series)) : [];
    if (this.choices.length === 0) return;
    this.button.hidden = false;
    this.button.innerHTML = '<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M1.500 2h1.500v10.500h11.500v1.500h-13zM4.500 10.800 7 6.300l2.300 2.300 3.600-5.300 1.200.8-4.600 6.900-2.200-2.200-1.500 2.800z"/></svg>';
    this.choice.replaceChildren(...this.choices.map((c, k) => new Option(c.name, String(k))));
    this.button.onclick = () => this.toggle();
    this.choice.onchange = () => this.draw();
    this.canvas.onpointerdown = (event) => this.seekTo(event);
    this.canvas.onpointermove = (event) => event.buttons > 0 && this.seekTo(event);
    window.addEventListener('keydown', (event) => {
      if (event.key === 'e' && !event.ctrlKey && !event.metaKey && !event.altKey) this.toggle();
    });
  }

  get shown(): boolean { return !this.box.hidden; }

  toggle(): void {
    if (this.choices.length === 0) return;
    this.box.hidden = !this.box.hidden;
    this.button.setAttribute('aria-pressed', String(this.shown));
    this.draw();
  }

  show(time: number): void {
    this.time = time;
    if (this.shown) this.draw();
  }

  private seekTo(event: PointerEvent): void {
    const times = this.take.meta.series!.time_s;
    const share = Math.min(1, Math.max(0, event.offsetX / Math.max(1, this.canvas.clientWidth)));
    this.player.pause();
    this.player.seek(this.take.frameAt(times[0] + share * (times[times.length - 1] - times[0])));
  }

  private draw(): void {
    if (!this.shown) return;
    const series = this.take.meta.series!;
    const { columns, unit } = this.choices[Number(this.choice.value)];
    const times = series.time_s;
    const [from, to] = [times[0], times[times.length - 1]];
    let low = 0;
    let high = 0;
    for (const name of columns) for (const value of series[name]) { low = Math.min(low, value); high = Math.max(high, value); }
    if (high === low) high = low + 1;
    const ratio = window.devicePixelRatio || 1;
    const width = (this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio)));
    const height = (this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio)));
    const context = this.canvas.getContext('2d');
    if (!context) return;
    const x = (time: number) => ((time - from) / (to - from)) * (width - 1);
    const y = (value: number) => height - 2 - ((value - low) / (high - low)) * (height - 4);
    context.lineWidth = 1;
    context.strokeStyle = 'rgba(255, 255, 255, 0.25)';
    context.beginPath();
    context.moveTo(0, y(0));
    context.lineTo(width, y(0));
    context.stroke();
    context.lineWidth = 1.5 * ratio;
    columns.forEach((name, k) => {
      context.strokeStyle = kColours[k];
      context.beginPath();
      series[name].forEach((value, i) => context.lineTo(x(times[i]), y(value)));
      context.stroke();
    });
    context.strokeStyle = 'rgba(255, 255, 255, 0.8)';
    context.lineWidth = ratio;
    context.beginPath();
    context.moveTo(x(this.time), 0);
    context.lineTo(x(this.time), height);
    context.stroke();
    let at = 0;
    while (at + 1 < times.length && times[at + 1] <= this.time + 1e-6) at++;
    this.value.replaceChildren(...columns.map((name, k) => {
      const span = document.createElement('span');
      span.textContent = `${labelOf(name)} ${short(series[name][at])} ${unit}`.trim() + (k + 1 < columns.length ? ' \u00b7 ' : '');
      span.style.color = kColours[k];
      return span;
    }));
  }
}
