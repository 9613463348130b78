/** What goes wrong in a browser: no network, no storage, no script, a dead worker, huge texts, large letters; and how smooth it is. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { begin, end, field, open, serve, sized, text, unplug, url, write } from './support';

before(begin);
after(end);

test('the crank is dragged, and its frames are counted', async () => {
  const { page } = await open();
  await sized(page);
  await page.evaluate(() => {
    const times: number[] = [];
    const tick = (now: number): void => {
      times.push(now);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
    Object.assign(window, { times });
  });
  const position = page.getByRole('slider', { name: 'Position of the drive link' });
  const before = await position.inputValue();
  const crank = (await page.locator('.stage [data-link="0"]').first().boundingBox())!;
  const pivot = await page.locator('.stage [data-link="0"]').first().evaluate((group) => {
    const at = new DOMPoint(0, 0).matrixTransform((group as SVGGElement).getScreenCTM()!);
    return [at.x, at.y] as const;
  });
  const [x, y] = [crank.x + crank.width / 2, crank.y + crank.height / 2];
  const radius = Math.hypot(x - pivot[0], y - pivot[1]);
  const from = Math.atan2(y - pivot[1], x - pivot[0]);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.evaluate(() => ((window as unknown as { times: number[] }).times.length = 0));
  for (let k = 0; k <= 120; k++) await page.mouse.move(pivot[0] + radius * Math.cos(from + k / 40), pivot[1] + radius * Math.sin(from + k / 40));
  const times = await page.evaluate(() => (window as unknown as { times: number[] }).times.slice());
  await page.mouse.up();
  const steps = times.slice(1).map((time, k) => time - times[k]!).sort((a, b) => a - b);
  const median = steps[Math.floor(steps.length / 2)]!;
  const late = steps.filter((step) => step > 25).length;
  console.log(`dragging: ${steps.length} frames, median ${median.toFixed(1)} ms, ${late} longer than 25 ms, longest ${steps.at(-1)!.toFixed(1)} ms`);
  assert.notEqual(await position.inputValue(), before);
});

test('the crank follows the arrow keys', async () => {
  const { page } = await open();
  await sized(page);
  const position = page.getByRole('slider', { name: 'Position of the drive link' });
  await position.focus();
  const before = Number(await position.inputValue());
  await page.keyboard.press('ArrowRight');
  assert.equal(Number(await position.inputValue()), Math.round(before) + 1);
  assert.match((await position.getAttribute('aria-valuetext'))!, /°/);
});

test('a worker that was killed is replaced', async () => {
  const { page } = await open();
  await sized(page);
  for (const worker of page.workers()) await worker.evaluate(() => self.close()).catch(() => undefined);
  const mass = field(page, 'mechanism slider mass [kg]');
  await mass.fill('60');
  await mass.press('Enter');
  await page.waitForURL(/#1\./);
  assert.match(await text(page), /60(\.0)? kg/);
});

test('without storage the page works and says that settings are not kept', async () => {
  const { page, errors } = await open('', {}, (page) => page.addInitScript(() => {
    Object.defineProperty(window, 'localStorage', { get: () => { throw new DOMException('refused', 'SecurityError'); } });
  }));
  await sized(page);
  await page.getByLabel('Light or dark').selectOption('dark');
  await page.locator('.message').getByText('refuses to keep').waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.dataset['theme']), 'dark');
  assert.deepEqual(errors, []);
});

test('without WebAssembly, and without scripts, a text says so', async () => {
  const { page } = await open('', {}, (page) => page.addInitScript(() => Object.assign(window, { WebAssembly: undefined })));
  await page.getByText('needs WebAssembly').waitFor();
  const plain = await open('', { javaScriptEnabled: false });
  assert.ok(await plain.page.locator('noscript .plain').isVisible());
});

test('a text of one megabyte is answered, and the page goes on', async () => {
  const { page, errors } = await open();
  await sized(page);
  const good = await text(page);
  await write(page, good + `# ${'x'.repeat(78)}\n`.repeat(13_200));
  await page.locator('.faults .fault').waitFor();
  await write(page, good);
  await page.locator('.stale').waitFor({ state: 'hidden' });
  assert.deepEqual(errors, []);
});

for (const [name, options] of [['a phone', { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }], ['zoom 200 %', { viewport: { width: 640, height: 400 }, deviceScaleFactor: 2 }]] as const) {
  test(`nothing is wider than ${name}`, async () => {
    const { page } = await open('', options);
    await sized(page);
    for (const tab of ['Text', 'Draw', 'Other drives', 'Motions', 'Take away']) {
      await page.getByRole('tab', { name: tab }).click();
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.ok(wide <= 0, `${tab}: ${wide} px too wide`);
    }
  });
}

test('a machine that cannot be sized says why', async () => {
  const { page } = await open();
  await sized(page);
  const good = await text(page);
  await write(page, good.slice(0, good.indexOf('# One turn from top')));
  await page.locator('.drive-name').getByText('Not sized').waitFor();
  assert.match((await page.locator('.drive .state').textContent()) ?? '', /motion/);
  assert.equal(await page.locator('.stale').isVisible(), false);
});

test('the page works without a network', async () => {
  const { page } = await open();
  await sized(page);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await unplug();
  await page.goto(url());
  await sized(page);
  await page.getByRole('tab', { name: 'Text' }).click();
  await page.locator('.cm-content').waitFor();
  await page.context().close();
  await serve();
});
