/**
 * The machine turning: the drawing of the core, moved by its track. Any link can be dragged; the machine follows to the nearest position that puts
 * the point under the pointer.
 */
import { h, svgOf } from './dom';
import type { Drawing } from './protocol';
import type { Texts } from './texts';

/** Time (s) of a turn while it plays. */
const TURN = 5;
/** Frames, each way, among which a dragged link looks for its place: it does not jump to another branch. */
const REACH = 30;

interface Moved {
  element: SVGElement;
  /** First of its numbers in a frame. */
  at: number;
}

interface Grip {
  links: number;
  /** The grabbed point in the frame of its link. */
  u: number;
  v: number;
}

export class Picture {
  readonly element: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly play: HTMLButtonElement;
  private readonly place: HTMLOutputElement;
  private svg: SVGSVGElement | undefined;
  private drawing: Drawing | undefined;
  private links: Moved[] = [];
  private points: Moved[] = [];
  /** Frame, not always whole. */
  private frame = 0;
  private way = 1;
  private running = false;
  private last: number | undefined;
  private grip: Grip | undefined;
  /** Unit of a position: "deg", or "mm" of a drive link that slides. */
  unit = 'deg';

  /** `moved` is told the position (deg or mm) of every picture. */
  constructor(private readonly texts: Texts, private readonly moved: (position: number) => void) {
    this.stage = h('div', { class: 'stage', role: 'img', 'aria-label': texts.drawingOf });
    this.slider = h('input', { type: 'range', min: 0, step: 'any', value: 0, 'aria-label': texts.position, oninput: () => this.slid() });
    this.slider.addEventListener('keydown', (event) => this.key(event));
    this.play = h('button', { type: 'button', class: 'play', onclick: () => this.run(!this.running) });
    this.place = h('output', { class: 'place' });
    this.element = h('div', { class: 'picture' }, this.stage, h('div', { class: 'player' }, this.play, this.slider, this.place));
    this.stage.addEventListener('pointerdown', (event) => this.grab(event));
    this.stage.addEventListener('pointermove', (event) => this.drag(event));
    for (const end of ['pointerup', 'pointercancel']) this.stage.addEventListener(end, () => this.release());
    this.run(false);
    document.addEventListener('visibilitychange', () => (this.last = undefined));
  }

  /** Another drawing; it stays at its position, and goes on playing. */
  show(drawing: Drawing, title: string): void {
    const first = this.drawing === undefined;
    const share = first ? 0 : this.frame / Math.max(1, this.drawing!.track.positions.length);
    this.drawing = drawing;
    const count = drawing.track.positions.length;
    this.frame = first ? drawing.track.first : Math.min(count - 1, share * count);
    this.svg = svgOf(drawing.svg);
    this.svg.setAttribute('aria-hidden', 'true');
    this.stage.replaceChildren(this.svg);
    this.stage.setAttribute('aria-label', `${this.texts.drawingOf} ${title}`);
    this.links = this.groups('data-link', 3);
    this.points = this.groups('data-point', 2);
    this.slider.max = String(count - 1);
    this.draw();
    if (first && !matchMedia('(prefers-reduced-motion: reduce)').matches) this.run(true);
  }

  run(on: boolean): void {
    this.running = on;
    this.last = undefined;
    this.play.textContent = on ? this.texts.pause : this.texts.play;
    if (on) requestAnimationFrame((now) => this.tick(now));
  }

  private groups(name: string, numbers: number): Moved[] {
    const found = [...this.svg!.querySelectorAll<SVGElement>(`[${name}]`)];
    return found.map((element) => ({ element, at: numbers * Number(element.getAttribute(name)) }));
  }

  private tick(now: number): void {
    if (!this.running || !this.drawing) return;
    const { positions, turn } = this.drawing.track;
    const count = positions.length;
    if (this.last !== undefined) {
      const next = this.frame + (this.way * count * Math.min(100, now - this.last)) / (1000 * TURN);
      if (!turn && (next >= count - 1 || next <= 0)) this.way = next <= 0 ? 1 : -1;
      this.frame = turn ? (next + count) % count : Math.min(count - 1, Math.max(0, next));
    }
    this.last = now;
    this.draw();
    requestAnimationFrame((then) => this.tick(then));
  }

  /** The frames before and after a place between frames, and how far it is from the first. */
  private around(frame: number): [number, number, number] {
    const { positions, turn } = this.drawing!.track;
    const count = positions.length;
    const k = Math.min(count - 1, Math.max(0, Math.floor(frame)));
    return [k, turn ? (k + 1) % count : Math.min(count - 1, k + 1), frame - k];
  }

  /** x, y and angle (deg) of a link between frames. */
  private pose(frame: number, at: number): [number, number, number] {
    const [k, next, part] = this.around(frame);
    const [a, b] = [this.drawing!.track.links[k]!, this.drawing!.track.links[next]!];
    const between = (n: number): number => a[n]! + part * (b[n]! - a[n]!);
    const turn = b[at + 2]! - a[at + 2]!;
    return [between(at), between(at + 1), a[at + 2]! + part * (turn - 360 * Math.round(turn / 360))];
  }

  private draw(): void {
    const { positions, points } = this.drawing!.track;
    for (const { element, at } of this.links) {
      const [x, y, angle] = this.pose(this.frame, at);
      element.setAttribute('transform', `translate(${x} ${y}) rotate(${angle})`);
    }
    const [k, next, part] = this.around(this.frame);
    const [p, q] = [points[k]!, points[next]!];
    for (const { element, at } of this.points) {
      const [x, y] = [p[at]! + part * (q[at]! - p[at]!), p[at + 1]! + part * (q[at + 1]! - p[at + 1]!)];
      element.setAttribute('transform', `translate(${x} ${y})`);
    }
    // All steps are equal; that from the last frame to the first has no other end.
    const position = positions[k]! + part * (positions[1]! - positions[0]!);
    const words = `${position.toFixed(1)} ${this.unit === 'deg' ? '°' : this.unit}`;
    this.slider.value = String(this.frame);
    this.slider.setAttribute('aria-valuetext', words);
    this.place.textContent = `${this.unit === 'deg' ? 'φ' : 's'} = ${words}`;
    this.moved(position);
  }

  private slid(): void {
    this.run(false);
    this.frame = Number(this.slider.value);
    this.draw();
  }

  /** Arrows move by a frame, with Shift by ten; a turn goes on at its end. */
  private key(event: KeyboardEvent): void {
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (way === undefined || !this.drawing) return;
    event.preventDefault();
    this.run(false);
    const count = this.drawing.track.positions.length;
    const next = Math.round(this.frame) + way * (event.shiftKey ? 10 : 1);
    this.frame = this.drawing.track.turn ? (next + count) % count : Math.min(count - 1, Math.max(0, next));
    this.draw();
  }

  private at(event: PointerEvent): { x: number; y: number } {
    const matrix = this.svg!.getScreenCTM()!.inverse();
    return new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
  }

  private grab(event: PointerEvent): void {
    const group = (event.target as Element).closest?.('[data-link]');
    if (!group || !this.drawing) return;
    event.preventDefault();
    this.stage.setPointerCapture(event.pointerId);
    this.run(false);
    const links = 3 * Number(group.getAttribute('data-link'));
    const [x, y, angle] = this.pose(this.frame, links);
    const pointer = this.at(event);
    const [dx, dy] = [pointer.x - x, pointer.y - y];
    const [sin, cos] = circle(angle);
    this.grip = { links, u: dx * cos + dy * sin, v: dy * cos - dx * sin };
    this.stage.classList.add('held');
  }

  private drag(event: PointerEvent): void {
    if (!this.grip || !this.drawing) return;
    const { links, u, v } = this.grip;
    const pointer = this.at(event);
    const count = this.drawing.track.positions.length;
    const turn = this.drawing.track.turn;
    const on = (frame: number): number => (turn ? (frame + count) % count : Math.min(count - 1, Math.max(0, frame)));
    const off = (frame: number): number => {
      const [x, y, angle] = this.pose(frame, links);
      const [sin, cos] = circle(angle);
      return Math.hypot(x + u * cos - v * sin - pointer.x, y + u * sin + v * cos - pointer.y);
    };
    let best = { frame: this.frame, off: off(this.frame) };
    const search = (step: number, steps: number): void => {
      const middle = best.frame;
      for (let k = -steps; k <= steps; k++) {
        const frame = on(middle + k * step);
        const away = off(frame);
        if (away < best.off) best = { frame, off: away };
      }
    };
    search(1, REACH);
    search(0.2, 4);
    this.frame = best.frame;
    this.draw();
  }

  private release(): void {
    this.grip = undefined;
    this.stage.classList.remove('held');
  }
}

function circle(degrees: number): [number, number] {
  const angle = (degrees * Math.PI) / 180;
  return [Math.sin(angle), Math.cos(angle)];
}
