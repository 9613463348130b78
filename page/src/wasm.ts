/** The core in WebAssembly: a request in, the text of its answer out. */
import type { Request } from './protocol';

interface Exports {
  memory: WebAssembly.Memory;
  reserve(length: number): number;
  call(request: number, length: number): number;
  release(answer: number, length: number): void;
}

/** The core panicked: its memory may be in disorder, so it has to be replaced. */
export class Panic extends Error {}

export class Wasm {
  private readonly core: Exports;
  private message = '';

  constructor(module: WebAssembly.Module) {
    const panicked = (at: number, length: number): void => {
      this.message = this.text(at, length);
    };
    this.core = new WebAssembly.Instance(module, { env: { panicked } }).exports as unknown as Exports;
  }

  /** The text of the answer. */
  ask(request: Request): string {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    try {
      const at = this.core.reserve(bytes.length);
      new Uint8Array(this.core.memory.buffer, at, bytes.length).set(bytes);
      const answer = this.core.call(at, bytes.length);
      const length = new DataView(this.core.memory.buffer).getUint32(answer, true);
      const text = this.text(answer + 4, length);
      this.core.release(answer, length);
      return text;
    } catch (error) {
      throw new Panic(this.message || String(error));
    }
  }

  private text(at: number, length: number): string {
    return new TextDecoder().decode(new Uint8Array(this.core.memory.buffer, at, length));
  }
}
