/**
 * The core behind a worker: one request at a time, and of several that wait in one lane only the newest. A worker that has died or does not answer
 * is replaced, and its request asked once more.
 */
import type { Answer, Request } from './protocol';

interface Job {
  lane: string;
  request: Request;
  again: boolean;
  settle(answer: Answer<Request['do']> | undefined): void;
}

/** Longest time (ms) for an answer. */
const PATIENCE = 60_000;
/** That of the requests while something is moved. */
const QUICK_PATIENCE = 6_000;
const QUICK = new Set<Request['do']>(['curves', 'drawing', 'set', 'quantities', 'complete', 'draw', 'charts']);

export class Core {
  private worker: Worker | undefined;
  private waiting: Job[] = [];
  private running: Job | undefined;
  private number = 0;
  private timer = 0;
  /** The worker has answered once; the first time it also loads and compiles. */
  private warm = false;

  constructor(private readonly start: (name: string) => Worker) {}

  /** The answer, or undefined if a newer request of the lane took its place. */
  ask<D extends Request['do']>(request: Extract<Request, { do: D }>, lane: string = request.do): Promise<Answer<D> | undefined> {
    return new Promise((resolve) => {
      const job: Job = { lane, request, again: true, settle: resolve as Job['settle'] };
      const at = this.waiting.findIndex((other) => other.lane === lane);
      if (at < 0) this.waiting.push(job);
      else this.waiting.splice(at, 1, job)[0]?.settle(undefined);
      this.next();
    });
  }

  /** Drops the requests of a lane; one that runs is stopped with its worker. */
  cancel(lane: string): void {
    for (const job of this.waiting.filter((waiting) => waiting.lane === lane)) job.settle(undefined);
    this.waiting = this.waiting.filter((waiting) => waiting.lane !== lane);
    if (this.running?.lane === lane) {
      const job = this.running;
      this.stop();
      job.settle(undefined);
      this.next();
    }
  }

  /** Stops the worker; the next request starts a new one. */
  private stop(): void {
    this.worker?.terminate();
    this.worker = undefined;
    this.running = undefined;
    this.warm = false;
    clearTimeout(this.timer);
  }

  private next(): void {
    if (this.running) return;
    const job = this.waiting.shift();
    if (!job) return;
    this.running = job;
    this.worker ??= this.begin();
    const id = ++this.number;
    this.worker.postMessage({ id, request: job.request });
    const patience = this.warm && QUICK.has(job.request.do) ? QUICK_PATIENCE : PATIENCE;
    this.timer = self.setTimeout(() => this.fail(`no answer in ${patience / 1000} s`), patience);
  }

  private begin(): Worker {
    const name = `worker ${Math.random()}`;
    const worker = this.start(name);
    worker.addEventListener('message', (event: MessageEvent<{ id: number; answer: Answer<Request['do']> }>) => {
      if (worker !== this.worker || event.data.id !== this.number) return;
      const job = this.running;
      this.running = undefined;
      if (!this.warm) {
        // The worker holds this lock as long as it lives.
        void navigator.locks?.request(name, () => {
          if (worker === this.worker) this.fail('the worker has ended');
        });
      }
      this.warm = true;
      clearTimeout(this.timer);
      job?.settle(event.data.answer);
      this.next();
    });
    worker.addEventListener('error', (event) => {
      event.preventDefault();
      if (worker === this.worker) this.fail(event.message || 'the worker could not be loaded');
    });
    return worker;
  }

  private fail(message: string): void {
    const job = this.running;
    this.stop();
    if (job?.again) this.waiting.unshift({ ...job, again: false });
    else job?.settle({ error: { message, help: '', places: [], panic: true } });
    this.next();
  }
}
