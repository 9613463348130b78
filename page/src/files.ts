/** Files that are opened or dropped: a machine file with the files it names, or a linkage of another program. */
import type { Source } from './protocol';

const LARGEST = 2 << 20;

export type Opened =
  | { problem: string }
  | { source?: Source; foreign?: { name: string; text: string }; named: Record<string, string>; problem?: never };

export async function filesOf(files: File[]): Promise<Opened> {
  const large = files.find(({ size }) => size > LARGEST);
  if (large) return { problem: 'large' };
  const named: Record<string, string> = {};
  let source: Source | undefined;
  let foreign: { name: string; text: string } | undefined;
  for (const file of files) {
    let text: string;
    try {
      text = new TextDecoder('utf-8', { fatal: true }).decode(await file.arrayBuffer());
    } catch {
      return { problem: `${file.name}: not UTF-8` };
    }
    if (file.name.endsWith('.toml')) source = { name: file.name, text };
    else if (file.name.endsWith('.csv')) named[file.name] = text;
    else foreign = { name: file.name, text };
  }
  if (source && Object.keys(named).length > 0) source.files = named;
  return { named, ...(source ? { source } : {}), ...(foreign ? { foreign } : {}) };
}
