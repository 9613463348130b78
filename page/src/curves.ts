/** J(φ), and the torque over the turn below it, with the position of the picture marked. */
import { h, unitShown } from './dom';
import { Plot, type Line } from './plots';
import type { Columns } from './protocol';
import type { Texts } from './texts';

export class Curves {
  readonly element: HTMLElement;
  private readonly inertia: Plot;
  private readonly torque: Plot;

  constructor(private readonly texts: Texts) {
    this.inertia = new Plot(texts, 130, true);
    this.torque = new Plot(texts, 170, true);
    this.element = h('section', { class: 'card curves', 'aria-labelledby': 'curves-title' },
      h('h2', { id: 'curves-title' }, texts.curves), this.inertia.element, this.torque.element);
  }

  at(position: number): void {
    this.inertia.at(position);
    this.torque.at(position);
  }

  show(columns: Columns): void {
    const x = columns.columns[0] ?? '';
    const pick = (test: (name: string) => boolean, of = columns): Line[] => of.columns.flatMap((name, k) => {
      if (k === 0 || !test(name)) return [];
      const points = of.rows.map((row): [number | null, number | null] => [row[of.columns.indexOf(x)] ?? null, row[k] ?? null]);
      return [{ name: plain(name), style: 'line' as const, points: of === columns ? closed(points, x) : points }];
    });
    const unitOf = (pattern: RegExp): string => columns.columns.map((name) => pattern.exec(name)?.[1]).find((found) => found) ?? '';
    const inertia = pick((name) => /^(J|m)_red \[/.test(name));
    // One axis has one unit: that of the drive link.
    const drive = pick((name) => /^[TF]_(drive|input) \[/.test(name) && name.endsWith(`[${unitOf(/^[TF]_drive \[(.*)\]/)}]`), columns.path);
    // Without a motion there is no torque of the drive yet: the load at rest.
    const torque = drive.length > 0 ? drive : pick((name) => /^[TF]_(potential|process) \[/.test(name));
    this.inertia.element.hidden = inertia.length === 0;
    this.torque.element.hidden = torque.length === 0;
    this.inertia.show({ title: this.texts.reducedInertia, x: plain(x, true), y: `${/^m_/.test(columns.columns[1] ?? '') ? 'm' : 'J'} [${unitShown(unitOf(/^[Jm]_red \[(.*)\]/))}]`, lines: inertia });
    this.torque.show({ title: this.texts.torqueOverTurn, x: plain(x, true), y: `[${unitShown(unitOf(/^[TF]_\w+ \[(.*)\]/))}]`, lines: torque });
  }
}

/** "T_drive [N m]" → "T drive". */
function plain(name: string, unit = false): string {
  const [, symbol, in_] = /^(.*?)(?: \[(.*)\])?$/.exec(name) ?? [];
  const words = (symbol ?? name).replace('phi', 'φ').replace('_red', '').replace('_', ' ');
  return unit && in_ ? `${words} [${unitShown(in_)}]` : words;
}

/** A turn ends where it began. */
function closed(points: [number | null, number | null][], x: string): [number | null, number | null][] {
  const [first, last] = [points[0], points.at(-1)];
  if (!first || !last || !x.startsWith('phi') || first[0] === null || last[0] === null || points.length < 3) return points;
  const step = points[1]![0]! - first[0];
  return Math.abs(last[0] + step - first[0] - 360) < 1e-6 ? [...points, [first[0] + 360, first[1]]] : points;
}
