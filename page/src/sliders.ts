/** A slider and a number field for every quantity of the machine file. */
import { h, settled, unitShown } from './dom';
import type { Quantity } from './protocol';
import type { Texts } from './texts';
import type { Workbench } from './workbench';

interface Row {
  quantity: Quantity;
  slider: HTMLInputElement;
  field: HTMLInputElement;
  element: HTMLElement;
  /** A number is being typed. */
  edited?: boolean;
}

export class Sliders {
  readonly element: HTMLElement;
  private readonly list = h('div', { class: 'groups' });
  private readonly fault = h('p', { class: 'fault', role: 'alert', hidden: true });
  private rows = new Map<string, Row>();
  /** Values that the core has not answered yet. */
  private pending: Record<string, string> = {};
  private asking = false;
  private ends = false;

  constructor(private readonly texts: Texts, private readonly bench: Workbench) {
    const filter = h('input', { type: 'search', placeholder: texts.filter, 'aria-label': texts.filter });
    filter.addEventListener('input', settled(80, () => this.filter(filter.value)));
    this.element = h('div', { class: 'sliders' }, filter, this.fault, this.list);
    bench.on('quantities', (quantities) => this.show(quantities));
  }

  private show(quantities: Quantity[]): void {
    const same = quantities.length === this.rows.size && quantities.every(({ key, unit, whole }) => {
      const old = this.rows.get(key)?.quantity;
      return old?.unit === unit && old.whole === whole;
    });
    if (same) {
      for (const quantity of quantities) this.update(quantity);
      return;
    }
    this.rows = new Map();
    const groups = new Map<string, Row[]>();
    for (const quantity of quantities) {
      // "mechanism.crank.com.1" is "com 1" of "mechanism › crank".
      const [, name = '', own = quantity.key] = /^(?:(.*)\.)?([^.]*[^.\d][^.]*(?:\.\d+)*)$/.exec(quantity.key) ?? [];
      const row = this.row(quantity, pairEnd(own, quantity.help).replaceAll('.', ' '));
      this.rows.set(quantity.key, row);
      groups.set(name, [...(groups.get(name) ?? []), row]);
    }
    this.list.replaceChildren(...[...groups].map(([name, rows], k) =>
      h('details', { class: 'group', open: k < 6 }, h('summary', { lang: 'en' }, heading(name) || this.texts.machine), ...rows.map((row) => row.element))));
  }

  private row(quantity: Quantity, name: string): Row {
    const id = `q-${quantity.key.replaceAll(/[^\w-]/g, '-')}`;
    const label = `${quantity.key.replaceAll('.', ' ')}${quantity.unit ? ` [${quantity.unit}]` : ''}`;
    const slider = h('input', { type: 'range', 'aria-label': label, 'aria-describedby': quantity.help ? `${id}-help` : null });
    const field = h('input', { type: 'number', id, 'aria-label': label });
    const element = h('div', { class: 'quantity', title: quantity.help },
      h('label', { for: id, lang: 'en' }, name), slider, field, h('span', { class: 'unit' }, unitShown(quantity.unit)),
      quantity.help && h('span', { class: 'unseen', id: `${id}-help`, lang: 'en' }, quantity.help));
    const row: Row = { quantity, slider, field, element };
    this.scale(row, quantity);
    slider.addEventListener('input', () => {
      field.value = slider.value;
      this.ask(quantity.key, slider.value);
    });
    slider.addEventListener('change', () => this.ask(quantity.key, slider.value, true));
    field.addEventListener('input', () => (row.edited = true));
    field.addEventListener('blur', () => (row.edited = false));
    field.addEventListener('change', () => {
      row.edited = false;
      const bad = field.value === '' || !field.validity.valid;
      field.setAttribute('aria-invalid', String(bad));
      if (bad) return;
      slider.value = field.value;
      this.ask(quantity.key, field.value, true);
    });
    return row;
  }

  /** Range and value; a slider that is held keeps them. */
  private scale({ slider, field }: Row, quantity: Quantity): void {
    if (slider.matches(':active')) return;
    const { number, whole } = quantity;
    const [min, max] = range(quantity);
    const step = whole ? 1 : 10 ** Math.floor(Math.log10((max - min) / 100 || 1));
    slider.min = String(Math.min(min, number));
    slider.max = String(Math.max(max, number));
    slider.step = number === Math.round(number / step) * step ? String(step) : 'any';
    field.step = whole ? '1' : 'any';
    slider.value = field.value = String(number);
    field.removeAttribute('aria-invalid');
  }

  private update(quantity: Quantity): void {
    const row = this.rows.get(quantity.key)!;
    // Values that are typed, or on their way to the core, stay.
    if (row.edited || this.asking) return;
    if (row.quantity.number !== quantity.number || Number(row.field.value) !== quantity.number) this.scale(row, quantity);
    row.quantity = quantity;
  }

  /** The value that is `last` ends a step of undo. */
  private ask(key: string, number: string, last = false): void {
    this.ends ||= last;
    const unit = this.rows.get(key)!.quantity.unit;
    this.pending[key] = unit === '' ? number : `${number} ${unit}`;
    void this.send();
  }

  /** One request at a time; values that change meanwhile go with the next. */
  private async send(): Promise<void> {
    if (this.asking) return;
    this.asking = true;
    while (Object.keys(this.pending).length > 0) {
      const values = this.pending;
      this.pending = {};
      const fault = await this.bench.set(values);
      this.fault.hidden = fault === undefined;
      this.fault.textContent = fault ? `${fault.message} ${fault.help}` : '';
    }
    this.asking = false;
    if (this.ends) this.bench.history.seal();
    this.ends = false;
  }

  private filter(words: string): void {
    const wanted = words.toLowerCase().split(/\s+/);
    for (const group of this.list.querySelectorAll<HTMLDetailsElement>('.group')) {
      let found = false;
      for (const { element, quantity } of this.rows.values()) {
        if (!group.contains(element)) continue;
        const text = `${quantity.key} ${quantity.help}`.toLowerCase();
        element.hidden = !wanted.every((word) => text.includes(word));
        found ||= !element.hidden;
      }
      group.hidden = !found;
      if (found && words !== '') group.open = true;
    }
  }
}

/** Up to twice the value; a quantity that is zero either way. */
function range({ number, unit, min, max }: Quantity): [number, number] {
  if (min !== undefined && max !== undefined) return [min, max];
  if (number === 0) return unit === 'deg' ? [-180, 180] : [-10, 10];
  if (unit === '%' && number > 0) return [0, Math.max(100, number)];
  return number > 0 ? [0, 2 * number] : [2 * number, 0];
}

/** "com.1" of a pair `[u, v]` → "com.u" */
function pairEnd(own: string, help: string): string {
  const ends = help.includes('[u, v]') ? 'uv' : /\bx and y\b/.test(help) ? 'xy' : '12';
  return own.replace(/\.([12])$/, (_, k: string) => `.${ends[Number(k) - 1]}`);
}

/** "motion.segment.1" → "motion › segment 1" */
function heading(table: string): string {
  return table.replaceAll(/\.(\d+)/g, (_, index: string) => ` ${index}`).replaceAll('.', ' › ');
}
