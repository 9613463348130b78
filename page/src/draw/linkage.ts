/** Changes of a linkage that is drawn: each gives a new one. Lengths in mm. */
import type { Linkage } from '../protocol';

export type Point = Linkage['points'][number];
export type Body = Linkage['bodies'][number];
export type Guide = Linkage['guides'][number];
export type Load = Linkage['loads'][number];

/** A four-bar that turns, to begin with. */
export const BEGIN: Linkage = {
  title: 'Four-bar',
  points: [
    { name: 'O', x: 0, y: 0, ground: true },
    { name: 'A', x: 40, y: 60 },
    { name: 'B', x: 260, y: 170 },
    { name: 'C', x: 240, y: 0, ground: true },
  ],
  bodies: [bar('crank', ['O', 'A']), bar('coupler', ['A', 'B']), bar('rocker', ['B', 'C'])],
  guides: [],
  drive: 'O',
  speed: 60,
  loads: [],
  gravity: [0, -9.81],
};

export const EMPTY: Linkage = { title: 'Linkage', points: [], bodies: [], guides: [], drive: '', speed: 60, loads: [], gravity: [0, -9.81] };

function bar(name: string, points: string[]): Body {
  return { name, points, mass: 1 };
}

/** The first name that is not taken: A, B, …, Z, A2, … */
function free(taken: string[]): string {
  for (let round = 1; ; round++) {
    for (let k = 0; k < 26; k++) {
      const name = String.fromCharCode(65 + k) + (round > 1 ? round : '');
      if (!taken.includes(name)) return name;
    }
  }
}

export function addPoint(linkage: Linkage, x: number, y: number, more: Partial<Point> = {}): [Linkage, string] {
  const name = free(linkage.points.map((point) => point.name));
  return [{ ...linkage, points: [...linkage.points, { name, x, y, ...more }] }, name];
}

export function movePoint(linkage: Linkage, name: string, x: number, y: number): Linkage {
  return changePoint(linkage, name, { x, y });
}

export function changePoint(linkage: Linkage, name: string, change: Partial<Point>): Linkage {
  return { ...linkage, points: linkage.points.map((point) => (point.name === name ? { ...point, ...change } : point)) };
}

/** A link between two points, unless there is one. */
export function addLink(linkage: Linkage, from: string, to: string): Linkage {
  if (from === to || linkage.bodies.some(({ points }) => points.includes(from) && points.includes(to))) return linkage;
  const names = linkage.bodies.map((body) => body.name);
  let number = names.length + 1;
  while (names.includes(`link ${number}`)) number++;
  return { ...linkage, bodies: [...linkage.bodies, bar(`link ${number}`, [from, to])] };
}

/** Makes a point one of a link, or takes it off; a link keeps two points. */
export function toggleOnLink(linkage: Linkage, body: string, point: string): Linkage {
  return changeBody(linkage, body, ({ points }) => {
    if (!points.includes(point)) return { points: [...points, point] };
    return points.length > 2 ? { points: points.filter((name) => name !== point) } : {};
  });
}

export function changeBody(linkage: Linkage, name: string, change: (body: Body) => Partial<Body>): Linkage {
  return { ...linkage, bodies: linkage.bodies.map((body) => (body.name === name ? { ...body, ...change(body) } : body)) };
}

/**
 * With another length of a link of two joints. The other links keep theirs, and fixed joints and lines of blocks their places, if they can: all joints
 * are moved by half of each error, over and over; else only the ends of this link move.
 */
export function setLength(linkage: Linkage, body: Body, length: number): Linkage {
  const at = new Map(linkage.points.map(({ name, x, y }) => [name, { x, y }]));
  const size = (a: string, b: string): number => Math.hypot(at.get(b)!.x - at.get(a)!.x, at.get(b)!.y - at.get(a)!.y);
  const pairs = linkage.bodies.flatMap(({ name, points }) => points.flatMap((a, k) => points.slice(k + 1).map((b) => ({ a, b, wanted: name === body.name ? length : size(a, b) }))));
  const lines = linkage.guides.filter(({ on }) => on === undefined).map(({ point, angle }) => ({ point, from: { ...at.get(point)! }, c: Math.cos((angle * Math.PI) / 180), s: Math.sin((angle * Math.PI) / 180) }));
  const loose = (name: string): number => (linkage.points.find((point) => point.name === name)?.ground && !lines.some(({ point }) => point === name) ? 0 : 1);
  const stretch = (a: string, b: string, wanted: number): number => {
    const [p, q, now] = [at.get(a)!, at.get(b)!, size(a, b)];
    const share = (now - wanted) / ((now || 1) * (loose(a) + loose(b) || 1));
    const [x, y] = [(q.x - p.x) * share, (q.y - p.y) * share];
    at.set(a, { x: p.x + x * loose(a), y: p.y + y * loose(a) });
    at.set(b, { x: q.x - x * loose(b), y: q.y - y * loose(b) });
    return Math.abs(now - wanted);
  };
  const moved = (): Linkage => ({ ...linkage, points: linkage.points.map((point) => ({ ...point, ...at.get(point.name) })) });
  for (let round = 0; round < 5000; round++) {
    const worst = Math.max(...pairs.map(({ a, b, wanted }) => stretch(a, b, wanted)));
    for (const { point, from, c, s } of lines) {
      const along = (at.get(point)!.x - from.x) * c + (at.get(point)!.y - from.y) * s;
      at.set(point, { x: from.x + along * c, y: from.y + along * s });
    }
    if (worst < 1e-9) return moved();
  }
  for (const { name, x, y } of linkage.points) at.set(name, { x, y });
  stretch(body.points[0]!, body.points[1]!, length);
  return moved();
}

/** A load that is kept as text. */
const KEPT = /^\[\[load\]\][ \t]*(?:#.*)?$(?:\n(?!\[).*)*/gm;
const ON = /^(\s*on\s*=\s*)(["'])(.*?)\2/m;

/** Names of the loads on a link that are kept as text. */
export function keptLoads({ rest = '' }: Linkage, link: string): string[] {
  const own = (rest.match(KEPT) ?? []).filter((load) => ON.exec(load)?.[3] === link);
  return own.map((load, k) => /^\s*name\s*=\s*(["'])(.*?)\1/m.exec(load)?.[2] ?? String(k + 1));
}

/** The tables kept as text once a link has another name; without one it is gone, and so are its loads. */
export function renamedIn(linkage: Linkage, link: string, name?: string): { rest?: string } {
  const change = (load: string): string => (ON.exec(load)?.[3] !== link ? load : name === undefined ? '' : load.replace(ON, (_, key: string) => key + JSON.stringify(name)));
  return linkage.rest === undefined ? {} : { rest: linkage.rest.replace(KEPT, change).trim() };
}

export function removeBody(linkage: Linkage, name: string): Linkage {
  return {
    ...linkage,
    ...renamedIn(linkage, name),
    bodies: linkage.bodies.filter((body) => body.name !== name),
    guides: linkage.guides.filter((guide) => guide.on !== name && guide.body !== name),
    loads: linkage.loads.filter((load) => load.on !== name),
  };
}

/** Without a point; links that are left with one point go, too. */
export function removePoint(linkage: Linkage, name: string): Linkage {
  const less = {
    ...linkage,
    points: linkage.points.filter((point) => point.name !== name),
    bodies: linkage.bodies.map((body) => ({ ...body, points: body.points.filter((point) => point !== name) })),
    guides: linkage.guides.filter((guide) => guide.point !== name),
    loads: linkage.loads.filter((load) => load.at !== name),
    drive: linkage.drive === name ? '' : linkage.drive,
  };
  return less.bodies.filter((body) => body.points.length < 2).reduce((rest, body) => removeBody(rest, body.name), less);
}

export function setGuide(linkage: Linkage, point: string, angle: number | undefined, on?: string): Linkage {
  const others = linkage.guides.filter((guide) => guide.point !== point);
  if (angle === undefined) return { ...linkage, guides: others };
  const guide: Guide = { ...linkage.guides.find((old) => old.point === point), point, angle };
  if (on === undefined) delete guide.on;
  else guide.on = on;
  return { ...linkage, guides: [...others, guide] };
}

export function setLoad(linkage: Linkage, at: string, on: string, load: Partial<Load> | undefined): Linkage {
  const others = linkage.loads.filter((old) => old.at !== at || (at === '' && old.on !== on));
  if (load === undefined) return { ...linkage, loads: others };
  return { ...linkage, loads: [...others, { name: `load ${at === '' ? `on ${on}` : `at ${at}`}`, on, at, ...load }] };
}

/** The link or the name of the guided slide block that a point belongs to. */
export function bodyOf(linkage: Linkage, point: string): string | undefined {
  return linkage.bodies.find(({ points }) => points.includes(point))?.name ?? linkage.guides.find((guide) => guide.point === point)?.body;
}

/** Centre of mass on the page: as given, in the frame of the link from its first point to its second; else the middle of its points. */
export function centre(linkage: Linkage, body: Body): [number, number] {
  const at = body.points.flatMap((name) => linkage.points.find((point) => point.name === name) ?? []);
  const [a, b] = at;
  if (!a || !b) return [a?.x ?? 0, a?.y ?? 0];
  if (!body.com) return [at.reduce((sum, { x }) => sum + x, 0) / at.length, at.reduce((sum, { y }) => sum + y, 0) / at.length];
  const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
  const [c, s] = [(b.x - a.x) / length, (b.y - a.y) / length];
  return [a.x + body.com[0] * c - body.com[1] * s, a.y + body.com[0] * s + body.com[1] * c];
}

/** A place on the page in the frame of a link. */
export function inFrame(linkage: Linkage, body: Body, x: number, y: number): [number, number] {
  const [a, b] = body.points.map((name) => linkage.points.find((point) => point.name === name));
  if (!a || !b) return [0, 0];
  const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
  const [c, s] = [(b.x - a.x) / length, (b.y - a.y) / length];
  const round = (value: number): number => Math.round(value * 1e6) / 1e6;
  return [round((x - a.x) * c + (y - a.y) * s), round((y - a.y) * c - (x - a.x) * s)];
}
