/**
 * Linkages of PMKS+ from the link that it shares: SETTINGS.DECIMALS.COUNTS.UNITS.joint.joint..link.link..force.. behind a question mark, with commas
 * between fields; numbers are thousandths to the base 64, negative ones behind a zero.
 */
import type { Linkage } from '../protocol';
import { inFrame } from './linkage';

const DIGITS = '0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-';
/** Millimetres of an inch, a centimetre, a metre. */
const UNITS = [25.4, 10, 1000];

class Wrong extends Error {}

function integer(text: string | undefined): number {
  const digits = text === '0' ? '0' : (text ?? '').replace(/^0/, '');
  const size = [...digits].reduce((sum, digit) => (DIGITS.includes(digit) ? sum * 64 + DIGITS.indexOf(digit) : NaN), 0);
  if (digits === '' || !Number.isSafeInteger(size)) throw new Wrong();
  return text!.startsWith('0') ? 0 - size : size;
}

const decimal = (text: string | undefined): number => integer(text) / 1000;

function joint(part: string, unit: number) {
  const fields = part.split(',');
  const flags = integer(fields[0]![0]);
  // Older links have no names of joints.
  const [x, y, angle, ...slot] = fields.slice(fields.length === 4 ? 1 : 2);
  return {
    id: fields[0]!.slice(1), x: decimal(x) * unit, y: decimal(y) * unit, angle: decimal(angle), slot,
    slides: (flags & 1) !== 0, input: (flags & 2) !== 0, ground: (flags & 4) !== 0, welded: (flags & 8) !== 0,
  };
}

function read(text: string): { linkage: Linkage; notes: string } | { problem: string } {
  const parts = decodeURIComponent(/[?#](.*)/.exec(text)?.[1] ?? text.trim()).split('.');
  const [, , counts, units] = parts.splice(0, 4);
  const list = (): string[] => {
    const end = parts.indexOf('');
    return end < 0 ? parts.splice(0) : parts.splice(0, end + 1).slice(0, -1);
  };
  const [joints, links, forces] = [list(), list(), list()];
  const unit = UNITS[integer(units?.[0])];
  if (unit === undefined || joints.length === 0 || links.length === 0) throw new Wrong();
  const all = joints.map((part) => joint(part, unit));
  const find = (id: string | undefined) => {
    const found = all.find((own) => own.id === id);
    if (!found) throw new Wrong();
    return found;
  };
  const welded = all.find((own) => own.welded);
  if (welded) return { problem: `the joint ${welded.id}, which is welded: make its links one link` };
  const linkage: Linkage = {
    title: 'Linkage of PMKS+',
    points: all.filter(({ slides }) => !slides).map(({ id, x, y, ground }) => ({ name: id, x, y, ground })),
    bodies: [],
    guides: [],
    drive: all.find(({ input, slides }) => input && !slides)?.id ?? '',
    speed: Math.abs(integer(counts?.split(',')[0])) || 60,
    loads: [],
    gravity: [0, -9.81],
  };
  const id = (part: string): string => part.split(',')[0]!.slice(2);
  // A part of a link of several begins with N.
  for (const part of links.filter((own) => !own.startsWith('N'))) {
    const [, , mass, inertia, x, y, , ...rest] = part.split(',');
    const own = rest.slice(0, rest.indexOf('') < 0 ? undefined : rest.indexOf('')).map(find);
    if (part[1] === 'P') {
      const [slide, pin] = [own.find(({ slides }) => slides), own.find(({ slides }) => !slides)];
      if (!slide || !pin) throw new Wrong();
      const [on, a, b] = slide.slot;
      const angle = on === undefined ? slide.angle : Math.atan2(find(b).y - find(a).y, find(b).x - find(a).x);
      linkage.guides.push({ point: pin.id, angle: Math.round((angle * 180e3) / Math.PI) / 1e3, ...(on === undefined ? {} : { on }), mass: decimal(mass) });
      if (slide.input) linkage.drive = pin.id;
      continue;
    }
    const body = { name: id(part), points: own.map((point) => point.id), mass: decimal(mass), inertia: decimal(inertia) };
    linkage.bodies.push({ ...body, com: inFrame(linkage, body, decimal(x) * unit, decimal(y) * unit) });
  }
  for (const part of forces) {
    const [first, on, name, ...rest] = part.split(',');
    const [x, y, toX, toY, size] = rest.map(decimal);
    const body = linkage.bodies.find((own) => own.name === on);
    if (!body || size === undefined) throw new Wrong();
    const place = { name: first!.slice(1), x: x! * unit, y: y! * unit };
    const near = linkage.points.find((point) => Math.hypot(point.x - place.x, point.y - place.y) < 1e-3);
    if (!near) {
      linkage.points.push(place);
      body.points.push(place.name);
    }
    // One that faces inwards points from the end of its arrow to the start.
    const [dx, dy] = [toX! - x!, toY! - y!];
    const scale = (integer(first![0]) & 2 ? size : -size) / (Math.hypot(dx, dy) || 1);
    linkage.loads.push({ name: name ?? '', on: body.name, at: (near ?? place).name, force: [dx * scale, dy * scale] });
  }
  return { linkage, notes: 'gravity; PMKS+ begins with 1 kg and 1 kg m² a link, and a force that turns with its link keeps its direction here.' };
}

export function fromPmks(text: string): { linkage: Linkage; notes: string } | { problem: string } {
  try {
    return read(text);
  } catch (error) {
    if (error instanceof Wrong || error instanceof URIError) return { problem: 'not a link of PMKS+' };
    throw error;
  }
}
