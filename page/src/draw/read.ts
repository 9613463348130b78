/** The pins and guides of a machine as a linkage for the sheet. */
import type { Linkage, Pins } from '../protocol';
import { inFrame } from './linkage';

/** Two places nearer than this (mm) are one joint. */
const NEAR = 1e-3;

/** The linkage, or why the sheet cannot hold this machine. */
export function linkageOf(pins: Pins): Linkage | { problem: string } {
  if (pins.joints.some(({ bodies }) => bodies.length === 0)) return { problem: 'gears, cams, slots or rigid joints' };
  const mm = ([x, y]: [number, number]): [number, number] => [x * 1e3, y * 1e3];
  const linkage: Linkage = { title: pins.title, points: [], bodies: [], guides: [], drive: '', speed: 60, loads: [], gravity: pins.gravity, ...(pins.flywheel > 0 ? { flywheel: pins.flywheel } : {}) };
  const on = new Map<string, string[]>();
  const joint = (at: [number, number], wanted?: string): string => {
    const [x, y] = mm(at);
    const old = linkage.points.find((point) => Math.hypot(point.x - x, point.y - y) < NEAR);
    if (old) return old.name;
    const taken = linkage.points.map(({ name }) => name);
    const name = [wanted, ...'ABCDEFGHIJKLMNOPQRSTUVWXYZ', ...Array.from({ length: 40 }, (_, k) => `P${k + 1}`)].find((free) => free !== undefined && !taken.includes(free))!;
    linkage.points.push({ name, x, y });
    return name;
  };
  const add = (body: string | null, point: string): void => {
    if (body === null) linkage.points.find(({ name }) => name === point)!.ground = true;
    else if (!on.get(body)?.includes(point)) on.set(body, [...(on.get(body) ?? []), point]);
  };
  const name = (at: [number, number]): string | undefined => pins.links.flatMap(({ points }) => points).find((point) => Math.hypot(point.at[0] - at[0], point.at[1] - at[1]) < 1e-6)?.name;
  const blocks = new Map<string, { angle: number; on: string | null; joint: number }>();
  for (const [k, { bodies, angle }] of pins.joints.entries()) {
    if (angle === undefined) continue;
    const [guide, slides] = bodies[1] === null ? [null, bodies[0]!] : [bodies[0]!, bodies[1]!];
    if (slides === null) return { problem: 'a guide without a block' };
    blocks.set(slides, { angle: (angle * 180) / Math.PI, on: guide, joint: k });
  }
  for (const [k, { bodies, at, angle }] of pins.joints.entries()) {
    if (angle !== undefined) continue;
    const point = joint(at, name(at));
    for (const body of bodies) {
      const block = body === null ? undefined : blocks.get(body);
      if (!block) {
        add(body, point);
        continue;
      }
      if (linkage.guides.some((guide) => guide.body === body)) return { problem: `the block ${body} with several pins` };
      const { mass } = pins.links.find((link) => link.name === body)!;
      linkage.guides.push({ point, angle: block.angle, body: body!, mass, ...(block.on === null ? {} : { on: block.on }) });
      if (block.joint === pins.drive) linkage.drive = point;
    }
    if (k === pins.drive) linkage.drive = point;
  }
  for (const link of pins.links) {
    if (blocks.has(link.name)) continue;
    for (const point of link.points) add(link.name, joint(point.at, point.name));
    const points = on.get(link.name) ?? [];
    // The first two give the frame of the body; that of the machine, if they can, so that its loads keep their places.
    const [origin, ahead] = link.frame as [[number, number], [number, number]];
    const rank = (name: string): number => {
      const point = linkage.points.find((other) => other.name === name)!;
      const [x, y] = [point.x / 1e3 - origin[0], point.y / 1e3 - origin[1]];
      const [c, s] = [ahead[0] - origin[0], ahead[1] - origin[1]];
      if (Math.hypot(x, y) < 1e-6) return 0;
      return Math.abs(y * c - x * s) < 1e-6 && x * c + y * s > 0 ? 1 : 2;
    };
    points.sort((a, b) => rank(a) - rank(b));
    if (points.length < 2) return { problem: `the link ${link.name} with one joint` };
    const body = { name: link.name, points, mass: link.mass, inertia: link.inertia };
    linkage.bodies.push({ ...body, com: inFrame(linkage, body, ...mm(link.com)) });
  }
  return linkage.drive === '' || [...blocks.keys()].some((body) => !linkage.guides.some((guide) => guide.body === body)) ? { problem: 'a drive or a block without a pin' } : linkage;
}
