// A server of its own store, a browser, and what the tests of the page share.
import {spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {createInterface} from 'node:readline';
import {fileURLToPath} from 'node:url';
import {chromium} from 'playwright-core';
import {PNG} from 'pngjs';

export const SAMPLES = fileURLToPath(new URL('../../../samples/', import.meta.url));
export const sample = (name) => join(SAMPLES, name);

/** Software rendering, and nothing sent anywhere but to the server. */
const FLAGS = ['--no-sandbox', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];

export async function startServer(...flags) {
  const place = mkdtempSync(join(tmpdir(), 'spherematch-page-'));
  const child = spawn(process.env.SPHEREMATCH_SERVER, ['--port', '0', '--store', join(place, 's.db'), ...flags], {stdio: ['ignore', 'pipe', 'ignore']});
  const line = await new Promise((resolve, reject) => {
    createInterface({input: child.stdout}).once('line', resolve);
    child.once('exit', (code) => reject(new Error(`the server ended with ${code}`)));
  });
  const url = line.replace('listening on ', '');
  return {url, place, stop: () => new Promise((resolve) => {
    child.removeAllListeners('exit');
    child.once('exit', (code) => {
      rmSync(place, {recursive: true, force: true});
      resolve(code);
    });
    child.kill('SIGTERM');
  })};
}

export function launch(...flags) {
  return chromium.launch({executablePath: process.env.SPHEREMATCH_CHROMIUM ?? '/usr/bin/chromium', args: [...FLAGS, ...flags]});
}

/** A page whose complaints are kept: whatever it writes as an error, but for answers that a test provokes. */
export async function openPage(browser, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, ...options});
  page.complaints = [];
  page.on('pageerror', (error) => page.complaints.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error' && !(page.expected ?? /^$/).test(message.text())) page.complaints.push(message.text());
  });
  page.on('request', (request) => {
    if (!/^(http:\/\/127\.0\.0\.1:|blob:|data:)/.test(request.url())) page.complaints.push(`a request to ${request.url()}`);
  });
  return page;
}

/** Uploads without the page. @returns the shape's id */
export async function prepare(url, name, bytes = readFileSync(sample(name))) {
  const upload = `${url}/shapes?name=${name.split('/').pop()}&wait=60`;
  let shape = await (await fetch(upload, {method: 'POST', body: bytes})).json();
  // The same bytes again only wait: on a busy machine a large mesh takes its time.
  for (let tries = 0; tries < 2 && shape.state === 'processing'; ++tries) shape = await (await fetch(upload, {method: 'POST', body: bytes})).json();
  if (shape.state !== 'ready') throw new Error(`${name}: ${JSON.stringify(shape)}`);
  return shape.id;
}

export const stageState = (page, state, timeout = 30_000) => page.waitForSelector(`#stage[data-state="${state}"]`, {timeout});

export async function open(page, url, fragment = '', state = 'matched') {
  await page.goto('about:blank');
  await page.goto(`${url}/${fragment}`);
  if (state) await stageState(page, state);
}

/** Waits until what was asked for is drawn. */
export async function settled(page) {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(resolve, 60)))));
}

export async function picture(page) {
  await settled(page);
  const png = PNG.sync.read(await page.screenshot());
  return {width: png.width, height: png.height, at: (x, y) => [...png.data.subarray((Math.round(y) * png.width + Math.round(x)) * 4).subarray(0, 3)]};
}

/** The markers of a side: [{vertex, x, y, hidden}], x and y in the window. */
export function markers(page, side, kind = '') {
  return page.$$eval(`.pane.${side} .marker${kind}`, (elements) => elements.map((element) => {
    const pane = element.closest('.pane').getBoundingClientRect();
    return {vertex: Number(element.dataset.vertex), x: pane.left + Number(element.dataset.x), y: pane.top + Number(element.dataset.y), hidden: element.dataset.hidden === 'true'};
  }));
}

/** Pins a vertex by its number. */
export async function goTo(page, side, vertex) {
  await page.selectOption('#vertex-side', side);
  await page.fill('#vertex', String(vertex));
  await page.press('#vertex', 'Enter');
  await page.waitForSelector(`.point.pin[data-side="${side}"][data-vertex="${vertex}"][data-image]`);
  await settled(page);
}

export function listedPoint(page) {
  return page.$eval('.point.pin', (element) => ({...element.dataset}));
}

export function off(vertices, faces) {
  return ['OFF', `${vertices.length} ${faces.length} 0`, ...vertices.map((p) => p.join(' ')), ...faces.map((f) => `${f.length} ${f.join(' ')}`), ''].join('\n');
}
