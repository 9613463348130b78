/** Accessibility: no violation that axe finds, in light and dark, in every view; the order of the focus; tables behind plots. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { begin, end, open, sized } from './support';

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

before(begin);
after(end);

async function violations(page: Page): Promise<string[]> {
  await page.addScriptTag({ path: axe });
  return page.evaluate(async () => {
    interface Found { violations: { id: string; help: string; nodes: { target: unknown[]; failureSummary?: string }[] }[] }
    const { violations } = await (window as unknown as { axe: { run(): Promise<Found> } }).axe.run();
    return violations.flatMap(({ id, help, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${help}: ${target.join(' ')} ${failureSummary ?? ''}`));
  });
}

for (const colorScheme of ['light', 'dark'] as const) {
  test(`no violation in ${colorScheme}`, async () => {
    const { page } = await open('', { colorScheme, bypassCSP: true });
    await sized(page);
    assert.deepEqual(await violations(page), []);
    for (const name of ['Text', 'Draw', 'Other drives', 'What may change', 'Motions', 'Flywheel', 'Take away']) {
      await page.getByRole('tab', { name }).click();
      await page.waitForTimeout(400);
      assert.deepEqual(await violations(page), [], name);
    }
    await page.getByRole('button', { name: 'Machines', exact: true }).click();
    await page.locator('.gallery .thumb svg').first().waitFor();
    assert.deepEqual(await violations(page), [], 'gallery');
  });
}

test('the focus goes from the skip link through header, picture, drive and input', async () => {
  const { page } = await open();
  await sized(page);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement!.textContent), 'Skip to the machine');
  await page.keyboard.press('Enter');
  assert.equal(await page.evaluate(() => document.activeElement!.tagName), 'H1');
  const order: string[] = [];
  for (let k = 0; k < 12; k++) {
    await page.keyboard.press('Tab');
    order.push(await page.evaluate(() => document.activeElement!.closest('section')?.className.replace('card ', '') ?? ''));
  }
  const places = order.map((name) => ['view', 'curves', 'drive', 'inputs'].indexOf(name));
  assert.ok(places.every((place, k) => k === 0 || place >= places[k - 1]!), order.join());
});

test('every plot has its numbers as a table', async () => {
  const { page } = await open();
  await sized(page);
  for (const plot of await page.locator('figure.plot:visible').all()) {
    await plot.getByText('As a table').click();
    await plot.locator('tbody tr').nth(10).waitFor();
  }
});

test('German and Russian have every word, and the page its language', async () => {
  for (const [locale, word] of [['de', 'Rückgängig'], ['ru', 'Отменить']] as const) {
    const { page } = await open('', { locale });
    await page.getByRole('button', { name: word }).waitFor();
    assert.equal(await page.evaluate(() => document.documentElement.lang), locale);
  }
});
