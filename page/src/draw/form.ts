/** The properties of what is selected on the sheet, and lists of all joints and links. */
import { h } from '../dom';
import type { Linkage } from '../protocol';
import type { Texts } from '../texts';
import type { Sheet } from './canvas';
import { addLink, bodyOf, changeBody, changePoint, keptLoads, renamedIn, setGuide, setLength, setLoad, toggleOnLink, type Body, type Point } from './linkage';

let fields = 0;

/** A number field; an empty one is `undefined`. */
function number(label: string, unit: string, value: number | undefined, set: (value: number | undefined) => unknown, hint = ''): HTMLElement {
  const id = `draw-${++fields}`;
  const input = h('input', { type: 'number', step: 'any', id, value: value === undefined ? '' : Math.round(value * 1e6) / 1e6, placeholder: hint });
  input.addEventListener('change', () => {
    const bad = !input.validity.valid;
    input.setAttribute('aria-invalid', String(bad));
    if (!bad) set(input.value === '' ? undefined : Number(input.value));
  });
  return h('div', { class: 'field' }, h('label', { for: id }, label), input, h('span', { class: 'unit' }, unit));
}

function tick(label: string, on: boolean, set: (on: boolean) => void, disabled = false): HTMLElement {
  const input = h('input', { type: 'checkbox', disabled });
  input.checked = on;
  input.addEventListener('change', () => set(input.checked));
  return h('label', { class: 'tick' }, input, ' ', label);
}

export function properties(texts: Texts, sheet: Sheet): Node[] {
  const { linkage, selected } = sheet;
  const point = selected?.kind === 'point' ? linkage.points.find(({ name }) => name === selected.name) : undefined;
  const body = selected?.kind === 'body' ? linkage.bodies.find(({ name }) => name === selected.name) : undefined;
  if (point) return ofPoint(texts, sheet, point);
  if (body) return ofBody(texts, sheet, body);
  return whole(texts, sheet);
}

function whole(texts: Texts, sheet: Sheet): Node[] {
  const { linkage } = sheet;
  const guided = linkage.guides.some(({ point }) => point === linkage.drive);
  const [gx, gy] = linkage.gravity ?? [0, -9.81];
  const list = (label: string, kind: 'point' | 'body', names: string[]): Node => h('p', {}, `${label} `, ...names.flatMap((name) => [
    h('button', { type: 'button', class: 'chip', onclick: () => sheet.select({ kind, name }) }, name), ' ']));
  return [
    h('h3', {}, texts.wholeLinkage),
    h('div', { class: 'fields' },
      number(texts.driveSpeed, guided ? 'mm/s' : 'rpm', linkage.speed, (speed) => sheet.change(withOptional(linkage, 'speed', speed), ''), linkage.rest === undefined ? '60' : texts.asInFile),
      number(`${texts.gravity} x`, 'm/s²', gx, (x) => sheet.change({ ...linkage, gravity: [x ?? 0, gy] }, '')),
      number(`${texts.gravity} y`, 'm/s²', gy, (y) => sheet.change({ ...linkage, gravity: [gx, y ?? 0] }, ''))),
    list(texts.joints, 'point', linkage.points.map(({ name }) => name)),
    list(texts.links, 'body', linkage.bodies.map(({ name }) => name)),
  ];
}

/** `undefined` takes the key away. */
function withOptional<T extends object, K extends keyof T>(of: T, key: K, value: T[K] | undefined): T {
  const next = { ...of };
  if (value === undefined) delete next[key];
  else next[key] = value;
  return next;
}

function ofPoint(texts: Texts, sheet: Sheet, point: Point): Node[] {
  const { linkage } = sheet;
  const { name } = point;
  const set = (change: Partial<Point>): void => sheet.change(changePoint(linkage, name, change), '');
  const guide = linkage.guides.find((old) => old.point === name);
  const load = linkage.loads.find((old) => old.at === name);
  const on = bodyOf(linkage, name);
  const force = load?.force ?? [0, 0];
  const loads = (change: { force?: [number, number]; opposing?: number } | undefined): void => sheet.change(setLoad(linkage, name, on ?? '', change), '');
  const others = linkage.points.filter((other) => other.name !== name);
  const to = h('select', { 'aria-label': texts.linkTo }, ...others.map((other) => h('option', {}, other.name)));
  return [
    h('h3', {}, `${texts.joint} ${name}`),
    h('div', { class: 'fields' },
      number('x', 'mm', point.x, (x) => set({ x: x ?? 0 })),
      number('y', 'mm', point.y, (y) => set({ y: y ?? 0 }))),
    h('div', { class: 'ticks' },
      tick(texts.fixedToFrame, point.ground === true, (ground) => set({ ground })),
      tick(texts.drivesHere, linkage.drive === name, (drives) => sheet.change({ ...linkage, drive: drives ? name : '' }, ''), !point.ground && !guide),
      tick(texts.slides, guide !== undefined, (slides) => sheet.change(setGuide(linkage, name, slides ? 0 : undefined), ''))),
    ...(guide ? [h('div', { class: 'fields' },
      number(texts.guideAngle, '°', guide.angle, (angle) => sheet.change(setGuide(linkage, name, angle ?? 0, guide.on), '')),
      number(texts.blockMass, 'kg', guide.mass, (mass) => sheet.change({ ...linkage, guides: linkage.guides.map((old) => (old.point === name ? withOptional(old, 'mass', mass) : old)) }, '')))] : []),
    ...(on === undefined || (point.ground && !guide) ? [] : [h('div', { class: 'fields' },
      number(`${texts.force} x`, 'N', load?.force?.[0], (x) => loads(x === undefined && force[1] === 0 ? undefined : { force: [x ?? 0, force[1]] })),
      number(`${texts.force} y`, 'N', load?.force?.[1], (y) => loads(y === undefined && force[0] === 0 ? undefined : { force: [force[0], y ?? 0] })),
      number(texts.opposing, 'N', load?.opposing, (opposing) => loads(opposing === undefined ? undefined : { opposing })))]),
    ...(others.length > 0 ? [h('div', { class: 'row' }, h('span', {}, texts.linkTo), to,
      h('button', { type: 'button', onclick: () => sheet.change(addLink(linkage, name, to.value), '') }, texts.addLink))] : []),
    h('button', { type: 'button', class: 'danger', onclick: () => sheet.remove() }, texts.remove),
  ];
}

function ofBody(texts: Texts, sheet: Sheet, body: Body): Node[] {
  const { linkage } = sheet;
  const { name } = body;
  const set = (change: Body): void => sheet.change(changeBody(linkage, name, () => change), '');
  const com = body.com;
  const load = linkage.loads.find((old) => old.on === name && old.at === '');
  const kept = keptLoads(linkage, name);
  // One of the two.
  const loads = (key: 'moment' | 'opposingMoment', moment: number | undefined): void => sheet.change(setLoad(linkage, '', name, moment === undefined ? undefined : { [key]: moment }), '');
  const [a, b] = body.points.map((point) => linkage.points.find((other) => other.name === point));
  const length = a && b ? Math.hypot(b.x - a.x, b.y - a.y) : 0;
  const turn = (to: string): Linkage => {
    const renamed = changeBody(linkage, name, () => ({ name: to }));
    return { ...renamed, ...renamedIn(linkage, name, to), guides: renamed.guides.map((guide) => (guide.on === name ? { ...guide, on: to } : guide)), loads: renamed.loads.map((load) => (load.on === name ? { ...load, on: to } : load)) };
  };
  const called = h('input', { type: 'text', value: name, 'aria-label': texts.name, maxlength: 40 });
  called.addEventListener('change', () => {
    const to = called.value.trim();
    const bad = to === '' || to === 'ground' || linkage.bodies.some((other) => other !== body && other.name === to);
    called.setAttribute('aria-invalid', String(bad));
    if (bad) return;
    sheet.change(turn(to), '');
    sheet.select({ kind: 'body', name: to });
  });
  return [
    h('h3', {}, `${texts.link} `, called),
    h('div', { class: 'fields' },
      ...(body.points.length === 2 ? [number(texts.length, 'mm', length, (to) => to !== undefined && to > 0 && sheet.change(setLength(linkage, body, to), ''))] : []),
      number(texts.mass, 'kg', body.mass, (mass) => set(withOptional(body, 'mass', mass))),
      number(texts.inertia, 'kg m²', body.inertia, (inertia) => set(withOptional(body, 'inertia', inertia)), texts.ofRod),
      number(`${texts.centreOfMass} u`, 'mm', com?.[0], (u) => set(withOptional(body, 'com', u === undefined ? undefined : [u, com?.[1] ?? 0])), String(Math.round(length / 2))),
      number(`${texts.centreOfMass} v`, 'mm', com?.[1], (v) => set(withOptional(body, 'com', v === undefined ? undefined : [com?.[0] ?? length / 2, v])), '0'),
      number(texts.moment, 'N m', load?.moment, (moment) => loads('moment', moment)),
      number(texts.opposingMoment, 'N m', load?.opposingMoment, (moment) => loads('opposingMoment', moment))),
    ...(kept.length > 0 ? [h('p', {}, `${texts.keptLoads} ${kept.join(', ')}`)] : []),
    h('div', { class: 'ticks' }, h('span', {}, texts.jointsOfLink), ...linkage.points.map((point) =>
      tick(point.name, body.points.includes(point.name), () => sheet.change(toggleOnLink(linkage, name, point.name), '')))),
    h('button', { type: 'button', class: 'danger', onclick: () => sheet.remove() }, texts.remove),
  ];
}
