/** Drawing a linkage: sheet, tools and properties; the machine file follows with every move. */
import type { Core } from '../core';
import { h, shown } from '../dom';
import { History } from '../history';
import type { Answer, Drawn, Linkage } from '../protocol';
import type { Texts } from '../texts';
import type { Workbench } from '../workbench';
import { Canvas, type Selected, type Sheet, type Tool } from './canvas';
import { properties } from './form';
import { BEGIN, EMPTY, removeBody, removePoint } from './linkage';
import { linkageOf } from './read';
import { drivesGuide, freedoms, machineText, wideStroke } from './write';

/** Name of the machine file of a drawing. */
const NAME = 'drawing.toml';

export class DrawPanel implements Sheet {
  readonly element: HTMLElement;
  selected: Selected;
  tool: Tool = 'move';
  private history = new History<Linkage>(BEGIN);
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
    if (linkage === this.linkage) return;
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
    const moved = way === 'undo' ? this.history.undo() : this.history.redo();
    if (moved) this.changed();
    return moved !== undefined;
  }

  /** Another linkage on the sheet. */
  begin(linkage: Linkage): void {
    this.selected = undefined;
    this.history.push(linkage);
    this.canvas.fit();
    this.changed();
  }

  /** The linkage of the machine file. */
  async load(): Promise<void> {
    const told = await this.live.ask<'linkage'>({ do: 'linkage', ...this.bench.source });
    if (!told) return;
    if ('error' in told) {
      this.state.replaceChildren(h('p', { class: 'fault', lang: 'en' }, told.error.message));
      return;
    }
    const linkage = linkageOf(told.answer);
    if ('problem' in linkage) {
      this.say([h('p', { class: 'fault' }, `${this.texts.notDrawable} ${linkage.problem}`)]);
      return;
    }
    this.selected = undefined;
    this.history.push(linkage);
    this.canvas.fit();
    this.form.replaceChildren(...properties(this.texts, this));
    const { lost } = told.answer;
    this.say(lost.length === 0 ? [] : [h('p', {}, `${this.texts.leavesOut} ${lost.join(', ')}`)]);
  }

  private changed(): void {
    this.canvas.draw();
    // A field that is being edited keeps its focus.
    const at = [...this.form.querySelectorAll('input, select, button')].indexOf(document.activeElement as Element);
    this.form.replaceChildren(...properties(this.texts, this));
    if (at >= 0) (this.form.querySelectorAll<HTMLElement>('input, select, button')[at])?.focus();
    void this.examine();
  }

  /** Whether it moves; then the machine file follows. */
  private async examine(): Promise<void> {
    const { linkage } = this;
    if (linkage.drive === '') {
      this.say([this.freedoms(), h('p', { class: 'fault' }, this.texts.noDriveDrawn)]);
      return;
    }
    const ask = (stroke: string): Promise<Answer<'draw'> | undefined> => this.live.ask<'draw'>({ do: 'draw', name: NAME, text: machineText(linkage, stroke, null).replace(/\n\[motion\][^]*$/, '') });
    let stroke = drivesGuide(linkage) ? wideStroke(linkage) : '';
    let told = await ask(stroke);
    const dead: string[] = [];
    const proposed = told && 'answer' in told ? /stroke = \[.*?\]/.exec(told.answer.cure)?.[0] : undefined;
    if (told && 'answer' in told && proposed !== undefined) {
      dead.push(told.answer.obstacle);
      stroke = proposed;
      told = await ask(stroke);
    }
    if (!told || linkage !== this.linkage) return;
    if ('error' in told) {
      this.say([this.freedoms(), h('p', { class: 'fault', lang: 'en' }, `${told.error.message} ${told.error.help}`)]);
      return;
    }
    const drawn = told.answer;
    this.say(this.words({ ...drawn, dead: [...dead, ...drawn.dead] }));
    if (drawn.obstacle === '') this.bench.replace(NAME, machineText(linkage, stroke, drawn.range));
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
