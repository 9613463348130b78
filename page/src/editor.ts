/** The text of the machine file: a plain field at first, CodeMirror once it is wanted; faults are listed below and marked where they are. */
import { h, settled } from './dom';
import type { Completion, Fault } from './protocol';
import type { Texts } from './texts';
import type { Workbench } from './workbench';

/** What the field and CodeMirror have in common. */
export interface Writing {
  readonly element: HTMLElement;
  text: string;
  mark(places: Fault['places'], message: string): void;
  select(from: number, to: number): void;
  focus(): void;
}

export interface Habits {
  label: string;
  changed(): void;
  undo(): void;
  redo(): void;
  complete(text: string, at: number): Promise<Completion | undefined>;
}

export class Editor {
  readonly element: HTMLElement;
  private readonly faults = h('div', { class: 'faults', role: 'status' });
  private readonly habits: Habits;
  private writing: Writing;
  private fault: Fault | undefined;
  private asked = false;

  constructor(private readonly texts: Texts, private readonly bench: Workbench) {
    const send = settled(150, () => this.bench.change(this.writing.text, 'text', 'typing'));
    const rest = settled(1200, () => this.bench.history.seal());
    this.habits = {
      label: texts.machineText,
      changed: () => {
        send();
        rest();
      },
      undo: () => void bench.undo(),
      redo: () => void bench.redo(),
      complete: (text, at) => bench.complete(text, at),
    };
    this.writing = field(this.habits);
    this.writing.text = bench.source.text;
    this.element = h('div', { class: 'editor' }, this.writing.element, this.faults);
    this.element.addEventListener('focusin', () => void this.upgrade());
    bench.on('source', ({ source, by }) => {
      if (by !== 'text' && this.writing.text !== source.text) this.writing.text = source.text;
    });
    bench.on('fault', (fault) => this.show(fault));
    bench.on('unsized', (fault) => {
      if (!this.bench.fault) this.show(fault);
    });
    bench.on('sized', () => this.show(this.bench.fault));
  }

  /** Loads CodeMirror; if that fails, the plain field stays. */
  async upgrade(): Promise<void> {
    if (this.asked) return;
    this.asked = true;
    try {
      const { codeMirror } = await import('./codemirror');
      const focused = this.writing.element.contains(document.activeElement) || document.activeElement === this.writing.element;
      const rich = codeMirror(this.habits, this.writing.text);
      this.writing.element.replaceWith(rich.element);
      this.writing = rich;
      if (focused) rich.focus();
      this.show(this.fault);
    } catch {
      this.asked = false;
    }
  }

  private show(fault: Fault | undefined): void {
    this.fault = fault;
    const places = fault && !fault.file ? fault.places : [];
    this.writing.mark(places, fault?.message ?? '');
    const words = fault ? `${fault.message}|${fault.help}|${places.map((place) => place.line).join()}` : '';
    if (this.faults.dataset['words'] === words) return;
    this.faults.dataset['words'] = words;
    this.faults.replaceChildren(...(fault ? [
      h('p', { class: 'fault', lang: 'en' }, fault.file ? `${fault.file}: ` : '', fault.message),
      fault.help && h('p', { class: 'help', lang: 'en' }, fault.help),
      ...places.map((place) => h('button', {
        type: 'button',
        class: 'place-link',
        onclick: () => {
          this.writing.select(place.from, place.to);
          this.writing.focus();
        },
      }, `${this.texts.line} ${place.line}${place.label ? `: ${place.label}` : ''}`)),
    ].filter((part) => part !== '') as Node[] : []));
  }
}

function field(habits: Habits): Writing {
  const area = h('textarea', { class: 'plain-text', spellcheck: 'false', autocapitalize: 'off', autocomplete: 'off', wrap: 'off', 'aria-label': habits.label });
  area.addEventListener('input', () => habits.changed());
  return {
    element: area,
    get text() {
      return area.value;
    },
    set text(text: string) {
      area.value = text;
    },
    mark: (places) => area.setAttribute('aria-invalid', String(places.length > 0)),
    select: (from, to) => area.setSelectionRange(from, to),
    focus: () => area.focus(),
  };
}
