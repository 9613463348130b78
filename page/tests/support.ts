/** A server of the built page and a browser, for tests. */
import assert from 'node:assert/strict';
import { createServer, type Server } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';

/** Folder of the built page. */
const DIST = process.env['JRED_PAGE'] ?? 'dist';
const TYPES: Record<string, string> = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.wasm': 'application/wasm',
};

let server: Server | undefined;
let browser: Browser | undefined;
let address = '';

/** Starts the server. */
export async function serve(): Promise<void> {
  server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url ?? '/', 'http://x').pathname));
    readFile(join(DIST, path.endsWith('/') ? `${path}index.html` : path)).then(
      (data) => response.writeHead(200, { 'content-type': TYPES[extname(path) || '.html'] ?? 'text/plain' }).end(data),
      () => response.writeHead(404).end());
  });
  await new Promise<void>((ready) => server!.listen(0, 'localhost', ready));
  address = `http://localhost:${(server.address() as { port: number }).port}/`;
}

export async function begin(): Promise<void> {
  await serve();
  browser = await chromium.launch({ executablePath: process.env['JRED_BROWSER'] ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
}

export async function end(): Promise<void> {
  await browser?.close();
  server?.close();
}

/** Stops the server, as if there were no network. */
export async function unplug(): Promise<void> {
  server?.closeAllConnections();
  await new Promise((done) => server?.close(done));
  server = undefined;
}

export interface Opened {
  page: Page;
  /** Errors that nobody caught. */
  errors: string[];
}

/** A page at a fragment, once `ready` has happened to it before it is loaded. */
export async function open(fragment = '', options: BrowserContextOptions = {}, ready?: (page: Page) => Promise<unknown>): Promise<Opened> {
  const context = await browser!.newContext({ viewport: { width: 1440, height: 900 }, locale: 'en', reducedMotion: 'reduce', acceptDownloads: true, ...options });
  context.setDefaultTimeout(90_000);
  const page = await context.newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await ready?.(page);
  await page.goto(address + fragment);
  return { page, errors };
}

/** Waits until the catalogue has been sized. */
export async function sized(page: Page): Promise<string> {
  await page.locator('.drive[aria-busy="false"] .drive-name strong').waitFor();
  return (await page.locator('.drive-name strong').textContent()) ?? '';
}

export function url(): string {
  return address;
}

/** A quantity's number field. */
export function field(page: Page, label: string): ReturnType<Page['getByRole']> {
  return page.getByRole('spinbutton', { name: label });
}

/** Pastes a text over the whole text of the machine file. */
export async function write(page: Page, text: string): Promise<void> {
  await page.getByRole('tab', { name: 'Text' }).click();
  await page.locator('.cm-content').waitFor();
  await page.locator('.cm-content').focus();
  await page.keyboard.press('Control+a');
  await page.locator('.cm-content').evaluate((editor, pasted) => {
    const clipboardData = new DataTransfer();
    clipboardData.setData('text/plain', pasted);
    editor.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true, cancelable: true }));
  }, text);
}

export async function text(page: Page): Promise<string> {
  const [download] = await Promise.all([page.waitForEvent('download'), page.evaluate(() => {
    document.getElementById('tab-export')!.click();
    [...document.querySelectorAll<HTMLButtonElement>('.exports button')].find((button) => button.textContent === 'Machine file')!.click();
  })]);
  return readFile(await download.path(), 'utf8');
}

/** Waits until the machine file is what it should be: a drawing becomes a text once the core has answered. */
export async function holds(page: Page, wanted: RegExp): Promise<void> {
  for (let k = 0; k < 200 && !wanted.test(await text(page)); k++) await page.waitForTimeout(200);
  assert.match(await text(page), wanted);
}
