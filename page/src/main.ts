/** Starts the page: the core, the machine of the link, the views. */
import { Core } from './core';
import { h } from './dom';
import { fromLink } from './link';
import { Page } from './page';
import type { GalleryMachine, Source } from './protocol';
import { applyTheme, words } from './settings';
import type { Texts } from './texts';

const START = 'press.toml';

async function start(): Promise<void> {
  applyTheme();
  const { language, texts } = await words();
  document.documentElement.lang = language;
  document.title = texts.title;
  const app = document.getElementById('app')!;
  if (typeof WebAssembly !== 'object' || typeof Worker !== 'function') {
    app.replaceChildren(h('main', {}, h('p', { class: 'plain' }, texts.noWasm)));
    return;
  }
  const worker = (name: string): Worker => new Worker(new URL('worker.js', document.baseURI), { type: 'module', name });
  const live = new Core(worker);
  const slow = new Core(worker);
  let machines: GalleryMachine[];
  try {
    const response = await fetch('machines.json');
    if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
    machines = (await response.json()) as GalleryMachine[];
  } catch (error) {
    app.replaceChildren(h('main', {}, h('p', { class: 'plain', role: 'alert' }, `${texts.notLoaded} ${String(error)}`)));
    return;
  }
  const [source, notice] = await linked(machines, texts);
  const page = new Page(texts, language, live, slow, machines, source);
  app.replaceChildren(...page.elements);
  page.begin();
  if (notice) page.say(notice, true);
  addEventListener('hashchange', () => {
    if (page.wroteLink(location.hash)) return;
    void linked(machines, texts).then(([other, words]) => {
      page.bench.open(other);
      if (words) page.say(words, true);
    });
  });
  if ('serviceWorker' in navigator && isSecureContext) {
    navigator.serviceWorker.register('offline.js', { type: 'module' }).catch(() => undefined);
  }
}

async function linked(machines: GalleryMachine[], texts: Texts): Promise<[Source, string | undefined]> {
  const press = machines.find(({ name }) => name === START) ?? machines[0]!;
  const link = await fromLink(location.hash);
  switch (link.kind) {
    case 'source':
      return [link.source, undefined];
    case 'gallery': {
      const machine = machines.find(({ name }) => name === link.name);
      return machine ? [machine, undefined] : [press, texts.linkUnknown];
    }
    case 'other-version':
      return [press, texts.linkOld];
    case 'broken':
      return [press, texts.linkBroken];
    case 'none':
      return [press, undefined];
  }
}

void start();
