/** The sheet on which a linkage is drawn: joints are dragged, links made from joint to joint. Everything can be reached and moved by keyboard. */
import { s } from '../dom';
import type { Linkage } from '../protocol';
import type { Texts } from '../texts';
import { addLink, addPoint, centre, changeBody, inFrame, movePoint, toggleOnLink, type Body, type Point } from './linkage';

export type Tool = 'move' | 'pin' | 'ground' | 'link';
export type Selected = { kind: 'point' | 'body'; name: string } | undefined;

export interface Sheet {
  readonly linkage: Linkage;
  readonly selected: Selected;
  readonly tool: Tool;
  /** Another linkage; steps of one `tag` are undone together. */
  change(linkage: Linkage, tag: string): void;
  select(selected: Selected): void;
  remove(): void;
}

/** Distance (px of the screen) within which a pointer takes a joint. */
const NEAR = 22;
const ROUND = 1;

export class Canvas {
  readonly element: SVGSVGElement;
  private view = { x: -80, y: -220, width: 420, height: 300 };
  private held: { kind: 'point' | 'com' | 'line'; name: string } | undefined;
  private line: SVGLineElement | undefined;

  constructor(private readonly texts: Texts, private readonly sheet: Sheet) {
    this.element = s('svg', { class: 'sheet-canvas', role: 'group', 'aria-label': texts.drawingSheet });
    this.element.addEventListener('pointerdown', (event) => this.down(event));
    this.element.addEventListener('pointermove', (event) => this.move(event));
    this.element.addEventListener('pointerup', (event) => this.up(event));
    this.element.addEventListener('pointercancel', () => this.let());
    this.element.addEventListener('keydown', (event) => this.key(event));
  }

  /** Shows the whole linkage with room around. */
  fit(): void {
    const { points } = this.sheet.linkage;
    const xs = points.map(({ x }) => x);
    const ys = points.map(({ y }) => -y);
    const [left, right, top, bottom] = points.length > 0
      ? [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)]
      : [0, 300, -200, 0];
    const room = 0.3 * Math.max(right - left, bottom - top, 100);
    this.view = { x: left - room, y: top - room, width: right - left + 2 * room, height: bottom - top + 2 * room };
    this.draw();
  }

  draw(): void {
    const { view } = this;
    const { linkage, selected } = this.sheet;
    const focused = this.element.contains(document.activeElement) ? document.activeElement?.getAttribute('data-key') : null;
    this.element.setAttribute('viewBox', `${view.x} ${view.y} ${view.width} ${view.height}`);
    const unit = Math.max(view.width, view.height) / 500;
    this.element.style.setProperty('--unit', `${unit}px`);
    const place = (name: string): Point | undefined => linkage.points.find((point) => point.name === name);
    const grid = 10 ** Math.floor(Math.log10(view.width / 3));
    const parts: SVGElement[] = [
      s('defs', {}, s('pattern', { id: 'grid', width: grid, height: grid, patternUnits: 'userSpaceOnUse' },
        s('path', { d: `M${grid} 0H0V${grid}`, class: 'grid', 'stroke-width': unit }))),
      s('rect', { x: view.x - view.width, y: view.y - view.height, width: 3 * view.width, height: 3 * view.height, fill: 'url(#grid)' }),
      s('path', { class: 'scale', d: `M${view.x + 8 * unit} ${view.y + view.height - 8 * unit}h${grid}`, 'stroke-width': 3 * unit }),
      s('text', { transform: `translate(${view.x + 8 * unit} ${view.y + view.height - 14 * unit}) scale(${unit})` }, `${grid} mm`),
    ];
    for (const guide of linkage.guides) {
      const at = place(guide.point);
      if (!at) continue;
      const angle = (-guide.angle * Math.PI) / 180;
      const [dx, dy] = [70 * unit * Math.cos(angle), 70 * unit * Math.sin(angle)];
      parts.push(s('line', { class: 'guide', x1: at.x - dx, y1: -at.y - dy, x2: at.x + dx, y2: -at.y + dy, 'stroke-width': 14 * unit }));
      parts.push(s('rect', { class: 'block', x: -14 * unit, y: -9 * unit, width: 28 * unit, height: 18 * unit, transform: `translate(${at.x} ${-at.y}) rotate(${-guide.angle})` }));
    }
    for (const body of linkage.bodies) parts.push(...this.body(body, place, unit, selected));
    for (const load of linkage.loads) {
      const at = place(load.at);
      if (at && load.force) parts.push(arrow(at, load.force, unit));
    }
    for (const point of linkage.points) parts.push(this.point(point, unit, selected));
    this.element.replaceChildren(...parts);
    if (focused) this.element.querySelector<SVGElement>(`[data-key="${CSS.escape(focused)}"]`)?.focus();
  }

  private body(body: Body, place: (name: string) => Point | undefined, unit: number, selected: Selected): SVGElement[] {
    const at = body.points.flatMap((name) => place(name) ?? []);
    const on = selected?.kind === 'body' && selected.name === body.name;
    const d = `M${at.map(({ x, y }) => `${x} ${-y}`).join('L')}${at.length > 2 ? 'Z' : ''}`;
    const [x, y] = centre(this.sheet.linkage, body);
    const group = s('g', {
      class: `body${on ? ' on' : ''}`, role: 'button', tabindex: 0, 'data-key': `body ${body.name}`, 'data-body': body.name,
      'aria-pressed': String(on), 'aria-label': `${this.texts.link} ${body.name}: ${body.points.join(', ')}`,
    }, s('path', { d, 'stroke-width': 9 * unit }));
    const com = s('g', { class: 'com', 'data-com': body.name, transform: `translate(${x} ${-y})` },
      s('circle', { r: 6 * unit }), s('path', { d: `M0 0V${-6 * unit}A${6 * unit} ${6 * unit} 0 0 1 ${6 * unit} 0Z M0 0V${6 * unit}A${6 * unit} ${6 * unit} 0 0 1 ${-6 * unit} 0Z` }));
    return [group, com];
  }

  private point(point: Point, unit: number, selected: Selected): SVGElement {
    const { linkage } = this.sheet;
    const on = selected?.kind === 'point' && selected.name === point.name;
    const drive = linkage.drive === point.name;
    const words = [point.ground ? this.texts.fixed : '', drive ? this.texts.driven : ''].filter(Boolean).join(', ');
    const hatch = 'M-14 18L14 18M-12 18L-16 24M-4 18L-8 24M4 18L0 24M12 18L8 24';
    return s('g', {
      class: `joint${on ? ' on' : ''}${drive ? ' drive' : ''}`, role: 'button', tabindex: 0, 'data-key': `point ${point.name}`, 'data-point': point.name,
      'aria-pressed': String(on), 'aria-label': `${this.texts.joint} ${point.name}, x ${round(point.x)} mm, y ${round(point.y)} mm${words ? `, ${words}` : ''}`,
      transform: `translate(${point.x} ${-point.y}) scale(${unit})`,
    },
      s('circle', { class: 'reach', r: 20 }),
      point.ground && s('path', { class: 'bearing', d: `M0 0L-11 18L11 18Z${hatch}` }),
      drive && s('path', { class: 'turn', d: 'M-18 -10A20 20 0 0 1 18 -10M18 -10L19 -19M18 -10L9 -12' }),
      s('circle', { class: 'pin', r: 7 }),
      s('text', { x: 11, y: -11 }, point.name));
  }

  private at(event: PointerEvent): [number, number] {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.element.getScreenCTM()!.inverse());
    return [round(x), round(-y)];
  }

  /** The joint under the pointer, or near it for a finger. */
  private near(event: PointerEvent): string | undefined {
    const [x, y] = this.at(event);
    const scale = this.element.getScreenCTM()!.a;
    let best: { name: string; off: number } | undefined;
    for (const point of this.sheet.linkage.points) {
      const off = Math.hypot(point.x - x, point.y - y) * scale;
      if (off < NEAR && (!best || off < best.off)) best = { name: point.name, off };
    }
    return best?.name;
  }

  private down(event: PointerEvent): void {
    const { tool, linkage } = this.sheet;
    const target = event.target as Element;
    const name = this.near(event);
    const body = target.closest('[data-body]')?.getAttribute('data-body') ?? undefined;
    const com = target.closest('[data-com]')?.getAttribute('data-com') ?? undefined;
    const [x, y] = this.at(event);
    event.preventDefault();
    this.element.setPointerCapture(event.pointerId);
    if (tool === 'link') {
      const [next, from] = name === undefined ? addPoint(linkage, x, y) : [linkage, name];
      if (name === undefined) this.sheet.change(next, '');
      const at = next.points.find((point) => point.name === from)!;
      this.held = { kind: 'line', name: from };
      this.line = s('line', { class: 'rubber', x1: at.x, y1: -at.y, x2: x, y2: -y });
      this.element.append(this.line);
    } else if (name !== undefined) {
      this.sheet.select({ kind: 'point', name });
      if (tool === 'ground') this.sheet.change({ ...linkage, points: linkage.points.map((point) => (point.name === name ? { ...point, ground: !point.ground } : point)) }, '');
      else this.held = { kind: 'point', name };
    } else if (tool === 'pin' || tool === 'ground') {
      const [next, made] = addPoint(linkage, x, y, tool === 'ground' ? { ground: true } : {});
      this.sheet.change(body === undefined ? next : toggleOnLink(next, body, made), '');
      this.sheet.select({ kind: 'point', name: made });
    } else if (com !== undefined) {
      this.sheet.select({ kind: 'body', name: com });
      this.held = { kind: 'com', name: com };
    } else {
      this.sheet.select(body === undefined ? undefined : { kind: 'body', name: body });
    }
  }

  private move(event: PointerEvent): void {
    if (!this.held) return;
    const { linkage } = this.sheet;
    const [x, y] = this.at(event);
    const { kind, name } = this.held;
    if (kind === 'point') this.sheet.change(movePoint(linkage, name, x, y), `drag ${name}`);
    if (kind === 'com') this.sheet.change(changeBody(linkage, name, (body) => ({ com: inFrame(linkage, body, x, y).map(round) as [number, number] })), `com ${name}`);
    this.line?.setAttribute('x2', String(x));
    this.line?.setAttribute('y2', String(-y));
  }

  private up(event: PointerEvent): void {
    if (this.held?.kind === 'line') {
      const from = this.held.name;
      const [x, y] = this.at(event);
      const target = this.near(event);
      const start = this.sheet.linkage.points.find((point) => point.name === from)!;
      // A click without a way makes a joint only.
      if (target !== from && (target !== undefined || Math.hypot(start.x - x, start.y - y) > 1)) {
        const [next, to] = target === undefined ? addPoint(this.sheet.linkage, x, y) : [this.sheet.linkage, target];
        this.sheet.change(addLink(next, from, to), '');
      }
    }
    this.let();
  }

  private let(): void {
    this.held = undefined;
    this.line?.remove();
    this.line = undefined;
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as Element;
    const point = target.getAttribute('data-point');
    const body = target.getAttribute('data-body');
    if (point === null && body === null) return;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const selected: Selected = point !== null ? { kind: 'point', name: point } : { kind: 'body', name: body! };
    if (way && point !== null) {
      const at = this.sheet.linkage.points.find(({ name }) => name === point)!;
      const step = event.shiftKey ? 10 : 1;
      this.sheet.change(movePoint(this.sheet.linkage, point, at.x + way[0]! * step, at.y + way[1]! * step), `key ${point}`);
    } else if (event.key === 'Enter' || event.key === ' ') {
      this.sheet.select(selected);
    } else if (event.key === 'Delete' || event.key === 'Backspace') {
      this.sheet.select(selected);
      this.sheet.remove();
    } else return;
    event.preventDefault();
  }
}

function round(value: number): number {
  return Math.round(value / ROUND) * ROUND;
}

function arrow(at: Point, [fx, fy]: [number, number], unit: number): SVGElement {
  const angle = (Math.atan2(-fy, fx) * 180) / Math.PI;
  return s('path', { class: 'force', d: 'M-60 0H-12M-22 -6L-10 0L-22 6', transform: `translate(${at.x} ${-at.y}) rotate(${angle}) scale(${unit})` });
}
