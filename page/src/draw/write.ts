/** A drawn linkage as the text of a machine file. A point of several bodies is a pin, a fixed point a bearing; a guided point has a block on a guide. */
import type { Linkage } from '../protocol';
import { centre, inFrame, type Body, type Guide } from './linkage';

const quoted = (text: string): string => JSON.stringify(text.replaceAll(/\p{Cc}/gu, ''));
const figure = (value: number): string => String(Number(value.toPrecision(9)));
const lengths = ([u, v]: readonly [number, number]): string => `["${figure(u)} mm", "${figure(v)} mm"]`;

export function block(guide: Guide): string {
  return guide.body ?? `block ${guide.point}`;
}

function place(linkage: Linkage, name: string): [number, number] {
  const point = linkage.points.find((other) => other.name === name);
  return point ? [point.x, point.y] : [0, 0];
}

/** Angle (deg) of a body: from its first point to its second. */
function angle(linkage: Linkage, body: Body): number {
  const [a, b] = [place(linkage, body.points[0]!), place(linkage, body.points[1]!)];
  return (Math.atan2(b[1] - a[1], b[0] - a[0]) * 180) / Math.PI;
}

/** Degrees of freedom by Grübler's count; a pin of n bodies is n − 1 pins. */
export function freedoms(linkage: Linkage): number {
  const pins = linkage.points.reduce((sum, point) => {
    const held = point.ground || linkage.guides.some((guide) => guide.point === point.name) ? 1 : 0;
    return sum + Math.max(0, linkage.bodies.filter((body) => body.points.includes(point.name)).length + held - 1);
  }, 0);
  return 3 * (linkage.bodies.length + linkage.guides.length) - 2 * pins - 2 * linkage.guides.length;
}

export function drivesGuide(linkage: Linkage): boolean {
  return linkage.guides.some((guide) => guide.point === linkage.drive);
}

/** A range of a sliding drive that is larger than the linkage. */
export function wideStroke(linkage: Linkage): string {
  const size = Math.ceil(2 * Math.max(10, ...linkage.points.map(({ x, y }) => Math.hypot(x, y))));
  return `stroke = ["-${size} mm", "${size} mm"]`;
}

/** The machine file without motion and what the sheet does not show. `stroke` is a line for the mechanism. */
export function mechanismText(linkage: Linkage, stroke: string): string {
  const [gx, gy] = linkage.gravity ?? [0, -9.81];
  const guided = new Map(linkage.guides.map((guide) => [guide.point, guide]));
  const fixed = linkage.points.filter(({ name, ground }) => (guided.has(name) ? guided.get(name)!.on === undefined : ground));
  return [
    `title = ${quoted(linkage.title)}`,
    `gravity = ["${figure(gx)} m/s^2", "${figure(gy)} m/s^2"]`,
    '',
    '[mechanism]',
    'type = "linkage"',
    `drive = ${quoted(`${drivesGuide(linkage) ? 'guide' : 'bearing'} ${linkage.drive}`)}`,
    ...(stroke === '' ? [] : [stroke]),
    ...(linkage.flywheel === undefined ? [] : [`flywheel = "${figure(linkage.flywheel)} kg m^2"`]),
    `ground = { ${fixed.map(({ name, x, y }) => `${quoted(name)} = ${lengths([x, y])}`).join(', ')} }`,
    ...linkage.bodies.flatMap((body) => bodyLines(linkage, body)),
    ...linkage.guides.flatMap((guide) => [
      '', '[[mechanism.body]]', `name = ${quoted(block(guide))}`, `mass = "${figure(guide.mass ?? 0)} kg"`, ...(guide.on === undefined ? [] : ['inertia = "0 kg m^2"']),
    ]),
    ...linkage.points.flatMap(({ name, ground }) => pinLines(linkage, name, ground === true)),
    ...linkage.guides.flatMap((guide) => guideLines(linkage, guide)),
    ...linkage.loads.flatMap((load) => {
      const body = linkage.bodies.find(({ name }) => name === load.on);
      return [
        '', '[[load]]', `name = ${quoted(load.name)}`, `on = ${quoted(load.on)}`,
        ...(body && load.at !== '' ? [`at = ${lengths(inFrame(linkage, body, ...place(linkage, load.at)))}`] : []),
        ...(load.force ? [`force = ["${figure(load.force[0])} N", "${figure(load.force[1])} N"]`] : []),
        ...(load.moment === undefined ? [] : [`moment = "${figure(load.moment)} N m"`]),
        ...(load.opposingMoment === undefined ? [] : [`opposing_moment = "${figure(load.opposingMoment)} N m"`]),
        ...(load.opposing === undefined ? [] : [`opposing_force = "${figure(load.opposing)} N"`]),
      ];
    }),
    '',
  ].join('\n');
}

/** The machine file; with a `range` (deg or mm) the drive goes to and fro in it, else it turns on and on. */
export function machineText(linkage: Linkage, stroke: string, range: [number, number] | null): string {
  const { rest = '', speed } = linkage;
  const kept = speed === undefined ? rest : tables(rest, (table) => table !== 'motion');
  const motion = hasMotion(kept) ? [] : motionLines(linkage, range);
  return mechanismText(linkage, stroke) + [...motion, ...(kept === '' ? [] : ['', kept]), ''].join('\n');
}

export function hasMotion(tables: string): boolean {
  return /^\s*\[motion/m.test(tables);
}

/** The tables of a machine file whose first names are wanted, as they are. */
export function tables(text: string, wanted: (table: string) => boolean): string {
  let kept = false;
  const lines = text.split('\n').filter((line) => {
    const table = /^\s*\[\[?\s*([\w-]+)[\w. -]*\]\]?\s*(#.*)?$/.exec(line)?.[1];
    if (table !== undefined) kept = wanted(table);
    return kept;
  });
  return lines.join('\n').trim();
}

function bodyLines(linkage: Linkage, body: Body): string[] {
  const names = [...body.points, ...linkage.guides.filter(({ on, point }) => on === body.name && !body.points.includes(point)).map(({ point }) => point)];
  const at = names.map((name) => inFrame(linkage, body, ...place(linkage, name)));
  const length = Math.max(...at.slice(0, body.points.length).map(([u, v]) => Math.hypot(u, v))) / 1000;
  const mass = body.mass ?? 0;
  return [
    '', '[[mechanism.body]]',
    `name = ${quoted(body.name)}`,
    `mass = "${figure(mass)} kg"`,
    `inertia = "${figure(body.inertia ?? (mass * length * length) / 12)} kg m^2"`,
    `com = ${lengths(body.com ?? inFrame(linkage, body, ...centre(linkage, body)))}`,
    `angle = "${figure(angle(linkage, body))} deg"`,
    `points = { ${names.map((name, k) => `${quoted(name)} = ${lengths(at[k]!)}`).join(', ')} }`,
  ];
}

function pinLines(linkage: Linkage, name: string, ground: boolean): string[] {
  const guide = linkage.guides.find(({ point }) => point === name);
  const ends = linkage.bodies.filter(({ points }) => points.includes(name)).map((body) => quoted(`${body.name}.${name}`));
  if (guide) ends.unshift(quoted(block(guide)));
  else if (ground) ends.unshift(quoted(`ground.${name}`));
  return ends.slice(1).flatMap((end, k) => [
    '', '[[mechanism.joint]]', `name = ${quoted(`${ground && !guide ? 'bearing' : 'pin'} ${name}${k > 0 ? ` ${k + 1}` : ''}`)}`, `between = [${ends[0]}, ${end}]`,
  ]);
}

function guideLines(linkage: Linkage, guide: Guide): string[] {
  const on = linkage.bodies.find(({ name }) => name === guide.on);
  return [
    '', '[[mechanism.joint]]', `name = ${quoted(`guide ${guide.point}`)}`, 'type = "prismatic"',
    `between = [${quoted(`${guide.on ?? 'ground'}.${guide.point}`)}, ${quoted(block(guide))}]`,
    `direction = "${figure(guide.angle - (on ? angle(linkage, on) : 0))} deg"`,
  ];
}

function motionLines(linkage: Linkage, range: [number, number] | null): string[] {
  const speed = linkage.speed !== undefined && linkage.speed > 0 ? linkage.speed : 60;
  if (range === null) return ['', '[motion]', 'type = "constant-speed"', `speed = "${figure(speed)} rpm"`];
  const slides = drivesGuide(linkage);
  const unit = slides ? 'mm' : 'deg';
  const [from, to] = range;
  const time = (to - from) / (slides ? speed : 6 * speed);
  const segment = (way: number): string[] => ['', '[[motion.segment]]', 'law = "polynomial-345"', `move = "${figure(way)} ${unit}"`, `duration = "${figure(time)} s"`];
  return ['', '[motion]', 'type = "cycle"', `start = "${figure(from)} ${unit}"`, ...segment(to - from), ...segment(from - to)];
}
