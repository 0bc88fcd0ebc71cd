// Where the replay is in time, and how it moves on.
export class Player {
  position = 0; // frames, with a fraction while playing
  playing = false;
  speed = 1;
  loop = false;
  onChange: () => void = () => {};

  constructor(readonly frames: number, private readonly framesPerSecond: number) {}

  get frame(): number {
    return Math.round(this.position);
  }
  seek(position: number): void {
    this.position = Math.min(this.frames - 1, Math.max(0, Number.isFinite(position) ? position : 0));
    this.onChange();
  }
  step(frames: number): void {
    this.playing = false;
    this.seek(this.frame + frames);
  }
  play(): void {
    if (this.position >= this.frames - 1) this.position = 0;
    this.playing = this.frames > 1;
    this.onChange();
  }
  pause(): void {
    this.playing = false;
    this.onChange();
  }
  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }
  // seconds: real time since the last call.
  advance(seconds: number): void {
    if (!this.playing) return;
    this.position += seconds * this.framesPerSecond * this.speed;
    const last = this.frames - 1;
    if (this.position >= last) {
      if (this.loop) {
        this.position %= last;
      } else {
        this.position = last;
        this.playing = false;
      }
    }
    this.onChange();
  }
}
