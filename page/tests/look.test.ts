/** The first look, the gallery, sliders, text, history and links. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { begin, end, field, open, sized, text, write } from './support';

before(begin);
after(end);

test('the first picture comes and turns', async () => {
  const start = performance.now();
  const { page, errors } = await open('', { reducedMotion: 'no-preference' });
  const crank = page.locator('.stage [data-link="0"]').first();
  await crank.waitFor();
  const took = performance.now() - start;
  console.log(`first picture after ${took.toFixed(0)} ms`);
  const transform = (): Promise<string | null> => crank.getAttribute('transform');
  const one = await transform();
  await page.waitForFunction((was) => document.querySelector('.stage [data-link="0"]')!.getAttribute('transform') !== was, one);
  const drive = await sized(page);
  console.log(`drive after ${(performance.now() - start).toFixed(0)} ms: ${drive}`);
  assert.match(drive, /Yaskawa SGM7A-30A with brake/);
  assert.match((await page.locator('.summary').textContent()) ?? '', /SGM7A-30A.*%/);
  assert.equal(await page.locator('.curves canvas').count(), 2);
  assert.equal(await page.locator('.drive canvas').count(), 1);
  assert.deepEqual(errors, []);
});

test('a slider changes text, curves and drive, and can be undone', async () => {
  const { page, errors } = await open();
  await sized(page);
  const before = await text(page);
  const mass = field(page, 'mechanism slider mass [kg]');
  await mass.fill('200');
  await mass.press('Enter');
  await page.waitForFunction(() => document.querySelector('.drive .state')!.textContent!.includes('drives satisf'), undefined);
  const after = await text(page);
  assert.ok(after.replace('"200 kg"', '"42 kg"') === before, 'only the mass has changed');
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.ok((await text(page)) === before);
  await page.getByRole('button', { name: 'Redo' }).click();
  assert.ok((await text(page)) === after);
  await page.keyboard.press('Control+z');
  await page.waitForFunction(() => (document.querySelector('input[type=number][aria-label="mechanism slider mass [kg]"]') as HTMLInputElement).value === '42');
  assert.deepEqual(errors, []);
});

test('a drag of a slider is one step of undo, whatever the core answers meanwhile', async () => {
  const { page } = await open();
  await sized(page);
  const slider = page.getByRole('slider', { name: 'mechanism slider mass [kg]' });
  const box = (await slider.boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  for (let k = 0; k < 20; k++) await page.mouse.move(box.x + box.width / 2 + k, box.y + box.height / 2);
  await page.mouse.up();
  await page.waitForTimeout(500);
  assert.doesNotMatch(await text(page), /mass = "42 kg"/);
  await page.getByRole('button', { name: 'Undo' }).click();
  assert.match(await text(page), /mass = "42 kg"/);
});

test('errors are underlined where they are and mended', async () => {
  const { page } = await open();
  await sized(page);
  const good = await text(page);
  await write(page, good.replace('length = "180 mm"', 'length = "180 kg"'));
  await page.locator('.cm-lintRange-error').waitFor();
  assert.match((await page.locator('.cm-lintRange-error').first().textContent()) ?? '', /180 kg/);
  const line = good.slice(0, good.indexOf('length = "180 mm"')).split('\n').length;
  assert.match((await page.locator('.faults').textContent()) ?? '', new RegExp(`line ${line}\\b`));
  assert.ok(await page.locator('.stale').isVisible());
  await write(page, good);
  await page.locator('.stale').waitFor({ state: 'hidden' });
  assert.equal(await page.locator('.cm-lintRange-error').count(), 0);
});

test('keys are completed', async () => {
  const { page } = await open();
  await sized(page);
  await page.getByRole('tab', { name: 'Text' }).click();
  await page.locator('.cm-content').click();
  await page.keyboard.press('Control+End');
  await page.keyboard.type('\n[surroundings]\namb');
  await page.locator('.cm-tooltip-autocomplete').getByText('ambient').first().waitFor();
});

test('the gallery opens any machine', async () => {
  const { page } = await open();
  await sized(page);
  await page.getByRole('button', { name: 'Machines', exact: true }).click();
  await page.locator('.gallery .thumb svg').nth(3).waitFor();
  await page.getByRole('searchbox', { name: 'Filter' }).last().fill('scotch');
  await page.getByRole('button', { name: /scotch-yoke/ }).click();
  await page.waitForURL(/#machine=scotch-yoke\.toml/);
  assert.match((await page.getByRole('heading', { level: 1 }).textContent()) ?? '', /saw/);
});

test('a link holds the whole machine', async () => {
  const { page } = await open();
  await sized(page);
  const mass = field(page, 'mechanism slider mass [kg]');
  await mass.fill('43.5');
  await mass.press('Enter');
  await page.waitForURL(/#1\./);
  const other = await open(new URL(page.url()).hash);
  await sized(other.page);
  assert.equal(await text(other.page), await text(page));
  assert.match(await text(page), /43\.5 kg/);
});

for (const [fragment, words] of [['#1.broken', 'damaged'], ['#7.abcd', 'another version'], ['#machine=none.toml', 'no such machine'], ['#%E0%A4%A', 'damaged']] as const) {
  test(`the link ${fragment} is explained`, async () => {
    const { page, errors } = await open(fragment);
    await page.locator('.message').getByText(words).waitFor();
    await sized(page);
    assert.deepEqual(errors, []);
  });
}

test('every question is answered', async () => {
  const { page, errors } = await open();
  await sized(page);
  for (const [tab, button, words] of [
    ['What may change', 'Find out what may change', /process load/i], ['Motions', 'Find the fastest motion', /Cycle time/], ['Motions', 'Find the gentlest motion', /RMS/],
    ['Flywheel', 'Find the flywheel', /\w/],
  ] as const) {
    await page.getByRole('tab', { name: tab }).click();
    const asked = page.locator('.asked').filter({ has: page.getByRole('button', { name: button }) });
    await asked.getByRole('button', { name: button }).click();
    await asked.locator('.result > *').first().waitFor();
    assert.match(await asked.locator('.result').innerText(), words);
  }
  assert.deepEqual(errors, []);
});
