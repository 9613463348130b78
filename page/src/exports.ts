/** What can be taken away: tables for firmware and PLC, the report, numbers, the machine file, the drawing. */
import { faultOf } from './asked';
import { h, save } from './dom';
import type { Answers, Download, ExportForm, Request } from './protocol';
import type { Texts } from './texts';
import type { Asking, Workbench } from './workbench';

const TABLES: [ExportForm, string][] = [['image', '.jred'], ['c', '.h'], ['rust', '.rs'], ['json', '.json'], ['st', '.st'], ['plcopen', '.xml']];

export function exportsPanel(texts: Texts, bench: Workbench, drawing: () => string | undefined): HTMLElement {
  const state = h('div', { class: 'state', role: 'status' });
  const say = (...nodes: (Node | string)[]): void => state.replaceChildren(...nodes);
  const bare = (): string => bench.source.name.replace(/\.toml$/, '');
  const ask = async <D extends Request['do']>(request: Asking<D>, done: (answer: Answers[D]) => void): Promise<void> => {
    say(texts.computing);
    const told = await bench.ask(request);
    if (!told) say(texts.stopped);
    else if ('error' in told) say(...faultOf(told.error));
    else {
      done(told.answer);
      say(texts.saved);
    }
  };
  const error = h('input', { type: 'text', id: 'torque-error', value: '0.5 N m', class: 'short' });
  const button = (name: string, act: () => void): HTMLElement => h('button', { type: 'button', onclick: act }, name);
  const day = (): string => new Date().toISOString().slice(0, 10);
  const names: Record<ExportForm, string> = { image: texts.tableImage, c: 'C', rust: 'Rust', json: 'JSON', st: texts.structuredText, plcopen: 'PLCopen XML' };
  return h('div', { class: 'exports' },
    h('h3', {}, texts.tableForFirmware),
    h('p', {}, texts.tableIs),
    h('div', { class: 'row' }, h('label', { for: 'torque-error' }, texts.torqueError), error, ...TABLES.map(([form, ending]) =>
      button(`${names[form]} (${ending})`, () => void ask(
        { do: 'export' as const, form, torqueError: error.value.trim(), day: day() },
        (answer: Download) => save(answer.name, 'application/octet-stream', answer.text ?? new Uint8Array(answer.bytes ?? [])))))),
    h('h3', {}, texts.results),
    h('div', { class: 'row' },
      button(texts.machineFile, () => save(bench.source.name, 'application/toml', bench.source.text)),
      button(texts.report, () => void ask({ do: 'report' as const, day: day(), ...(bench.pinned && bench.drive ? { drive: bench.drive } : {}) }, ({ html }) => save(`${bare()}.html`, 'text/html', html))),
      button(texts.sizingJson, () => void ask({ do: 'size' as const }, (answer) => save(`${bare()}-size.json`, 'application/json', JSON.stringify(answer, null, 1)))),
      button(texts.drawingSvg, () => {
        const svg = drawing();
        if (svg) save(`${bare()}.svg`, 'image/svg+xml', svg);
      }),
      button(texts.print, () => print())),
    state);
}
