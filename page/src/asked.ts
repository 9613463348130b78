/** A panel whose answer takes a while: it is asked for by a button, can be stopped, and says when the machine has changed since. */
import { h } from './dom';
import type { Answers, Fault, Request } from './protocol';
import type { Texts } from './texts';
import type { Asking, Workbench } from './workbench';

type Command = Request['do'];

export class Asked<D extends Command> {
  readonly element: HTMLElement;
  private readonly state = h('p', { class: 'state', role: 'status' });
  private readonly result = h('div', { class: 'result' });
  private readonly go: HTMLButtonElement;
  private readonly stop: HTMLButtonElement;
  private number = 0;

  constructor(
    private readonly texts: Texts,
    private readonly bench: Workbench,
    name: string,
    what: string,
    private readonly request: () => Asking<D>,
    private readonly render: (answer: Answers[D]) => Node[],
    ...options: Node[]
  ) {
    this.go = h('button', { type: 'button', class: 'main', onclick: () => void this.run() }, name);
    this.stop = h('button', { type: 'button', hidden: true, onclick: () => this.bench.cancel(this.request().do) }, texts.stop);
    this.element = h('div', { class: 'asked' }, h('p', {}, what), h('div', { class: 'row' }, ...options, this.go, this.stop), this.state, this.result);
    bench.on('source', () => {
      if (this.result.childElementCount > 0) this.outdated();
    });
  }

  private outdated(): void {
    this.element.classList.add('old');
    this.state.textContent = this.texts.outdated;
  }

  async run(): Promise<void> {
    const number = ++this.number;
    const text = this.bench.source.text;
    const request = this.request();
    this.state.textContent = this.texts.computing;
    this.stop.hidden = false;
    const told = await this.bench.ask(request);
    if (number !== this.number) return;
    this.stop.hidden = true;
    this.state.textContent = told ? '' : this.texts.stopped;
    if (!told) return;
    this.element.classList.remove('old');
    this.result.replaceChildren(...('error' in told ? faultOf(told.error) : this.render(told.answer)));
    if (text !== this.bench.source.text) this.outdated();
  }
}

export function faultOf(fault: Fault): Node[] {
  return [h('p', { class: 'fault', lang: 'en' }, fault.message), ...(fault.help ? [h('p', { class: 'help', lang: 'en' }, fault.help)] : [])];
}
