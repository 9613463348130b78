/** Rules as bars: how much of each limit is used. */
import { h, shown, table } from './dom';
import type { SizedDrive } from './protocol';
import type { Texts } from './texts';

export interface Check {
  rule: string;
  value: number | null;
  limit: number | null;
  unit: string;
  margin: number | null;
  verdict: string;
  note: string;
  source: string;
}

export function checksOf(drive: SizedDrive): Check[] {
  return drive.checks as unknown as Check[];
}

/** Share of the limit; undefined without figures. */
export function used(check: Check): number | undefined {
  if (check.margin !== null) return 1 - check.margin;
  if (check.value !== null && check.limit !== null && check.limit !== 0) return check.value / check.limit;
  return undefined;
}

/** Violations and warnings first, then those that use most of their limits, then those that are not checked. */
export function byUse(checks: Check[]): Check[] {
  const urgency = ({ verdict }: Check): number => (verdict === 'fail' ? 2 : verdict === 'warn' ? 1 : 0);
  return [...checks].sort((a, b) => urgency(b) - urgency(a) || (used(b) ?? -1) - (used(a) ?? -1));
}

/** The limit is a least value: more is better. */
function isLeast(check: Check): boolean {
  const share = used(check);
  return share !== undefined && share !== 1 && check.value! > check.limit! !== share > 1;
}

/** A bar that ends at 150 % of the limit, with a stroke at 100 %. */
export function bar(check: Check): HTMLElement {
  const share = used(check);
  const width = share === undefined ? 0 : Math.min(100, Math.max(0, (share * 100) / 1.5));
  return h('span', { class: `bar ${check.verdict}`, 'aria-hidden': 'true' }, h('span', { style: `width:${width}%` }));
}

export function percent(check: Check): string {
  const share = used(check);
  return share === undefined ? '–' : `${shown(100 * share, share < 1 ? 2 : 3)} %`;
}

/** Of a rule, or of a `whole` drive. */
export function verdict(word: string, texts: Texts, whole = false): HTMLElement {
  const words: Record<string, string> = {
    pass: texts.pass,
    warn: texts.warn,
    fail: texts.fail,
    'not-checked': whole ? texts.asFarAsChecked : texts.notChecked,
  };
  return h('span', { class: `verdict ${word}` }, words[word] ?? word);
}

/** The few rules that decide. */
export function shortBars(checks: Check[], most: number, texts: Texts): HTMLElement {
  const shownChecks = byUse(checks).filter((check) => used(check) !== undefined).slice(0, most);
  return h('ul', { class: 'bars' }, ...shownChecks.map((check) =>
    h('li', {}, h('span', { lang: 'en' }, check.rule), bar(check), h('span', { class: 'number' }, percent(check)), verdict(check.verdict, texts))));
}

export function ruleTable(checks: Check[], texts: Texts): HTMLElement {
  const figure = (value: number | null, unit: string): string => (value === null ? '–' : `${shown(value)} ${unit}`);
  const limit = (check: Check): string => (isLeast(check) ? `${texts.atLeast} ` : '') + figure(check.limit, check.unit);
  return table(texts.rulesOfDrive, [texts.rule, texts.figure, texts.limit, texts.used, texts.verdict, texts.basis], byUse(checks).map((check) => [
    h('span', { lang: 'en' }, check.rule),
    figure(check.value, check.unit),
    limit(check),
    h('span', { class: 'use' }, percent(check), bar(check)),
    verdict(check.verdict, texts),
    h('span', { lang: 'en', class: 'note' }, `${check.note}${check.source ? ` (${check.source})` : ''}`),
  ]));
}
