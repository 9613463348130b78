/** The worker: answers one request after the other by the core, and replaces a core that panicked. */
import type { Answer, Request } from './protocol';
import { Panic, Wasm } from './wasm';

async function compiled(): Promise<WebAssembly.Module> {
  const response = await fetch(new URL('core.wasm', self.location.href));
  if (!response.ok) throw new Error(`core.wasm: ${response.status} ${response.statusText}`);
  // Not compiled as it streams: some static hosts serve the file without its media type.
  return WebAssembly.compile(await response.arrayBuffer());
}

/** A lock with the name of this worker is held as long as it lives: the page notices its end. */
const held = new Promise<void>((granted) => {
  if (!navigator.locks) return granted();
  void navigator.locks.request(self.name, () => {
    granted();
    return new Promise(() => undefined);
  });
});
const module = compiled();
let core: Wasm | undefined;

async function answer(request: Request): Promise<Answer<Request['do']>> {
  try {
    await held;
    core ??= new Wasm(await module);
    return JSON.parse(core.ask(request)) as Answer<Request['do']>;
  } catch (error) {
    core = undefined;
    const message = error instanceof Error ? error.message : String(error);
    return { error: { message, help: '', places: [], ...(error instanceof Panic && { panic: true as const }) } };
  }
}

self.addEventListener('message', (event: MessageEvent<{ id: number; request: Request }>) => {
  const { id, request } = event.data;
  void answer(request).then((found) => self.postMessage({ id, answer: found }));
});
