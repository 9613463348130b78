/**
 * The machine on the bench: its source, its history, and what the core says about it. Views listen to the parts that they show.
 *
 * After a change the curves, the drawing and the drive that ranks first follow at once; all others are ranked when the text has rested.
 */
import type { Core } from './core';
import { settled } from './dom';
import { History } from './history';
import type { Answer, Answers, Charts, Columns, Drawing, Fault, Quantity, Request, SizeAnswer, SizedDrive, Source } from './protocol';

/** Who changed the text; its own view does not follow. */
export type By = 'slider' | 'text' | 'draw' | 'open' | 'history';

/** Time (ms) without a change after which the catalogue is sized. */
const REST = 250;

/** A request about the machine on the bench. */
export type Asking<D extends Request['do']> = Omit<Extract<Request, { do: D }>, keyof Source> & { do: D };

export interface Events {
  source: { source: Source; by: By };
  /** The text cannot be read or its machine not placed; undefined if it can. */
  fault: Fault | undefined;
  curves: Columns;
  drawing: Drawing;
  quantities: Quantity[];
  charts: Charts;
  /** The drive that ranks first, or that the user has chosen, judged alone for this text. */
  judged: SizeAnswer;
  /** The whole catalogue. */
  sized: SizeAnswer;
  /** The machine cannot be sized, for example because it has no motion. */
  unsized: Fault;
  /** The catalogue is being sized. */
  sizing: boolean;
}

type Listener<E extends keyof Events> = (event: Events[E]) => void;

export class Workbench {
  readonly history: History<Source>;
  /** "MOTOR+GEARBOX on AMPLIFIER" */
  drive: string | undefined;
  /** The user has chosen the drive; otherwise it is the first that fits. */
  pinned = false;
  /** The last fault, as the event. */
  fault: Fault | undefined;
  /** Orders of parts by their keys, from all answers so far. */
  private readonly orders = new Map<string, string>();
  private listeners: { [E in keyof Events]?: Listener<E>[] } = {};
  private rest = settled(REST, () => void this.settle());
  private version = 0;
  /** The version that the sheet has refused to follow. */
  private refused = -1;

  constructor(private readonly live: Core, private readonly slow: Core, source: Source) {
    this.history = new History(source);
  }

  get source(): Source {
    return this.history.now;
  }

  on<E extends keyof Events>(event: E, listener: Listener<E>): void {
    (this.listeners[event] ??= [] as never[] as NonNullable<(typeof this.listeners)[E]>).push(listener);
  }

  private tell<E extends keyof Events>(event: E, value: Events[E]): void {
    for (const listener of this.listeners[event] ?? []) listener(value);
  }

  /** Another text of the same machine; changes of one `tag` are undone together. */
  change(text: string, by: By, tag = ''): void {
    if (text === this.source.text) return;
    this.history.push({ ...this.source, text }, tag);
    this.changed(by);
  }

  /** The text of a drawing; the steps of one drawing are undone together. */
  replace(name: string, text: string): void {
    if (text === this.source.text) {
      this.follows();
      return;
    }
    this.history.push({ ...this.source, name, text }, 'drawing');
    this.changed('draw');
  }

  /** The sheet holds no machine that moves. */
  refuse(message: string): void {
    this.refused = this.version;
    this.judge({ message, help: '', places: [], sheet: true });
  }

  /** The sheet holds this machine. */
  follows(): void {
    this.refused = -1;
    if (this.fault?.sheet) this.judge(undefined);
  }

  open(source: Source): void {
    this.history.push(source);
    this.pinned = false;
    this.drive = undefined;
    this.changed('open');
  }

  undo(): boolean {
    return this.went(this.history.undo());
  }

  redo(): boolean {
    return this.went(this.history.redo());
  }

  private went(source: Source | undefined): boolean {
    if (source) this.changed('history');
    return source !== undefined;
  }

  /** Chooses a drive, or with undefined leaves the choice to the ranking. */
  choose(drive: string | undefined): void {
    this.pinned = drive !== undefined;
    this.drive = drive;
    void this.follow();
    this.rest();
  }

  changed(by: By): void {
    this.version++;
    this.tell('source', { source: this.source, by });
    void this.follow();
    if (by !== 'slider') void this.list();
    this.rest();
  }

  /** What a command of the core says to this source; undefined if it failed or a newer request took its place. */
  ask<D extends Request['do']>(request: Asking<D>): Promise<Answer<D> | undefined> {
    return this.slow.ask<D>({ ...this.source, ...request } as unknown as Extract<Request, { do: D }>);
  }

  /** Motor, gearbox and amplifier as they are ordered, or by their keys where no answer has said it. */
  parts({ motor, gearbox, amplifier }: SizedDrive): string[] {
    return [motor, gearbox, amplifier].filter((key) => key !== null).map((key) => this.orders.get(key) ?? key);
  }

  cancel(lane: string): void {
    this.slow.cancel(lane);
  }

  /** The text with other values in place. */
  async set(values: Record<string, string>): Promise<Fault | undefined> {
    const told = await this.live.ask<'set'>({ do: 'set', values, ...this.source });
    if (told && 'error' in told) return told.error;
    if (told) this.change(told.answer.text, 'slider', Object.keys(values).join());
    return undefined;
  }

  async complete(text: string, at: number): Promise<Answers['complete'] | undefined> {
    const told = await this.live.ask<'complete'>({ do: 'complete', at, ...this.source, text });
    return told && 'answer' in told ? told.answer : undefined;
  }

  private async list(): Promise<void> {
    const version = this.version;
    const told = await this.live.ask<'quantities'>({ do: 'quantities', ...this.source });
    if (told && 'answer' in told && version === this.version) this.tell('quantities', told.answer);
  }

  private async follow(): Promise<void> {
    const source = this.source;
    const version = this.version;
    const drawing = this.live.ask<'drawing'>({ do: 'drawing', ...source });
    const told = this.live.ask<'curves'>({ do: 'curves', positions: 360, ...source });
    const choice = this.pinned && this.drive !== undefined ? { drive: this.drive } : { best: true };
    const judged = this.live.ask<'size'>({ do: 'size', ...choice, ...source });
    const [drawn, curved] = [await drawing, await told];
    if (drawn && 'answer' in drawn) this.tell('drawing', drawn.answer);
    const curves = curved && 'answer' in curved ? await this.withPath(curved.answer, source, version) : undefined;
    if (curves) this.tell('curves', curves);
    const failed = [drawn, curved].find((told) => told && 'error' in told);
    if (drawn && curved && version === this.version && version !== this.refused) this.judge(failed && 'error' in failed ? failed.error : undefined);
    const sized = await judged;
    if (!sized || 'error' in sized) return;
    this.tell('judged', sized.answer);
    if (!this.pinned) this.drive = firstOf(sized.answer) ?? this.drive;
    await this.plot();
  }

  /** Undefined if the path is that of an older text. */
  private async withPath(curves: Columns, source: Source, version: number): Promise<Columns | undefined> {
    const drive = curves.columns.findIndex((name) => /^[TF]_drive \[/.test(name));
    if (drive < 0 || curves.rows.some((row) => row[drive] !== null)) return curves;
    const timed = await this.live.ask<'curves'>({ do: 'curves', positions: 360, over: 'time', ...source }, 'path');
    if (!timed || version !== this.version) return undefined;
    return 'answer' in timed ? { ...curves, path: timed.answer } : curves;
  }

  private async plot(): Promise<void> {
    const drive = this.drive;
    if (drive === undefined) return;
    const charts = await this.live.ask<'charts'>({ do: 'charts', drive, ...this.source });
    if (charts && 'answer' in charts) this.tell('charts', charts.answer);
  }

  private judge(fault: Fault | undefined): void {
    this.fault = fault;
    this.tell('fault', fault);
  }

  private async settle(): Promise<void> {
    const version = this.version;
    this.tell('sizing', true);
    const told = await this.slow.ask<'size'>({ do: 'size', ...this.source });
    if (version !== this.version) return;
    this.tell('sizing', false);
    if (!told) return;
    if ('error' in told) {
      this.drive = undefined;
      this.tell('unsized', told.error);
      return;
    }
    for (const { key, maker, order } of told.answer['bill of materials'] ?? []) this.orders.set(key, `${maker} ${order}`);
    this.tell('sized', told.answer);
    const drive = this.pinned ? this.drive : firstOf(told.answer);
    if (drive !== undefined && drive !== this.drive) {
      this.drive = drive;
      await this.plot();
    }
    void this.list();
  }
}

function firstOf({ fit, refused }: SizeAnswer): string | undefined {
  const first = fit[0] ?? refused[0];
  return first && driveName(first);
}

/** The name by which a drive is asked for. */
export function driveName(drive: { motor: string; gearbox: string | null; amplifier: string | null }): string {
  const geared = drive.gearbox === null ? drive.motor : `${drive.motor}+${drive.gearbox}`;
  return drive.amplifier === null ? geared : `${geared} on ${drive.amplifier}`;
}
