/** The page as a whole: header, views, messages, keys, files, link. */
import { AnswerPanel } from './answers';
import type { Core } from './core';
import { Curves } from './curves';
import { h } from './dom';
import { fromLinkage2 } from './draw/import';
import { fromPmks } from './draw/pmks';
import { DrawPanel } from './draw/panel';
import { DrivePanel } from './drive';
import { Editor } from './editor';
import { exportsPanel } from './exports';
import { filesOf } from './files';
import { Gallery } from './gallery';
import { LONGEST, toLink } from './link';
import { Picture } from './picture';
import { repaint } from './plots';
import type { Fault, GalleryMachine, Source } from './protocol';
import { choices, LANGUAGES } from './settings';
import { Sliders } from './sliders';
import { Tabs } from './tabs';
import type { Texts } from './texts';
import { Workbench } from './workbench';

export class Page {
  readonly bench: Workbench;
  readonly elements: HTMLElement[];
  private readonly message = h('p', { class: 'message', role: 'status', hidden: true });
  private readonly brief = h('span', { class: 'brief', lang: 'en' });
  private readonly stale = h('p', { class: 'stale', role: 'status', hidden: true });
  private readonly heading = h('h1', { lang: 'en', tabindex: -1, id: 'machine' });
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly picture: Picture;
  private readonly draw: DrawPanel;
  private readonly inputs: Tabs;
  private link = '';
  private timer = 0;

  constructor(private readonly texts: Texts, language: keyof typeof LANGUAGES, live: Core, slow: Core, private readonly machines: GalleryMachine[], source: Source) {
    const bench = (this.bench = new Workbench(live, slow, source));
    const curves = new Curves(texts);
    this.picture = new Picture(texts, (position) => curves.at(position));
    const gallery = new Gallery(texts, slow, machines, (machine) => this.open(machine));
    const drive = new DrivePanel(texts, bench, (words) => (this.brief.textContent = words));
    const editor = new Editor(texts, bench);
    this.draw = new DrawPanel(texts, bench, live);
    let drawing: string | undefined;
    const answers = new AnswerPanel(texts, bench, exportsPanel(texts, bench, () => drawing));
    this.inputs = new Tabs(texts.input, [
      { id: 'quantities', name: texts.quantities, panel: new Sliders(texts, bench).element },
      { id: 'text', name: texts.text, panel: editor.element, shown: () => void editor.upgrade() },
      { id: 'draw', name: texts.draw, panel: this.draw.element, shown: () => void this.draw.shown() },
    ]);
    const button = (name: string, act: () => void): HTMLButtonElement => h('button', { type: 'button', onclick: act }, name);
    const file = h('input', { type: 'file', class: 'unseen', tabindex: -1, 'aria-hidden': 'true', multiple: true, accept: '.toml,.csv,.linkage2,.txt,.url' });
    file.addEventListener('change', () => {
      void this.read([...(file.files ?? [])]);
      file.value = '';
    });
    this.undo = button(texts.undo, () => this.step('undo'));
    this.redo = button(texts.redo, () => this.step('redo'));
    const header = h('header', {},
      h('a', { class: 'skip', href: '#machine', onclick: (event: Event) => this.skip(event) }, texts.skip),
      h('p', { class: 'brand' }, h('strong', {}, 'jred'), h('span', {}, ` ${texts.tagline}`)),
      h('div', { class: 'row', role: 'toolbar', 'aria-label': texts.machine },
        button(texts.gallery, () => gallery.show()), button(texts.openFile, () => file.click()), file,
        this.undo, this.redo, button(texts.copyLink, () => void this.copy())),
      choices(texts, language, repaint, (words) => this.say(words)));
    const picture = h('section', { class: 'card view', 'aria-labelledby': 'machine' }, this.heading, this.picture.element, h('p', { class: 'note' }, texts.dragHint));
    const inputs = h('section', { class: 'card inputs', 'aria-labelledby': 'inputs-title' }, h('h2', { id: 'inputs-title' }, texts.input), this.inputs.element);
    this.elements = [
      header, this.message,
      h('main', {}, this.stale, h('div', { class: 'left' }, picture, curves.element), drive.element, inputs, answers.element),
      h('footer', {}, h('p', { class: 'summary' }, this.brief), h('p', { class: 'note' }, texts.privacy)),
      gallery.element,
    ];

    bench.on('curves', (columns) => {
      this.picture.unit = /^s \[/.test(columns.columns[0] ?? '') ? 'mm' : 'deg';
      this.heading.textContent = columns.title.replace(/: reduced to .*$/, '');
      curves.show(columns);
    });
    bench.on('drawing', (answer) => {
      drawing = answer.svg;
      this.picture.show(answer, this.heading.textContent ?? '');
    });
    bench.on('fault', (fault) => this.judge(fault));
    bench.on('source', () => this.changed());
    bench.on('sized', () => void this.address());
    bench.on('unsized', () => void this.address());
    addEventListener('keydown', (event) => this.key(event));
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      const { files, link } = { files: [...(event.dataTransfer?.files ?? [])], link: event.dataTransfer?.getData('text/plain') };
      void this.read(files.length === 0 && link ? [new File([link], 'link')] : files);
    });
    addEventListener('beforeprint', () => {
      document.documentElement.dataset['printing'] = '';
      repaint();
    });
    addEventListener('afterprint', () => {
      delete document.documentElement.dataset['printing'];
      repaint();
    });
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', repaint);
  }

  begin(): void {
    this.bench.changed('open');
  }

  /** A message for everyone; one that `stays` does not go by itself. */
  say(words: string, stays = false): void {
    clearTimeout(this.timer);
    this.message.hidden = false;
    this.message.textContent = words;
    if (!stays) this.timer = self.setTimeout(() => (this.message.hidden = true), 4000);
  }

  private skip(event: Event): void {
    event.preventDefault();
    this.heading.focus();
  }

  private open(source: Source): void {
    this.bench.open(source);
    this.say(`${this.texts.opened} ${source.name}`);
    this.heading.focus();
  }

  private judge(fault: Fault | undefined): void {
    this.stale.hidden = fault === undefined;
    document.querySelector('main')?.classList.toggle('old', fault !== undefined);
    if (!fault) return;
    const stale = fault.sheet ? this.texts.staleSheet : this.texts.stale;
    const words = fault.panic ? `${this.texts.panicked} ${fault.message}` : `${stale} ${fault.message}`;
    if (this.stale.textContent !== words) this.stale.textContent = words;
  }

  private changed(): void {
    this.undo.disabled = !this.bench.history.canUndo;
    this.redo.disabled = !this.bench.history.canRedo;
  }

  private step(way: 'undo' | 'redo'): void {
    const { texts } = this;
    const moved = (this.inputs.current === 'draw' && this.draw.step(way)) || this.bench[way]();
    this.say(moved ? (way === 'undo' ? texts.undone : texts.redone) : texts.nothingToUndo);
  }

  private key(event: KeyboardEvent): void {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.defaultPrevented) return;
    const key = event.key.toLowerCase();
    // Fields of numbers and the plain text have an undo of their own.
    if (event.target instanceof HTMLElement && event.target.matches('textarea, input:not([type=range])')) return;
    if (key === 'z' && !event.shiftKey) this.step('undo');
    else if (key === 'y' || (key === 'z' && event.shiftKey)) this.step('redo');
    else return;
    event.preventDefault();
  }

  private async read(chosen: File[]): Promise<void> {
    const { texts } = this;
    if (chosen.length === 0) return;
    const files = await filesOf(chosen);
    if ('problem' in files) {
      this.say(`${texts.cannotRead} ${files.problem === 'large' ? texts.tooLarge : files.problem}`, true);
    } else if (files.foreign) {
      const { name, text } = files.foreign;
      const read = text.trimStart().startsWith('<') ? fromLinkage2(name, text) : fromPmks(text);
      if ('problem' in read) this.say(`${texts.cannotRead} ${files.foreign.name}: ${read.problem}`, true);
      else {
        this.inputs.select('draw');
        this.draw.begin(read.linkage);
        this.say(`${texts.imported} ${read.notes}`, true);
      }
    } else if (files.source) {
      this.open(files.source);
    } else {
      // Files that the machine names, such as the curves of a load.
      const { source } = this.bench;
      this.bench.open({ ...source, files: { ...source.files, ...files.named } });
    }
  }

  /** The link of this machine, without the `#`. */
  private async fragment(): Promise<string> {
    const { source } = this.bench;
    const same = this.machines.find(({ name, text }) => name === source.name && text === source.text);
    return same ? `machine=${same.name}` : toLink(source);
  }

  private async address(): Promise<void> {
    const fragment = await this.fragment();
    if (fragment.length > LONGEST) return;
    this.link = `#${fragment}`;
    if (location.hash !== this.link) history.replaceState(null, '', this.link);
  }

  wroteLink(hash: string): boolean {
    return hash === this.link;
  }

  private async copy(): Promise<void> {
    const { texts } = this;
    const fragment = await this.fragment();
    if (fragment.length > LONGEST) {
      this.say(texts.linkTooLong, true);
      return;
    }
    await this.address();
    try {
      await navigator.clipboard.writeText(location.href);
      this.say(texts.linkCopied);
    } catch {
      this.say(texts.linkInAddress);
    }
  }
}
