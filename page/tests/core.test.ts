/** The core in Node.js and in chromium: the command's numbers to the last bit, faults, panics, size. */
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readdir, readFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import { gzipSync } from 'node:zlib';
import { fromPmks } from '../src/draw/pmks';
import { machineText } from '../src/draw/write';
import type { Answers, GalleryMachine, Request } from '../src/protocol';
import { Panic, Wasm } from '../src/wasm';
import { begin, end, open } from './support';

const DIST = process.env['JRED_PAGE'] ?? 'dist';
const COMMAND = resolve(process.env['JRED_COMMAND'] ?? '../target/debug/jred');
/** Most of everything, gzipped (kB). The aim is 800: reading any machine file, sizing, motions, tables and reports still take 1,450 of it. */
const CEILING = 1700;

const module = new WebAssembly.Module(await readFile(`${DIST}/core.wasm`));
const machines = JSON.parse(await readFile(`${DIST}/machines.json`, 'utf8')) as GalleryMachine[];
const core = new Wasm(module);

function ask<D extends Request['do']>(request: Extract<Request, { do: D }>): Answers[D] {
  const told = JSON.parse(core.ask(request)) as { answer: Answers[D]; error?: { message: string } };
  assert.equal(told.error, undefined);
  return told.answer;
}

before(begin);
after(end);

const COMMANDS = { curves: ['reduce'], size: ['size'], fastest: ['fastest'], gentlest: ['gentlest'] } as const;

for (const [what, words] of Object.entries(COMMANDS)) {
  test(`${what} gives the command's JSON to the last bit`, () => {
    const different: string[] = [];
    let given = 0;
    for (const machine of machines) {
      const path = `machines/${machine.name}`;
      const done = spawnSync(COMMAND, [...words, path, '--format', 'json'], { cwd: '..', encoding: 'utf8', maxBuffer: 1 << 28 });
      const told = JSON.parse(core.ask({ do: what, ...machine, name: path } as Request)) as { answer?: unknown; error?: { message: string } };
      // The command breaks lines and draws a frame.
      const bare = (text: string): string => text.replace(/[\s│]/g, '');
      if (done.status === 2) {
        if (!told.error || !bare(done.stderr).includes(bare(told.error.message))) different.push(`${machine.name}: ${told.error?.message}, ${done.stderr}`);
      } else {
        given++;
        if (!isDeepStrictEqual(told.answer, JSON.parse(done.stdout))) different.push(`${machine.name}: ${told.error?.message ?? 'other numbers'}`);
      }
    }
    console.log(`${what}: ${given} of ${machines.length} machines`);
    assert.deepEqual(different, []);
    assert.ok(given > machines.length / 4);
  });
}

test('the drive that is found while a slider moves is the first of the ranking', () => {
  let found = 0;
  for (const machine of machines) {
    const told = (best: boolean): Answers['size'] | undefined => (JSON.parse(core.ask({ do: 'size', best, ...machine })) as { answer?: Answers['size'] }).answer;
    const [best, all] = [told(true), told(false)];
    if (!all || all.fit.length === 0) continue;
    found++;
    assert.deepEqual(best!.fit[0], all.fit[0], machine.name);
  }
  assert.ok(found > machines.length / 4);
});

test('what follows a slider is fast', () => {
  const press = machines.find(({ name }) => name === 'press.toml')!;
  const median = (request: Request): number => {
    const times = Array.from({ length: 9 }, () => {
      const start = performance.now();
      core.ask(request);
      return performance.now() - start;
    });
    return times.sort((a, b) => a - b)[4]!;
  };
  const curves = median({ do: 'curves', positions: 360, ...press });
  const best = median({ do: 'size', best: true, ...press });
  const all = median({ do: 'size', ...press });
  console.log(`press: curves ${curves.toFixed(1)} ms, first drive ${best.toFixed(1)} ms, whole catalogue ${all.toFixed(1)} ms`);
  assert.ok(best < all);
});

test('chromium answers with the same bytes as Node.js', async () => {
  const { page } = await open();
  const requests = machines.flatMap((machine) => (['curves', 'size'] as const).map((what) => ({ do: what, ...machine })));
  const told = await page.evaluate(async (all) => {
    const worker = new Worker('worker.js', { type: 'module' });
    const answers: string[] = [];
    for (const [id, request] of all.entries()) {
      worker.postMessage({ id, request });
      answers.push(await new Promise((done) => worker.addEventListener('message', ({ data }) => done(JSON.stringify(data.answer)), { once: true })));
    }
    return answers;
  }, requests);
  for (const [k, request] of requests.entries()) assert.equal(told[k], JSON.stringify(JSON.parse(core.ask(request))), request.name);
});

test('a fault has its place in the text, in UTF-16 units', async () => {
  const press = machines.find(({ name }) => name === 'press.toml')!;
  const text = `# π and 𝛗\n${press.text}`.replace('mass = "42 kg"', 'mass = "42 N"');
  const told = JSON.parse(core.ask({ do: 'size', ...press, text })) as { error: { message: string; help: string; places: { from: number; to: number; line: number }[] } };
  const [place] = told.error.places;
  assert.match(told.error.message, /mass/);
  assert.notEqual(told.error.help, '');
  assert.equal(text.slice(place!.from, place!.to).replaceAll('"', ''), '42 N');
  assert.equal(place!.line, text.slice(0, place!.from).split('\n').length);
});

test('a panic is told, and a new core goes on', () => {
  const broken = new Wasm(module);
  const [press] = machines;
  broken.ask({ do: 'quantities', ...press! });
  const inner = broken as unknown as { core: { reserve(length: number): number } };
  const reserve = inner.core.reserve;
  inner.core = { ...inner.core, reserve: () => reserve(0xffff_ffff) };
  assert.throws(() => broken.ask({ do: 'quantities', ...press! }), (error) => error instanceof Panic && /panicked|memory|unreachable/i.test(error.message));
  assert.ok(new Wasm(module).ask({ do: 'quantities', ...press! }).includes('answer'));
});

test('every number of the gallery has a range around it, and can be set to what it is', () => {
  for (const machine of machines) {
    for (const { key, number, unit, min, max, from, to } of ask({ do: 'quantities', ...machine })) {
      assert.ok(min <= number && number <= max && min < max, `${machine.name}: ${key} ${min} ${number} ${max}`);
      const { text } = ask({ do: 'set', ...machine, values: { [key]: `${number} ${unit}`.trim() } });
      assert.equal(text.slice(0, from), machine.text.slice(0, from), key);
      assert.ok(text.endsWith(machine.text.slice(to)), key);
    }
  }
});

test('keys and words are completed', () => {
  const labels = (text: string): string[] => ask({ do: 'complete', name: '', text: text.replace('|', ''), at: text.indexOf('|') }).candidates.map(({ label }) => label);
  assert.deepEqual(labels('# π\n[mechanism]\ntype = "slider-|"\n'), ['slider-crank', 'inverted-slider-crank']);
  assert.deepEqual(labels('[mechanism]\ntype = "slider-crank"\noff|\n'), ['offset']);
});

/** Punch press and Whitworth's quick return as PMKS+ shares them. */
const PUNCH = 'https://app.pmksplus.com/?2P.Ay,1E8.K,0.1011.MA,A,0,0,0.GB,B,0,Im,0.GC,C,0,0r8,0.LP,P,0,0r8,OZ..YRAB,Crank,VG,o,0,9O,c5cae9,A,B,,.YRBC,Connecting rod,ku,6G,0,0HC,303e9f,B,C,,.YPCP,CP,1Tm,0,0,0,,C,P,,..2F1,BC,F1,0,0r8,0,0bW,1Xg0..N_J';
const QUICK = '2P.Ay,1E8.K,0.1011.MA,A,0,0,0.GB,B,0,ku,0.KC,C,Fe,0,0.GD,D,095,1A7,0.HP,P,0,ku,0,CD,C,D..YRAB,AB,Fe,Fe,0,NS,c5cae9,A,B,,.YRCD,CD,Fe,Fe,3H,b4,303e9f,C,D,,.YPBP,BP,Fe,0,0,0,,B,P,,...N_w';

test('a link of PMKS+ is imported', () => {
  const imported = fromPmks(PUNCH);
  assert.ok('linkage' in imported);
  const { linkage } = imported;
  // 1.2 cm and −3.4 cm: "Im" is 18·64 + 48 thousandths, "0r8" −(53·64 + 8).
  assert.deepEqual(linkage.points.map(({ name, x, y, ground }) => [name, x, y, ground]), [['A', 0, 0, true], ['B', 0, 12, false], ['C', 0, -34, false]]);
  assert.deepEqual(linkage.bodies.map(({ name, mass, inertia }) => [name, mass, inertia]), [['AB', 2, 0.05], ['BC', 3, 0.4]]);
  assert.deepEqual([linkage.drive, linkage.speed], ['A', 20]);
  assert.deepEqual(linkage.guides.map(({ point, angle, mass }) => [point, Math.round(angle), mass]), [['C', 90, 6]]);
  assert.deepEqual(linkage.loads.map(({ on, at, force }) => [on, at, force]), [['BC', 'C', [0, 400]]]);

  const quick = fromPmks(QUICK);
  assert.ok('linkage' in quick);
  assert.equal(quick.linkage.guides[0]!.on, 'CD');
  const drawn = ask({ do: 'draw', name: 'drawing.toml', text: machineText(quick.linkage, '', null) });
  assert.deepEqual([drawn.obstacle, drawn.range], ['', null]);

  for (const text of ['', 'https://example.com/?a.b', PUNCH.slice(0, 60), '\u0000.,.,.,']) assert.ok('problem' in fromPmks(text), text);
});

test('everything together is small enough', async () => {
  const sizes = new Map<string, number>();
  for (const name of await readdir(DIST)) sizes.set(name, gzipSync(await readFile(`${DIST}/${name}`), { level: 9 }).length / 1000);
  const all = [...sizes.values()].reduce((sum, size) => sum + size, 0);
  for (const [name, size] of sizes) console.log(`${size.toFixed(1).padStart(8)} kB ${name}`);
  console.log(`${all.toFixed(1).padStart(8)} kB of ${CEILING}, gzipped`);
  assert.ok(all <= CEILING, `${all} kB`);
});
