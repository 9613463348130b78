/** The chosen drive: its name, its duty in the torque-speed plane, and the limits of which it uses most. */
import { checksOf, shortBars, used } from './bars';
import { filled, h, shown } from './dom';
import { ofChart, Plot } from './plots';
import type { Charts, Fault, SizeAnswer, SizedDrive } from './protocol';
import type { Texts } from './texts';
import { driveName, type Workbench } from './workbench';

export class DrivePanel {
  readonly element: HTMLElement;
  private readonly name = h('p', { class: 'drive-name' });
  private readonly state = h('p', { class: 'state', role: 'status' });
  private readonly bars = h('div', {});
  private readonly plane: Plot;
  private readonly release: HTMLButtonElement;
  private readonly brief: (words: string) => void;

  /** `brief` is told the drive in one line. */
  constructor(private readonly texts: Texts, private readonly bench: Workbench, brief: (words: string) => void) {
    this.brief = brief;
    this.plane = new Plot(texts, 260);
    this.release = h('button', { type: 'button', hidden: true, onclick: () => this.bench.choose(undefined) }, texts.backToBest);
    this.element = h('section', { class: 'card drive', 'aria-labelledby': 'drive-title' },
      h('h2', { id: 'drive-title' }, texts.chosenDrive), this.name, this.release, this.state, this.plane.element, this.bars);
    bench.on('sized', (answer) => this.sized(answer));
    bench.on('judged', (answer) => this.judged(answer));
    bench.on('charts', (charts) => this.charts(charts));
    bench.on('unsized', (fault) => this.unsized(fault));
    bench.on('sizing', (on) => this.element.setAttribute('aria-busy', String(on)));
    this.say(texts.sizing);
  }

  private say(words: string): void {
    if (this.state.textContent !== words) this.state.textContent = words;
  }

  private sized(answer: SizeAnswer): void {
    const best = answer.fit[0];
    this.release.hidden = !this.bench.pinned;
    if (this.bench.pinned) return;
    if (best) this.drive(best, filled(this.texts.fitting, answer.counts));
    else this.drive(answer.refused[0], filled(this.texts.noneFits, answer.counts));
  }

  /** The first drive for a text that has just changed; the others follow. */
  private judged(answer: SizeAnswer): void {
    const drive = answer.asked ?? answer.fit[0] ?? answer.refused[0];
    this.release.hidden = !this.bench.pinned;
    const first = answer.counts.fit > 0 ? this.texts.rankingFollows : filled(this.texts.noneFits, answer.counts);
    this.drive(drive, this.bench.pinned ? this.texts.chosenByYou : first);
  }

  private drive(drive: SizedDrive | undefined, words: string): void {
    if (!drive) {
      this.name.textContent = this.texts.noDrive;
      this.say(words);
      this.bars.replaceChildren();
      this.brief(this.texts.noDrive);
      return;
    }
    const checks = checksOf(drive);
    const named = this.bench.parts(drive);
    const ratio = drive.gearbox === null ? this.texts.direct : `i\u00a0=\u00a0${shown(drive.ratio)}`;
    this.name.replaceChildren(h('strong', { lang: 'en', title: driveName(drive) }, named.join(' + ')), `, ${ratio}, ${shown(drive['rated power [W]'], 3)}\u00a0W`);
    const count = (verdict: string): number => checks.filter((check) => check.verdict === verdict).length;
    this.say(`${words} ${filled(this.texts.notPassed, { warn: count('warn'), unchecked: count('not-checked') })}`);
    this.bars.replaceChildren(shortBars(checks, 8, this.texts));
    const closest = checks.reduce<typeof checks[number] | undefined>((most, check) => ((used(check) ?? 0) > (most ? used(most)! : 0) && check.verdict !== 'warn' ? check : most), undefined);
    this.brief(`${named.slice(0, 2).join(' + ')}${closest ? ` · ${closest.rule} ${shown(100 * used(closest)!, 3)} %` : ''}`);
    this.element.classList.toggle('refused', checks.some((check) => check.verdict === 'fail'));
  }

  private charts(charts: Charts): void {
    const plane = charts.charts.find((chart) => chart.form === 'plane');
    this.plane.element.hidden = plane === undefined;
    if (plane) this.plane.show(ofChart(plane, `${this.texts.plane}: ${charts.drive}`));
  }

  private unsized(fault: Fault): void {
    this.name.textContent = this.texts.notSized;
    this.say([fault.message, fault.help].filter(Boolean).join('. '));
    this.bars.replaceChildren();
    this.plane.element.hidden = true;
    this.brief(this.texts.notSized);
  }
}
