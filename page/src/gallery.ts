/** All machines of the repository with their drawings, which are made when they come into view. */
import type { Core } from './core';
import { h, settled, svgOf } from './dom';
import type { GalleryMachine } from './protocol';
import type { Texts } from './texts';

export class Gallery {
  readonly element: HTMLDialogElement;
  private readonly list = h('ul', { class: 'gallery' });
  private readonly none = h('p', { role: 'status' });
  private watcher: IntersectionObserver | undefined;

  constructor(private readonly texts: Texts, private readonly core: Core, private readonly machines: GalleryMachine[], private readonly open: (machine: GalleryMachine) => void) {
    const filter = h('input', { type: 'search', placeholder: texts.filter, 'aria-label': texts.filter });
    filter.addEventListener('input', settled(80, () => this.filter(filter.value)));
    this.element = h('dialog', { class: 'sheet', 'aria-labelledby': 'gallery-title' },
      h('div', { class: 'sheet-head' },
        h('h2', { id: 'gallery-title' }, texts.gallery), filter,
        h('button', { type: 'button', onclick: () => this.element.close() }, texts.close)),
      this.none, this.list);
  }

  show(): void {
    if (this.list.childElementCount === 0) this.fill();
    this.element.showModal();
  }

  private fill(): void {
    this.watcher = new IntersectionObserver((entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting) continue;
        this.watcher!.unobserve(target);
        void this.draw(target as HTMLElement);
      }
    }, { root: this.element, rootMargin: '200px' });
    for (const machine of this.machines) {
      const thumb = h('span', { class: 'thumb', 'data-name': machine.name, 'aria-hidden': 'true' });
      this.list.append(h('li', {}, h('button', {
        type: 'button',
        onclick: () => {
          this.element.close();
          this.open(machine);
        },
      }, thumb, h('span', { class: 'title', lang: 'en' }, machine.title), h('span', { class: 'file' }, machine.name))));
      this.watcher.observe(thumb);
    }
  }

  private async draw(thumb: HTMLElement): Promise<void> {
    const machine = this.machines.find(({ name }) => name === thumb.dataset['name'])!;
    const told = await this.core.ask<'drawing'>({ do: 'drawing', ...machine }, `gallery ${machine.name}`);
    if (told && 'answer' in told) thumb.replaceChildren(svgOf(told.answer.svg));
  }

  private filter(words: string): void {
    const wanted = words.toLowerCase().split(/\s+/);
    let found = 0;
    for (const item of this.list.children as HTMLCollectionOf<HTMLElement>) {
      item.hidden = !wanted.every((word) => item.textContent!.toLowerCase().includes(word));
      if (!item.hidden) found++;
    }
    this.none.textContent = found === 0 ? this.texts.nothingFound : '';
  }
}
