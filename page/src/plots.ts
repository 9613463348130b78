/**
 * Plots over uPlot: curves over the position, and charts whose lines need not rise in x, such as the torque-speed plane. Each has its table of numbers
 * behind it, for those who do not see it and for copying.
 */
import uPlot from 'uplot';
import { h, shown, table } from './dom';
import type { Chart } from './protocol';
import type { Texts } from './texts';

/** Rows of the table behind a plot. */
const ROWS = 37;

export interface Line {
  name: string;
  points: [number | null, number | null][];
  style: 'line' | 'dashed' | 'dots';
}

export interface Content {
  title: string;
  x: string;
  y: string;
  lines: Line[];
}

/** All plots, which are drawn anew in another theme. */
const all = new Set<Plot>();

export function repaint(): void {
  for (const plot of all) plot.paint();
}

export class Plot {
  readonly element: HTMLElement;
  private readonly canvas: HTMLElement;
  private readonly legend: HTMLElement;
  private readonly details: HTMLDetailsElement;
  private plot: uPlot | undefined;
  private content: Content | undefined;
  private mark: HTMLElement | undefined;
  private marked: number | undefined;

  constructor(private readonly texts: Texts, private readonly height = 190, private readonly cursor = false) {
    this.canvas = h('div', { class: 'canvas', role: 'img' });
    this.legend = h('ul', { class: 'legend', 'aria-hidden': 'true' });
    this.details = h('details', { class: 'numbers' }, h('summary', {}, texts.asTable));
    this.details.addEventListener('toggle', () => this.fillTable());
    this.element = h('figure', { class: 'plot' }, this.details, this.legend, this.canvas);
    new ResizeObserver(() => this.fit()).observe(this.canvas);
    all.add(this);
  }

  show(content: Content): void {
    this.content = content;
    const summary = content.lines.map((line) => `${line.name}: ${extent(line)}`).join('; ');
    this.canvas.setAttribute('aria-label', `${content.title}. ${content.y} ${this.texts.over} ${content.x}. ${summary}`);
    // One line alone is named by the axis.
    this.legend.replaceChildren(...(content.lines.length < 2 ? [] : content.lines).map((line, k) =>
      h('li', {}, h('span', { class: `key ${line.style}`, style: `--ink:var(--line-${k % 7})` }), line.name)));
    this.paint();
    this.fillTable();
  }

  /** Moves the upright mark of the position. */
  at(x: number): void {
    this.marked = x;
    if (!this.plot || !this.mark) return;
    this.mark.style.transform = `translateX(${this.plot.valToPos(x, 'x')}px)`;
  }

  paint(): void {
    if (!this.content) return;
    const [low, high] = range(this.content.lines.flatMap((line) => line.points.map(([x]) => x)), this.cursor ? 0 : 0.02);
    const [bottom, top] = range(this.content.lines.flatMap((line) => line.points.map(([, y]) => y)), 0.06);
    const data: uPlot.AlignedData = [[low, high], [null, null]];
    if (this.plot && this.plot.axes[0]!.label === this.content.x && this.plot.axes[1]!.label === this.content.y && !this.stale()) {
      this.plot.batch(() => {
        this.plot!.setData(data, false);
        this.plot!.setScale('x', { min: low, max: high });
        this.plot!.setScale('y', { min: bottom, max: top });
      });
      this.plot.redraw(false);
    } else {
      this.build(data, [low, high], [bottom, top]);
    }
    if (this.marked !== undefined) this.at(this.marked);
  }

  /** The colours with which the axes were made are no longer those of the theme. */
  private stale(): boolean {
    return this.canvas.dataset['ink'] !== colour(this.canvas, '--ink');
  }

  private build(data: uPlot.AlignedData, [low, high]: [number, number], [bottom, top]: [number, number]): void {
    this.plot?.destroy();
    const ink = colour(this.canvas, '--ink');
    const grid = { stroke: colour(this.canvas, '--grid'), width: 1 };
    const font = '12px system-ui, sans-serif';
    const axis = { stroke: ink, grid, ticks: grid, font, labelFont: font, labelSize: 16 };
    this.canvas.dataset['ink'] = ink;
    this.plot = new uPlot({
      width: Math.max(120, this.canvas.clientWidth),
      height: this.height,
      legend: { show: false },
      cursor: { show: false },
      scales: { x: { time: false, range: (_, from, to) => [from, to] }, y: { range: (_, from, to) => [from, to] } },
      axes: [{ ...axis, label: this.content!.x, size: 34 }, { ...axis, label: this.content!.y, size: 56 }],
      series: [{}, { show: true }],
      hooks: { draw: [(plot) => this.lines(plot)] },
    }, data, this.canvas);
    this.plot.batch(() => {
      this.plot!.setScale('x', { min: low, max: high });
      this.plot!.setScale('y', { min: bottom, max: top });
    });
    if (this.cursor) {
      this.mark = h('div', { class: 'mark' });
      this.plot.over.append(this.mark);
    }
  }

  private lines(plot: uPlot): void {
    const { ctx } = plot;
    const scale = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
    ctx.clip();
    ctx.lineWidth = 1.8 * scale;
    ctx.lineJoin = 'round';
    for (const [k, line] of this.content!.lines.entries()) {
      ctx.strokeStyle = ctx.fillStyle = colour(this.canvas, `--line-${k % 7}`);
      ctx.setLineDash(line.style === 'dashed' ? [5 * scale, 4 * scale] : []);
      ctx.beginPath();
      let joined = false;
      for (const [x, y] of line.points) {
        if (x === null || y === null) {
          joined = false;
          continue;
        }
        const [px, py] = [plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true)];
        if (line.style === 'dots') ctx.fillRect(px - 0.8 * scale, py - 0.8 * scale, 1.6 * scale, 1.6 * scale);
        else if (joined) ctx.lineTo(px, py);
        else ctx.moveTo(px, py);
        joined = true;
      }
      if (line.style !== 'dots') ctx.stroke();
    }
    ctx.restore();
  }

  private fit(): void {
    const width = this.canvas.clientWidth;
    if (!this.plot || width < 1 || width === this.plot.width) return;
    this.plot.setSize({ width, height: this.height });
    if (this.marked !== undefined) this.at(this.marked);
  }

  private fillTable(): void {
    if (!this.details.open || !this.content) return;
    const { title, x, lines } = this.content;
    const common = lines.every((line) => line.points.length === lines[0]!.points.length && line.points.every(([at], k) => at === lines[0]!.points[k]![0]));
    const parts = common
      ? [table(title, [x, ...lines.map((line) => line.name)], thin(lines[0]?.points ?? []).map((k) => [
          shown(lines[0]!.points[k]![0], 5), ...lines.map((line) => shown(line.points[k]![1], 6))]))]
      : lines.map((line) => table(line.name, [x, this.content!.y], thin(line.points).map((k) => [shown(line.points[k]![0], 5), shown(line.points[k]![1], 6)])));
    this.details.replaceChildren(this.details.firstElementChild!, ...parts);
  }
}

/** A chart of the core as the content of a plot. */
export function ofChart(chart: Chart, title: string): Content {
  const lines = chart.series.map(({ name, style, at, y }): Line => ({
    name,
    style,
    points: y.map((value, k): [number | null, number | null] => [chart.places[at]?.[k] ?? null, value]),
  }));
  return { title, x: chart.x, y: chart.y, lines };
}

function thin(points: unknown[]): number[] {
  const step = Math.max(1, Math.floor((points.length - 1) / (ROWS - 1)));
  return points.map((_, k) => k).filter((k) => k % step === 0);
}

function extent(line: Line): string {
  const [low, high] = range(line.points.map(([, y]) => y), 0);
  return `${shown(low)} … ${shown(high)}`;
}

/** Smallest and largest value, with room around; never empty. */
function range(values: (number | null)[], room: number): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value === null || !Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) return [0, 1];
  // Rounding noise of a constant is drawn as a constant.
  const size = Math.max(Math.abs(low), Math.abs(high));
  const span = high - low > 1e-9 * size ? high - low : size > 0 ? 0.2 * size : 1;
  const middle = high - low > 1e-9 * size ? 0 : 0.5 * span;
  return [low - room * span - middle, high + room * span + middle];
}

function colour(element: HTMLElement, name: string): string {
  return getComputedStyle(element).getPropertyValue(name).trim() || '#000';
}
