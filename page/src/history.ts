/** Undo and redo of whole states. */
export class History<S> {
  private past: S[] = [];
  private future: S[] = [];
  private tag = '';

  constructor(private current: S, private readonly most = 200) {}

  get now(): S {
    return this.current;
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** A new state. Successive states of one tag, such as those of one drag, are undone together; an empty tag stands alone. */
  push(state: S, tag = ''): void {
    if (tag === '' || tag !== this.tag) {
      this.past.push(this.current);
      if (this.past.length > this.most) this.past.shift();
    }
    this.tag = tag;
    this.current = state;
    this.future = [];
  }

  /** Ends a series of states of one tag. */
  seal(): void {
    this.tag = '';
  }

  undo(): S | undefined {
    return this.move(this.past, this.future);
  }

  redo(): S | undefined {
    return this.move(this.future, this.past);
  }

  private move(from: S[], to: S[]): S | undefined {
    const state = from.pop();
    if (state === undefined) return undefined;
    to.push(this.current);
    this.current = state;
    this.tag = '';
    return state;
  }
}
