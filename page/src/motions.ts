/** The fastest and the gentlest motion beside that of the file. */
import { Asked } from './asked';
import { h, shown, table } from './dom';
import { Plot, type Line } from './plots';
import type { Answers } from './protocol';
import type { Texts } from './texts';
import type { Workbench } from './workbench';

interface Gentlest {
  motions: { motion: string; rms_torque: number; peak_torque: number; peak_speed: number; work_drawn: number }[];
  nodes: number[][];
  unit: string;
  rules_not_kept: { rule: string }[];
}

interface Fastest {
  drive: string;
  duration: number;
  duration_before: number;
  motor: { rms_torque: number; peak_torque: number; peak_speed: number; pause_needed: number | null; rms_allowed: number };
  moves: { phases: { limit: string; from_time: number; to_time: number }[] }[];
  columns: string[];
  rows: (number | null)[][];
}

export function motionsPanel(texts: Texts, bench: Workbench): HTMLElement {
  const plot = new Plot(texts, 220);
  const lines = new Map<string, Line>();
  const draw = (name: string, points: Line['points'], style: Line['style'] = 'line'): void => {
    lines.set(name, { name, points, style });
    plot.element.hidden = false;
    plot.show({ title: texts.motions, x: `${texts.time} [s]`, y: `${texts.driveLinkSpeed} [rad/s]`, lines: [...lines.values()] });
  };
  plot.element.hidden = true;
  bench.on('source', () => {
    lines.clear();
    plot.element.hidden = true;
  });
  const own = async (): Promise<void> => {
    const told = await bench.ask({ do: 'curves' as const, over: 'time' as const, positions: 400 });
    if (!told || !('answer' in told)) return;
    const { columns, rows } = told.answer;
    const speed = columns.findIndex((name) => /^(omega|v) \[/.test(name));
    if (speed > 0) draw(texts.asInFile, rows.map((row) => [row[0] ?? null, row[speed] ?? null]), 'dashed');
  };
  const fastest = new Asked(texts, bench, texts.findFastest, texts.fastestIs,
    () => ({ do: 'fastest' as const, ...(bench.drive ? { drive: bench.drive } : {}) }),
    (answer: Answers['fastest']) => {
      const found = answer as unknown as Fastest;
      draw(texts.fastest, found.rows.map((row) => [row[0] ?? null, row[2] ?? null]));
      void own();
      return [
        h('p', {}, `${texts.cycleTime} ${shown(found.duration)} s (${texts.asInFile}: ${shown(found.duration_before)} s), ${texts.drive} `, h('span', { lang: 'en' }, found.drive)),
        ...(found.motor.pause_needed ? [h('p', {}, `${texts.pauseNeeded} ${shown(found.motor.pause_needed)} s: ${texts.rmsTorque} ${shown(found.motor.rms_torque)} N m > ${shown(found.motor.rms_allowed)} N m`)] : []),
        table(texts.whatLimits, [texts.limit, texts.from, texts.to], found.moves.flatMap(({ phases }) => phases.map(({ limit, from_time, to_time }) =>
          [h('span', { lang: 'en' }, limit), `${shown(from_time)} s`, `${shown(to_time)} s`]))),
      ];
    });
  const gentlest = new Asked(texts, bench, texts.findGentlest, texts.gentlestIs,
    () => ({ do: 'gentlest' as const, ...(bench.drive ? { drive: bench.drive } : {}) }),
    (answer: Answers['gentlest']) => {
      const found = answer as unknown as Gentlest;
      draw(texts.gentlest, found.nodes.map((node) => [node[0] ?? null, node[2] ?? null]));
      void own();
      const sorted = [...found.motions].sort((a, b) => a.rms_torque - b.rms_torque);
      const [torque, speed] = found.unit === 'm' ? ['N', 'm/s'] : ['N m', 'rad/s'];
      const head = [texts.motion, `${texts.rmsTorque} [${torque}]`, `${texts.peakTorque} [${torque}]`, `${texts.peakSpeed} [${speed}]`, `${texts.work} [J]`];
      const broken = found.rules_not_kept.map(({ rule }) => rule).join(', ');
      return [...(broken === '' ? [] : [h('p', {}, `${texts.drive} ${bench.drive}: ${texts.misses} `, h('span', { lang: 'en' }, broken))]), table(texts.motions, head, sorted.map((motion) => [
        h('span', { lang: 'en' }, motion.motion), shown(motion.rms_torque), shown(motion.peak_torque), shown(motion.peak_speed), shown(motion.work_drawn)]))];
    });
  return h('div', {}, plot.element, fastest.element, gentlest.element);
}
