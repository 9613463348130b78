/** What the core says about the machine: rules, other drives, what would have to change, motions, flywheel. */
import { Asked } from './asked';
import { checksOf, ruleTable, verdict } from './bars';
import { filled, h, shown, table } from './dom';
import { motionsPanel } from './motions';
import type { Answers, SizeAnswer, SizedDrive } from './protocol';
import { Tabs } from './tabs';
import type { Texts } from './texts';
import { driveName, type Workbench } from './workbench';

interface Remedy {
  lever: string;
  now: number;
  /** Not alone sufficient: null. */
  range: [End, End] | null;
  best: End | null;
  best_use: number | null;
}

interface End {
  value: number;
  rule: string | null;
}

interface Change {
  drive: string;
  holds: boolean;
  misses: { rule: string; used: number; limit: number }[];
  remedies: Remedy[];
}

export class AnswerPanel {
  readonly element: HTMLElement;
  private readonly rules = h('div', {});
  private readonly others = h('div', {});

  constructor(private readonly texts: Texts, private readonly bench: Workbench, exports: HTMLElement) {
    const change = new Asked(texts, bench, texts.findChanges, texts.changesAre,
      () => ({ do: 'size' as const, explain: true, ...(bench.pinned && bench.drive ? { drive: bench.drive } : {}) }), (answer) => this.changes(answer));
    const delta = h('input', { type: 'number', min: 0.1, max: 100, step: 'any', value: 3, id: 'delta' });
    const flywheel = new Asked(texts, bench, texts.findFlywheel, texts.flywheelIs,
      () => ({ do: 'flywheel' as const, delta: Number(delta.value) / 100 }), (answer) => this.flywheel(answer),
      h('label', { for: 'delta' }, texts.fluctuation), delta, h('span', {}, '%'));
    const tabs = new Tabs(texts.answers, [
      { id: 'rules', name: texts.rules, panel: this.rules },
      { id: 'others', name: texts.otherDrives, panel: this.others },
      { id: 'change', name: texts.changes, panel: change.element },
      { id: 'motions', name: texts.motions, panel: motionsPanel(texts, bench) },
      { id: 'flywheel', name: texts.flywheel, panel: flywheel.element },
      { id: 'export', name: texts.exports, panel: exports },
    ]);
    this.element = h('section', { class: 'card answers', 'aria-labelledby': 'answers-title' },
      h('h2', { id: 'answers-title' }, texts.answers), tabs.element);
    bench.on('sized', (answer) => {
      if (!bench.pinned) this.showRules(answer.fit[0] ?? answer.refused[0]);
      this.showOthers(answer);
    });
    bench.on('judged', (answer) => this.showRules(answer.asked ?? answer.fit[0] ?? answer.refused[0]));
    bench.on('unsized', (fault) => {
      this.rules.replaceChildren(h('p', { lang: 'en' }, fault.message));
      this.others.replaceChildren(h('p', { lang: 'en' }, fault.message));
    });
  }

  private showRules(drive: SizedDrive | undefined): void {
    if (!drive) return;
    const open = this.rules.scrollTop;
    this.rules.replaceChildren(
      h('p', { lang: 'en', title: driveName(drive) }, this.bench.parts(drive).join(' + ')),
      ruleTable(checksOf(drive), this.texts),
      ...(drive.assumptions.length > 0 ? [h('h3', {}, this.texts.assumptions), h('ul', { lang: 'en' }, ...drive.assumptions.map((words) => h('li', {}, words)))] : []));
    this.rules.scrollTop = open;
  }

  private showOthers(answer: SizeAnswer): void {
    const { texts } = this;
    const row = (drive: SizedDrive, place: string): (Node | string)[] => {
      const name = driveName(drive);
      const broken = checksOf(drive).filter((check) => check.verdict === 'fail').map((check) => check.rule).join(', ');
      return [place, h('span', { lang: 'en' }, name), `${shown(drive['rated power [W]'], 3)} W`, shown(drive.ratio), verdict(drive.verdict, texts, true),
        h('span', { lang: 'en' }, broken), h('button', { type: 'button', 'aria-label': `${texts.look}: ${name}`, onclick: () => this.bench.choose(name) }, texts.look)];
    };
    const head = [texts.rank, texts.drive, texts.ratedPower, texts.ratio, texts.verdict, texts.violates, ''];
    const unchecked = (answer['not checked'] as { rule: string; drives: number; missing: string; cure: string }[] | undefined) ?? [];
    this.others.replaceChildren(
      table(filled(texts.fittingDrives, answer.counts), head,
        answer.fit.map((drive, k) => row(drive, String(drive.rank ?? k + 1)))),
      h('p', { lang: 'en', class: 'note' }, answer.ranking),
      table(texts.refusedDrives, head, answer.refused.map((drive) => row(drive, '–'))),
      ...(unchecked.length > 0 ? [table(texts.uncheckedRules, [texts.rule, texts.drives, texts.missing, texts.cure],
        unchecked.map(({ rule, drives, missing, cure }) => [h('span', { lang: 'en' }, rule), String(drives), h('span', { lang: 'en' }, missing), h('span', { lang: 'en' }, cure)]))] : []));
  }

  private changes(answer: SizeAnswer): Node[] {
    const explained = answer.explanation as { change?: Change; 'nearest refused'?: Change[] } | undefined;
    const all = [...(explained?.change ? [explained.change] : []), ...(explained?.['nearest refused'] ?? [])];
    const levers: Record<string, string> = { 'gear-ratio': this.texts.leverRatio, 'cycle-time': this.texts.leverTime, 'moving-mass': this.texts.leverMass, 'process-load': this.texts.leverLoad };
    const end = ({ value, rule }: End, lever: Remedy): string =>
      `${lever.lever === 'gear-ratio' ? shown(value) : `× ${shown(value, 3)}`}${rule ? ` (${rule})` : ''}`;
    return all.map(({ drive, holds, misses, remedies }) => h('div', {},
      h('h3', { lang: 'en' }, drive),
      h('p', {}, holds ? this.texts.holds : `${this.texts.misses} ${misses.map(({ rule, used }) => `${rule} ${shown(100 * used, 4)} %`).join(', ')}`),
      table(holds ? this.texts.mayChange : this.texts.mustChange, [this.texts.lever, this.texts.from, this.texts.to],
        remedies.map((remedy) => {
          const at = remedy.best ? `, ${this.texts.atBest} ${end(remedy.best, remedy)} ${shown(100 * (remedy.best_use ?? NaN), 4)} %` : '';
          const ends = remedy.range ? remedy.range.map((of) => end(of, remedy)) : ['–', this.texts.notAlone + at];
          return [levers[remedy.lever] ?? remedy.lever, ...ends];
        }))));
  }

  private flywheel(answer: Answers['flywheel']): Node[] {
    const steady = answer as { cycle: Cycle | null; flywheel: { delta: number; inertia: number; inertia_at_motor: number; cycle: Cycle | null } | null; no_cycle: unknown };
    const { texts } = this;
    const row = (name: string, pick: (cycle: Cycle) => string): string[] =>
      [name, steady.cycle ? pick(steady.cycle) : '–', steady.flywheel?.cycle ? pick(steady.flywheel.cycle) : '–'];
    return [
      h('p', {}, steady.flywheel
        ? `${texts.flywheelNeeded} ${shown(steady.flywheel.inertia)} kg m² ${texts.atDriveLink}, ${texts.or} ${shown(steady.flywheel.inertia_at_motor)} kg m² ${texts.atMotor}`
        : texts.noFlywheel),
      table(texts.steadyCycle, ['', texts.asItIs, texts.withFlywheel], [
        row(texts.meanSpeed, (cycle) => `${shown((cycle.mean_speed * 30) / Math.PI)} rpm`),
        row(texts.fluctuation, (cycle) => `${shown(100 * cycle.delta)} %`),
        row(texts.meanTorque, (cycle) => `${shown(cycle.motor_torque.mean)} N m`),
        row(texts.rmsTorque, (cycle) => `${shown(cycle.motor_torque.rms)} N m`),
        row(texts.peakTorque, (cycle) => `${shown(cycle.motor_torque.peak)} N m`),
        row(texts.period, (cycle) => `${shown(cycle.period)} s`),
      ]),
    ];
  }
}

interface Cycle {
  mean_speed: number;
  delta: number;
  period: number;
  motor_torque: { mean: number; rms: number; peak: number };
}
