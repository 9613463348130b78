/**
 * The machine in the link: `#1.` and the compressed source, or `#machine=` and a name of the gallery. A server never sees what follows the `#`.
 */
import type { Source } from './protocol';

const VERSION = '1';
/** Longest link (characters) that mail programs and chats leave whole, generously. */
export const LONGEST = 32_000;
/** Largest text (bytes) that a link is unpacked to; a machine file has at most 1 MiB, and may name others. */
const LARGEST = 4 << 20;

export type Linked =
  | { kind: 'none' }
  | { kind: 'gallery'; name: string }
  | { kind: 'source'; source: Source }
  | { kind: 'other-version' }
  | { kind: 'broken' };

export async function toLink(source: Source): Promise<string> {
  const bytes = new TextEncoder().encode(JSON.stringify([source.name, source.text, source.files ?? {}]));
  const packed = await through(bytes, new CompressionStream('deflate-raw'), Infinity);
  let binary = '';
  for (const byte of packed) binary += String.fromCharCode(byte);
  return `${VERSION}.${btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')}`;
}

export async function fromLink(fragment: string): Promise<Linked> {
  const content = fragment.replace(/^#/, '');
  if (content === '') return { kind: 'none' };
  const gallery = /^machine=([\w.-]+)$/.exec(content)?.[1];
  if (gallery !== undefined) return { kind: 'gallery', name: gallery };
  const [, version, body] = /^(\d+)\.([\w-]+)$/.exec(content) ?? [];
  if (version === undefined || body === undefined) return { kind: 'broken' };
  if (version !== VERSION) return { kind: 'other-version' };
  try {
    const binary = atob(body.replaceAll('-', '+').replaceAll('_', '/'));
    const packed = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
    const bytes = await through(packed, new DecompressionStream('deflate-raw'), LARGEST);
    const [name, text, files] = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes)) as [unknown, unknown, unknown];
    const named = Object.entries(files ?? {});
    if (typeof name !== 'string' || typeof text !== 'string' || named.some(([, file]) => typeof file !== 'string')) return { kind: 'broken' };
    return { kind: 'source', source: { name, text, files: Object.fromEntries(named) as Record<string, string> } };
  } catch {
    return { kind: 'broken' };
  }
}

async function through(bytes: Uint8Array, stream: GenericTransformStream, most: number): Promise<Uint8Array> {
  const reader = (new Blob([bytes as BlobPart]).stream().pipeThrough(stream) as ReadableStream<Uint8Array>).getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    parts.push(next.value);
    size += next.value.length;
    if (size > most) throw new RangeError('too large');
  }
  return new Uint8Array(await new Blob(parts as BlobPart[]).arrayBuffer());
}
