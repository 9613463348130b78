/** A linkage is drawn: by pointer, by keyboard and by figures; what does not move is explained. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { begin, end, holds, open, sized, text, write } from './support';

before(begin);
after(end);

async function sheet(page: Page): Promise<void> {
  await page.getByRole('tab', { name: 'Draw' }).click();
  await page.locator('.draw[aria-busy="false"]').waitFor();
}

async function drag(page: Page, from: [number, number], to: [number, number]): Promise<void> {
  const box = (await page.locator('.sheet-canvas').boundingBox())!;
  await page.mouse.move(box.x + from[0] * box.width, box.y + from[1] * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + to[0] * box.width, box.y + to[1] * box.height, { steps: 5 });
  await page.mouse.up();
}

const state = (page: Page): Promise<string | null> => page.locator('.drawn').textContent();

test('the four-bar turns at once and becomes the machine', async () => {
  const { page, errors } = await open();
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: four-bar' }).click();
  await page.getByText('The drive turns on and on').waitFor();
  assert.match((await state(page))!, /Degrees of freedom: 1/);
  // The rocker turns back where crank and coupler lie in line: the law of cosines in the triangle with rocker and ground.
  const [crank, coupler, rocker, ground] = [Math.hypot(40, 60), Math.hypot(220, 110), Math.hypot(20, 170), 240] as const;
  const at = (reach: number): number => (Math.acos((ground ** 2 + reach ** 2 - rocker ** 2) / (2 * ground * reach)) * 180) / Math.PI;
  const angles = [...(await state(page))!.matchAll(/rocker at φ = ([\d.]+)/g)].map(([, angle]) => Number(angle));
  for (const [k, angle] of [at(coupler + crank), at(coupler - crank) + 180].entries()) assert.ok(Math.abs(angles[k]! - angle) < 1e-4, `${angles[k]} is not ${angle}`);
  await page.getByRole('heading', { level: 1, name: 'Four-bar' }).waitFor();
  // The crank from (0, 0) to (40, 60) is √5200 mm long.
  assert.match(await text(page), /type = "linkage"[^]*name = "crank"[^]*\["72\.111026 mm", "0 mm"\]/);
  assert.deepEqual(errors, []);
});

test('a crank that is too long reaches dead points, which are named, and undo brings it back', async () => {
  const { page } = await open();
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: four-bar' }).click();
  await page.getByText('The drive turns on and on').waitFor();
  const joint = page.locator('[data-point="A"]');
  await joint.focus();
  for (let k = 0; k < 14; k++) await page.keyboard.press('Shift+ArrowUp');
  await page.getByText('The drive moves between').waitFor();
  assert.match((await state(page))!, /dead point at φ/);
  for (let k = 0; k < 3 && !/turns on and on/.test((await state(page))!); k++) {
    await page.getByRole('button', { name: 'Undo' }).click();
    await page.getByText('The drive turns on and on').waitFor({ timeout: 10_000 }).catch(() => undefined);
  }
  assert.match((await state(page))!, /turns on and on/);
});

test('two degrees of freedom, none, and no drive are explained', async () => {
  const { page } = await open();
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: four-bar' }).click();
  await page.locator('[data-point="C"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('fixed to the frame').uncheck();
  await page.locator('.drawn').getByText('3 degrees of freedom, not one').waitFor();
  assert.match((await state(page))!, /Degrees of freedom: 3/);
  await page.getByLabel('fixed to the frame').check();
  await page.getByText('The drive turns on and on').waitFor();
  await page.locator('[data-point="B"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('fixed to the frame').check();
  await page.locator('.drawn').getByText('-1 degrees of freedom, not one').waitFor();
  await page.getByLabel('fixed to the frame').uncheck();
  await page.locator('[data-point="O"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('is driven').uncheck();
  await page.locator('.drawn').getByText('No joint is driven').waitFor();
});

test('a slider-crank is drawn from nothing with the pointer', async () => {
  const { page } = await open();
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: empty sheet' }).click();
  await page.getByRole('button', { name: 'Link', exact: true }).click();
  await drag(page, [0.3, 0.5], [0.35, 0.4]);
  await drag(page, [0.35, 0.4], [0.7, 0.5]);
  assert.equal(await page.locator('.sheet-canvas .joint').count(), 3);
  await page.getByRole('button', { name: 'Move', exact: true }).click();
  await page.locator('[data-point="A"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('fixed to the frame').check();
  await page.getByLabel('is driven').check();
  await page.locator('[data-point="C"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('slides along a line').check();
  await page.getByLabel('Mass that slides').fill('12');
  await page.getByLabel('Mass that slides').press('Enter');
  await page.getByLabel('Force against the motion').fill('300');
  await page.getByLabel('Force against the motion').press('Enter');
  await page.getByText('The drive turns on and on').waitFor();
  assert.match((await state(page))!, /Dead centres:.*block C at/);
  await holds(page, /mass = "12 kg"[^]*type = "prismatic"[^]*opposing_force = "300 N"/);
  const drive = await sized(page);
  assert.match(drive, /\w/);
});

test('the pins of another machine come onto the sheet', async () => {
  const { page } = await open('#machine=four-bar.toml');
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: empty sheet' }).click();
  await page.getByRole('button', { name: 'Take over the machine file' }).click();
  await page.locator('.sheet-canvas .joint').nth(3).waitFor();
  assert.equal(await page.locator('.sheet-canvas .body').count(), 3);
  // The sheet shows the machine file as it is changed elsewhere; a change on the sheet keeps load and motion.
  const motion = /\[motion\][^]*$/.exec(await text(page))![0].trim();
  await page.getByRole('tab', { name: 'Quantities' }).click();
  const mass = page.locator('input[type=number][aria-label$="mass [kg]"]').first();
  await mass.fill('3.25');
  await mass.press('Enter');
  await holds(page, /mass = "3.25 kg"/);
  await sheet(page);
  await page.locator('.sheet-canvas [data-point="B"]').focus();
  await page.keyboard.press('ArrowUp');
  await holds(page, /type = "linkage"[^]*flywheel = "0.01 kg m\^2"[^]*mass = "3.25 kg"[^]*name = "weight of the part"/);
  assert.ok((await text(page)).includes(motion), 'the motion stays');
});

test('a load of the machine file is shown at its link, follows its name, and goes with it', async () => {
  const { page } = await open('#machine=four-bar.toml');
  await sized(page);
  await sheet(page);
  const load = page.getByText('Also acting, as in the machine file: weight of the part');
  for (let k = 0; k < 3 && !(await load.isVisible()); k++) {
    await page.locator('[data-body]').nth(k).focus();
    await page.keyboard.press('Enter');
  }
  await load.waitFor();
  await page.getByLabel('Name', { exact: true }).fill('arm "2"');
  await page.getByLabel('Name', { exact: true }).press('Enter');
  await holds(page, /on = "arm \\"2\\""/);
  await page.getByText('The drive turns on and on').waitFor();
  await page.getByRole('button', { name: 'Remove' }).click();
  await page.locator('.drawn .fault').waitFor();
  assert.match(await text(page), /weight of the part/);
});

test('a file that is opened while a drawing is examined stays', async () => {
  const { page } = await open();
  await sized(page);
  await page.getByRole('button', { name: 'Machines', exact: true }).click();
  await page.getByRole('button', { name: /scotch-yoke/ }).waitFor();
  await page.keyboard.press('Escape');
  await sheet(page);
  await page.getByRole('button', { name: 'New: four-bar' }).click();
  await page.getByText('The drive turns on and on').waitFor();
  await page.evaluate(() => {
    document.querySelector('.sheet-canvas [data-point="A"]')!.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowUp', bubbles: true }));
    [...document.querySelectorAll<HTMLButtonElement>('.gallery button')].find((button) => button.textContent!.includes('scotch-yoke'))!.click();
  });
  await page.waitForURL(/#machine=scotch-yoke\.toml/);
  await page.waitForTimeout(1000);
  assert.match(await text(page), /type = "scotch-yoke"/);
});

test('a machine without a motion stays the same on the sheet, and gets one by a change', async () => {
  const { page } = await open('#machine=four-bar.toml');
  await sized(page);
  const whole = await text(page);
  await write(page, whole.slice(0, whole.indexOf('[motion]')));
  await page.locator('.drive-name').getByText('Not sized').waitFor();
  await sheet(page);
  await page.locator('.sheet-canvas [data-point="B"]').focus();
  await page.keyboard.press('ArrowUp');
  await holds(page, /flywheel = "0.01 kg m\^2"[^]*speed = "60 rpm"[^]*name = "weight of the part"/);
});

test('a length is typed, and the other links keep theirs; a moment acts on a link', async () => {
  const { page } = await open();
  await sized(page);
  await sheet(page);
  await page.getByRole('button', { name: 'New: four-bar' }).click();
  await page.locator('[data-body="crank"]').focus();
  await page.keyboard.press('Enter');
  await page.getByRole('spinbutton', { name: 'Length', exact: true }).fill('80');
  await page.getByRole('spinbutton', { name: 'Length', exact: true }).press('Enter');
  await holds(page, /"A" = \["80 mm", "0 mm"\][^]*"B" = \["245.967478 mm", "0 mm"\][^]*"C" = \["171.172428 mm", "0 mm"\]/);
  await page.locator('[data-body="rocker"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('Moment against the motion').fill('15');
  await page.getByLabel('Moment against the motion').press('Enter');
  await holds(page, /on = "rocker"\nopposing_moment = "15 N m"/);
  await sized(page);
  // No joint is driven: what is shown is the last machine.
  await page.locator('[data-point="O"]').focus();
  await page.keyboard.press('Enter');
  await page.getByLabel('is driven').uncheck();
  await page.getByText('those of the last one that did').waitFor();
  await page.getByLabel('is driven').check();
  await page.getByText('those of the last one that did').waitFor({ state: 'hidden' });
});

test('a file of Linkage comes onto the sheet, lengths in millimetres', async () => {
  const { page } = await open();
  await sized(page);
  const px = 96 / 25.4;
  const at = (id: number, x: number, y: number, more: string): string => `<connector id="${id}" x="${x * px}" y="${y * px}" ${more}/>`;
  const link = (id: number, ...joints: number[]): string => `<Link id="${id}">${joints.map((joint) => `<connector id="${joint}"/>`).join('')}</Link>`;
  const xml = `<linkage2><program scalefactor="1.0" units="Millimeters"/>${at(1, 0, 0, 'anchor="true" input="true" rpm="30"')}${at(2, 0, 30, '')}${at(4, 200, 0, 'anchor="true"')}${at(5, 20, 0, 'anchor="true"')}`
    + `<connector id="3" x="${100 * px}" y="0" slider="true"><slidelimit id="5"/><slidelimit id="4"/></connector>${link(0, 1, 2)}${link(1, 2, 3)}${link(2, 5, 4)}</linkage2>`;
  await page.locator('input[type=file]').setInputFiles({ name: 'slider.linkage2', mimeType: 'application/xml', buffer: Buffer.from(xml) });
  await page.getByText('The drive turns on and on').waitFor();
  const file = await text(page);
  assert.match(file, /\["30 mm", "0 mm"\]/);
  // The rod from (0, 30) to (100, 0): √10900 mm.
  assert.match(file, /\["104\.403065 mm", "0 mm"\]/);
  assert.match(file, /speed = "30 rpm"/);
});
