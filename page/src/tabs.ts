/** Tabs as the ARIA practices describe them: arrows move between tabs, Tab enters the panel. */
import { h } from './dom';

export interface Tab {
  id: string;
  name: string;
  panel: HTMLElement;
  /** Called when the tab is shown. */
  shown?(): void;
}

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private readonly panels: HTMLElement[];
  /** Id of the tab that is shown. */
  current = '';

  constructor(label: string, private readonly tabs: Tab[]) {
    this.buttons = tabs.map(({ id, name }, k) => h('button', {
      type: 'button', role: 'tab', id: `tab-${id}`, 'aria-controls': `panel-${id}`, onclick: () => this.select(id),
      onkeydown: (event: KeyboardEvent) => this.key(event, k),
    }, name));
    this.panels = tabs.map(({ id, panel }) => h('div', { role: 'tabpanel', id: `panel-${id}`, 'aria-labelledby': `tab-${id}`, tabindex: -1 }, panel));
    this.element = h('div', { class: 'tabs' }, h('div', { role: 'tablist', 'aria-label': label }, ...this.buttons), ...this.panels);
    this.select(tabs[0]!.id);
  }

  select(id: string): void {
    this.current = id;
    for (const [k, tab] of this.tabs.entries()) {
      const on = tab.id === id;
      this.buttons[k]!.setAttribute('aria-selected', String(on));
      this.buttons[k]!.tabIndex = on ? 0 : -1;
      this.panels[k]!.hidden = !on;
      if (on) tab.shown?.();
    }
  }

  private key(event: KeyboardEvent, k: number): void {
    const count = this.tabs.length;
    const next = { ArrowRight: (k + 1) % count, ArrowLeft: (k + count - 1) % count, Home: 0, End: count - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    this.select(this.tabs[next]!.id);
    this.buttons[next]!.focus();
  }
}
