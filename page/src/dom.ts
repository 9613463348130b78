/** Elements of the page. */

type Child = Node | string | null | undefined | false;
type Props = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

/** An element. A function is a listener (`onclick`), `true` an empty attribute; `false` and `null` leave the attribute out. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return fill(document.createElement(tag), props, children);
}

/** An element of SVG. */
export function s<K extends keyof SVGElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), props, children);
}

function fill<E extends Element>(element: E, props: Props, children: Child[]): E {
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => typeof child === 'string' || child instanceof Node));
  return element;
}

/** A table with a caption; the first cell of each row heads it. */
export function table(caption: string, head: string[], rows: (Node | string)[][], hidden = false): HTMLElement {
  return h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': caption },
    h('table', {},
      h('caption', { class: hidden ? 'unseen' : null }, caption),
      h('thead', {}, h('tr', {}, ...head.map((name) => (name === '' ? h('td') : h('th', { scope: 'col' }, name))))),
      h('tbody', {}, ...rows.map(([first, ...rest]) => h('tr', {},
        h('th', { scope: 'row' }, first ?? ''),
        ...rest.map((cell) => h('td', {}, cell)))))));
}

/** An SVG text of the core as an element; nothing in it can run. */
export function svgOf(text: string): SVGSVGElement {
  const parsed = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
  for (const bad of parsed.querySelectorAll('script, foreignObject')) bad.remove();
  return document.importNode(parsed, true) as unknown as SVGSVGElement;
}

/** Runs `act` once `quiet` milliseconds have passed since the last call. */
export function settled(quiet: number, act: () => void): () => void {
  let timer = 0;
  return () => {
    clearTimeout(timer);
    timer = self.setTimeout(act, quiet);
  };
}

/** Gives the browser a file to save. */
export function save(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A number for reading, of `digits` significant digits. */
export function shown(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const short = Number(value.toPrecision(digits));
  return Math.abs(short) >= 1e6 || (short !== 0 && Math.abs(short) < 1e-4) ? short.toExponential() : String(short);
}

/** Words with the numbers of their `{keys}`. */
export function filled(words: string, numbers: Record<string, number>): string {
  return words.replaceAll(/\{(\w+)\}/g, (whole, key: string) => numbers[key]?.toLocaleString(document.documentElement.lang) ?? whole);
}

/** A unit for reading: "kg m^2" → "kg m²". */
export function unitShown(unit: string): string {
  return unit === 'deg' ? '°' : unit.replaceAll('^2', '²').replaceAll('^3', '³');
}
