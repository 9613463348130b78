/** Linkages of David Rector's program Linkage (*.linkage2, XML): joints, links, sliders and the input; it knows no masses. */
import type { Linkage } from '../protocol';

/** Its lengths are pixels of 96 to an inch. */
const PIXEL = 25.4 / 96;

export function fromLinkage2(name: string, text: string): { linkage: Linkage; notes: string } | { problem: string } {
  const xml = new DOMParser().parseFromString(text, 'application/xml');
  if (xml.querySelector('parsererror') || xml.documentElement.tagName !== 'linkage2') return { problem: 'not a file of Linkage (*.linkage2) or a machine file (*.toml)' };
  const scale = PIXEL * (Number(xml.querySelector('program')?.getAttribute('scalefactor')) || 1);
  const connectors = [...xml.querySelectorAll('linkage2 > connector')];
  const named = new Map(connectors.map((connector, k) => [connector.getAttribute('id') ?? '', `P${k + 1}`]));
  const number = (element: Element, key: string): number => Number(element.getAttribute(key)) || 0;
  const round = (value: number): number => Math.round(value * scale * 1e3) / 1e3;
  const is = (element: Element, key: string): boolean => element.getAttribute(key) === 'true';
  const points = connectors.map((connector, k) => ({ name: `P${k + 1}`, x: round(number(connector, 'x')), y: round(number(connector, 'y')), ground: is(connector, 'anchor') }));
  const fixed = new Set(points.filter(({ ground }) => ground).map(({ name }) => name));
  const held = (parent: Element, tag: string): string[] => [...parent.querySelectorAll(`:scope > ${tag}`)].flatMap((child) => named.get(child.getAttribute('id') ?? '') ?? []);
  const bodies = [...xml.querySelectorAll('linkage2 > Link')]
    .map((link) => ({ name: `link ${link.getAttribute('id') ?? ''}`, points: held(link, 'connector'), mass: 1 }))
    // A link between fixed joints is the frame.
    .filter((body) => body.points.length > 1 && !body.points.every((point) => fixed.has(point)));
  const guides = connectors.flatMap((connector, k) => {
    const ends = held(connector, 'slidelimit').map((end) => points.find((point) => point.name === end)!);
    const [a, b] = ends;
    if (!is(connector, 'slider') || !a || !b) return [];
    const angle = (Math.atan2(b.y - a.y, b.x - a.x) * 180) / Math.PI;
    const on = a.ground && b.ground ? undefined : bodies.find((body) => body.points.includes(a.name) && body.points.includes(b.name))?.name;
    return [{ point: `P${k + 1}`, angle, ...(on === undefined ? {} : { on }) }];
  });
  const used = new Set([...bodies.flatMap((body) => body.points)]);
  const input = connectors.find((connector) => is(connector, 'input') && is(connector, 'anchor'));
  return {
    linkage: {
      title: name.replace(/\.linkage2$/i, ''),
      points: points.filter((point) => used.has(point.name)),
      bodies,
      guides,
      drive: named.get(input?.getAttribute('id') ?? '') ?? '',
      speed: Math.abs(number(input ?? xml.documentElement, 'rpm')) || 60,
      loads: [],
      gravity: [0, -9.81],
    },
    notes: 'masses (1 kg a link), forces, gravity.',
  };
}
