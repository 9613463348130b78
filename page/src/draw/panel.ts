/** Drawing a linkage: sheet, tools and properties; the machine file follows with every move. */
import type { Core } from '../core';
import { h, shown } from '../dom';
import { History } from '../history';
import type { Answer, Drawn, Linkage, Source } from '../protocol';
import type { Texts } from '../texts';
import type { Workbench } from '../workbench';
import { Canvas, type Selected, type Sheet, type Tool } from './canvas';
import { properties } from './form';
import { BEGIN, EMPTY, removeBody, removePoint } from './linkage';
import { linkageOf } from './read';
import { drivesGuide, freedoms, hasMotion, machineText, mechanismText, tables, wideStroke } from './write';

/** Name of the machine file of a drawing. */
const NAME = 'drawing.toml';

export class DrawPanel implements Sheet {
  readonly element: HTMLElement;
  selected: Selected;
  tool: Tool = 'move';
  private history = new History<Linkage>(BEGIN);
  /** The machine file that the sheet has written or taken over. */
  private text = '';
  /** While it takes one over, nothing else changes the sheet; a new drawing, and another machine file, end that. */
  private loading: object | undefined;
  /** Machine files that came from elsewhere. An answer to an older one is not written over it. */
  private others = 0;
  private readonly canvas: Canvas;
  private readonly form = h('div', { class: 'properties' });
  private readonly state = h('div', { class: 'drawn', role: 'status' });
  private readonly tools: HTMLButtonElement[];

  constructor(private readonly texts: Texts, private readonly bench: Workbench, private readonly live: Core) {
    this.canvas = new Canvas(texts, this);
    const tools: [Tool, string][] = [['move', texts.toolMove], ['link', texts.toolLink], ['pin', texts.toolPin], ['ground', texts.toolGround]];
    this.tools = tools.map(([tool, name]) => h('button', { type: 'button', 'aria-pressed': 'false', onclick: () => this.use(tool) }, name));
    const begin = (name: string, linkage: Linkage): HTMLElement => h('button', { type: 'button', onclick: () => this.begin(linkage) }, name);
    this.element = h('div', { class: 'draw' },
      h('div', { class: 'row' }, begin(texts.newFourBar, BEGIN), begin(texts.newEmpty, EMPTY),
        h('button', { type: 'button', onclick: () => void this.load() }, texts.drawThis)),
      h('div', { class: 'row', role: 'group', 'aria-label': texts.tools }, ...this.tools,
        h('button', { type: 'button', onclick: () => this.canvas.fit() }, texts.fit)),
      h('p', { class: 'note' }, texts.drawingHelp),
      this.canvas.element, this.state, this.form);
    bench.on('source', ({ by }) => {
      if (by === 'draw') return;
      this.others++;
      this.ready();
      if (this.element.offsetParent) void this.shown();
    });
    this.use('move');
    this.canvas.fit();
    this.form.replaceChildren(...properties(texts, this));
  }

  get linkage(): Linkage {
    return this.history.now;
  }

  use(tool: Tool): void {
    this.tool = tool;
    for (const [k, name] of (['move', 'link', 'pin', 'ground'] as const).entries()) this.tools[k]!.setAttribute('aria-pressed', String(name === tool));
  }

  change(linkage: Linkage, tag: string): void {
    if (linkage === this.linkage || this.loading) return;
    this.history.push(linkage, tag);
    this.changed();
  }

  select(selected: Selected): void {
    const same = selected?.kind === this.selected?.kind && selected?.name === this.selected?.name;
    this.selected = selected;
    this.canvas.draw();
    if (!same) this.history.seal();
    this.form.replaceChildren(...properties(this.texts, this));
  }

  remove(): void {
    const { selected } = this;
    if (!selected) return;
    this.selected = undefined;
    this.change(selected.kind === 'point' ? removePoint(this.linkage, selected.name) : removeBody(this.linkage, selected.name), '');
  }

  /** Whether a step was undone (or redone). */
  step(way: 'undo' | 'redo'): boolean {
    if (this.loading) return false;
    const moved = way === 'undo' ? this.history.undo() : this.history.redo();
    if (moved) this.changed();
    return moved !== undefined;
  }

  /** Another linkage on the sheet. */
  begin(linkage: Linkage): void {
    this.selected = undefined;
    this.use('move');
    this.ready();
    this.history.push(linkage);
    this.canvas.fit();
    this.changed();
  }

  /** The sheet is looked at: it takes over a machine file that was changed elsewhere. */
  async shown(): Promise<void> {
    if (this.bench.source.text !== this.text) await this.load();
  }

  private ready(): void {
    this.loading = undefined;
    this.element.ariaBusy = 'false';
  }

  /** The linkage of the machine file. */
  async load(): Promise<void> {
    const { source } = this.bench;
    const loading = (this.loading = {});
    this.element.ariaBusy = 'true';
    const told = await this.live.ask<'linkage'>({ do: 'linkage', ...source });
    if (loading !== this.loading) return;
    if (!told) {
      this.ready();
      return;
    }
    const refuse = (problem: string): void => {
      this.ready();
      this.say([h('p', { class: 'fault' }, `${this.texts.notDrawable} ${problem}`), h('p', {}, this.texts.replaces)]);
    };
    if ('error' in told) {
      refuse(told.error.message);
      return;
    }
    const linkage = linkageOf(told.answer);
    if ('problem' in linkage) {
      refuse(linkage.problem);
      return;
    }
    // What the sheet does not show stays as it is, if the machine stays the same with it.
    const { speed, ...own } = linkage;
    const rest = tables(source.text, (table) => table !== 'mechanism');
    const whole = { ...(hasMotion(rest) ? own : linkage), rest };
    const moved = await this.moved(whole);
    const same = moved && 'answer' in moved.told && await this.isSame(source, machineText(whole, moved.stroke, moved.told.answer.range));
    if (loading !== this.loading) return;
    this.ready();
    this.selected = undefined;
    this.text = source.text;
    this.history = new History<Linkage>(same ? whole : linkage);
    this.canvas.fit();
    this.form.replaceChildren(...properties(this.texts, this));
    this.bench.follows();
    const { lost } = told.answer;
    this.say(same || lost.length === 0 ? [] : [h('p', {}, `${this.texts.leavesOut} ${lost.join(', ')}`)]);
  }

  /** Whether another text has the curves of a machine. */
  private async isSame(source: Source, text: string): Promise<boolean> {
    if (source.text === text) return true;
    const ask = (own: string, lane: string): Promise<Answer<'curves'> | undefined> => this.live.ask<'curves'>({ do: 'curves', positions: 24, ...source, text: own }, lane);
    const [one, other] = await Promise.all([ask(source.text, 'file'), ask(text, 'sheet')]);
    if (!one || !other || 'error' in one || 'error' in other) return false;
    const [a, b] = [one.answer, other.answer];
    // A text without a motion has fewer columns; one of rounding errors has no size to compare with.
    const at = a.columns.map((name) => b.columns.indexOf(name));
    const near = (x: number | null, y: number | null, k: number): boolean => x === y || Math.abs((x ?? NaN) - (y ?? NaN)) <= 1e-12 + 1e-6 * Math.max(...a.rows.map((row) => Math.abs(row[k] ?? 0)));
    return at.every((k) => k >= 0) && a.rows.every((row, r) => row.every((x, k) => near(x, b.rows[r]?.[at[k]!] ?? null, k)));
  }

  private changed(): void {
    this.canvas.draw();
    // A field that is being edited keeps its focus.
    const at = [...this.form.querySelectorAll('input, select, button')].indexOf(document.activeElement as Element);
    this.form.replaceChildren(...properties(this.texts, this));
    if (at >= 0) (this.form.querySelectorAll<HTMLElement>('input, select, button')[at])?.focus();
    void this.examine();
  }

  /** Whether a linkage moves, with the stroke of a drive that does not turn fully, and the dead points that limit it. */
  private async moved(linkage: Linkage): Promise<{ told: Answer<'draw'>; stroke: string; dead: string[] } | undefined> {
    const ask = (stroke: string): Promise<Answer<'draw'> | undefined> => this.live.ask<'draw'>({ do: 'draw', name: NAME, text: mechanismText(linkage, stroke) });
    let stroke = drivesGuide(linkage) ? wideStroke(linkage) : '';
    let told = await ask(stroke);
    const dead: string[] = [];
    const proposed = told && 'answer' in told ? /stroke = \[.*?\]/.exec(told.answer.cure)?.[0] : undefined;
    if (told && 'answer' in told && proposed !== undefined) {
      dead.push(told.answer.obstacle);
      stroke = proposed;
      told = await ask(stroke);
    }
    return told && { told, stroke, dead };
  }

  /** Whether it moves; then the machine file follows. */
  private async examine(): Promise<void> {
    const { linkage, others } = this;
    const moved = linkage.drive === '' ? undefined : await this.moved(linkage);
    if (linkage !== this.linkage || others !== this.others || (linkage.drive !== '' && !moved)) return;
    const { told, stroke, dead } = moved ?? { told: { error: { message: this.texts.noDriveDrawn, help: '', places: [] } }, stroke: '', dead: [] };
    if ('error' in told) {
      this.say([this.freedoms(), h('p', { class: 'fault', lang: moved ? 'en' : null }, `${told.error.message} ${told.error.help}`)]);
      this.bench.refuse(told.error.message);
      return;
    }
    const drawn = told.answer;
    this.say(this.words({ ...drawn, dead: [...dead, ...drawn.dead] }));
    if (drawn.obstacle !== '') {
      this.bench.refuse(drawn.obstacle);
      return;
    }
    this.text = machineText(linkage, stroke, drawn.range);
    this.bench.replace(NAME, this.text);
  }

  private freedoms(): HTMLElement {
    return h('p', {}, `${this.texts.freedoms} `, h('strong', {}, String(freedoms(this.linkage))));
  }

  private say(nodes: Node[]): void {
    const text = nodes.map((node) => node.textContent).join('\n');
    if (this.state.dataset['words'] === text) return;
    this.state.dataset['words'] = text;
    this.state.replaceChildren(...nodes);
  }

  private words(drawn: Drawn): Node[] {
    const { texts } = this;
    const unit = drivesGuide(this.linkage) ? 'mm' : '°';
    if (drawn.obstacle !== '') return [this.freedoms(), h('p', { class: 'fault', lang: 'en' }, drawn.obstacle), h('p', { class: 'help', lang: 'en' }, drawn.cure)];
    return [
      this.freedoms(),
      h('p', {}, drawn.range ? `${texts.driveMoves} ${shown(drawn.range[0])} … ${shown(drawn.range[1])} ${unit}` : texts.driveTurns),
      ...(drawn.dead.length === 0 ? [] : [h('p', {}, texts.deadCentres), h('ul', { lang: 'en' }, ...drawn.dead.map((words) => h('li', {}, words)))]),
    ];
  }
}
