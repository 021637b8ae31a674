// What the tests of the viewer share: the apps, a browser, pictures as pixels.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { after } from 'node:test';

export const apps = process.env.ANISOMESH_APPS;
const knownSurface = process.env.ANISOMESH_KNOWN_SURFACE;
const packages = process.env.ANISOMESH_VIEW_PACKAGES;

const names = (process.env.PATH ?? '')
  .split(':')
  .flatMap((folder) => ['chromium', 'chromium-browser', 'google-chrome'].map((n) => path.join(folder, n)));
export const chromiumPath = process.env.ANISOMESH_CHROMIUM || names.find((name) => existsSync(name));
if (!chromiumPath) {
  console.log('SKIPPED: there is no Chromium (package chromium)');
  process.exit(0);
}

export const work = mkdtempSync(path.join(os.tmpdir(), 'anisomesh-view-test-'));
const browsers = [];
after(async () => {
  for (const browser of browsers) await browser.close();
  rmSync(work, { recursive: true, force: true });
});
export const file = (name) => path.join(work, name);

/** Runs an app: status, stdout, stderr. */
export function run(app, args, environment = {}) {
  return spawnSync(path.join(apps, app), args, {
    encoding: 'utf8',
    cwd: work,
    env: { ...process.env, ...environment },
    maxBuffer: 1 << 28,
  });
}

/** Runs an app that must succeed without a word on stderr. */
export function must(app, ...args) {
  const { status, stdout, stderr } = run(app, args);
  if (status !== 0 || stderr) throw new Error(`${app} ${args.join(' ')}: exit ${status}\n${stderr}`);
  return stdout;
}

/** known.om and known-result.om, see known_surface.cc. */
export function makeKnown() {
  const { status, stderr } = spawnSync(knownSurface, [file('known.om'), file('known-result.om')], { encoding: 'utf8' });
  if (status !== 0) throw new Error(stderr);
}

/** A browser that a page is opened in as a person would: from a file, with nothing else. Collects what must not happen. */
export async function openBrowser() {
  const { chromium } = createRequire(path.join(packages, 'package.json'))('playwright-core');
  const args = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
  if (process.getuid() === 0) args.push('--no-sandbox');
  const browser = await chromium.launch({ executablePath: chromiumPath, args });
  browsers.push(browser);
  return async (name, viewport = { width: 1200, height: 700 }) => {
    const page = await browser.newPage({ viewport });
    const complaints = [];
    const requests = [];
    page.on(
      'console',
      (message) =>
        ['error', 'warning'].includes(message.type()) && !driverNote(message.text()) && complaints.push(message.text()),
    );
    page.on('pageerror', (error) => complaints.push(error.message));
    page.on('request', (request) => requests.push(request.url()));
    const begun = Date.now();
    await page.goto(`file://${file(name)}`);
    return { page, complaints, requests, milliseconds: Date.now() - begun };
  };
}

/** Chromium's own remark that reading pixels back takes time; only the tests read them. */
const driverNote = (text) => text.includes('GPU stall due to ReadPixels');

/** A PNG of 8 bits a channel as { width, height, at(x, y) }. */
export function decodePng(bytes) {
  let at = 8;
  const parts = [];
  let width, height, channels;
  while (at < bytes.length) {
    const length = bytes.readUInt32BE(at);
    const type = bytes.toString('latin1', at + 4, at + 8);
    if (type === 'IHDR') {
      [width, height] = [bytes.readUInt32BE(at + 8), bytes.readUInt32BE(at + 12)];
      channels = { 2: 3, 6: 4 }[bytes[at + 17]];
      if (bytes[at + 16] !== 8 || !channels || bytes[at + 20] !== 0) throw new Error('not a PNG of plain RGB(A)');
    }
    if (type === 'IDAT') parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const raw = zlib.inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const out = Buffer.alloc(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x >= channels ? out[y * stride + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * stride + x - channels] : 0;
      const p = left + up - corner;
      const [a, b, c] = [Math.abs(p - left), Math.abs(p - up), Math.abs(p - corner)];
      const paeth = a <= b && a <= c ? left : b <= c ? up : corner;
      const guess = [0, left, up, (left + up) >> 1, paeth][filter];
      out[y * stride + x] = (raw[y * (stride + 1) + 1 + x] + guess) & 255;
    }
  }
  return {
    width,
    height,
    channels,
    pixels: out,
    at: (x, y) => [
      ...out.subarray(
        (Math.round(y) * width + Math.round(x)) * channels,
        (Math.round(y) * width + Math.round(x)) * channels + 3,
      ),
    ],
  };
}

export const readPng = (name) => decodePng(readFileSync(file(name)));
/** What the page shows now between the panels. */
export const screenshot = async (page) => decodePng(await page.locator('#stage').screenshot());

export const hues = {
  red: ([r, g, b]) => r > 150 && g < 90 && b < 90,
  blue: ([r, g, b]) => b > 150 && r < 100 && g < 140,
  green: ([r, g, b]) => g > 110 && r < 90 && b < 130,
  black: ([r, g, b]) => r < 60 && g < 60 && b < 60,
  white: ([r, g, b]) => r > 250 && g > 250 && b > 250,
  grey: ([r, g, b]) => Math.max(r, g, b) - Math.min(r, g, b) < 25 && r > 90 && r < 240,
  orange: ([r, g, b]) => r > 220 && g > 130 && g < 210 && b < 60,
  purple: ([r, g, b]) => r > 110 && r < 190 && g < 100 && b > 170,
};

/** Whether a pixel of this hue lies within `reach` pixels of a place. */
export function near(picture, x, y, hue, reach = 2) {
  for (let j = -reach; j <= reach; ++j)
    for (let i = -reach; i <= reach; ++i) {
      const [px, py] = [Math.round(x) + i, Math.round(y) + j];
      if (px >= 0 && py >= 0 && px < picture.width && py < picture.height && hues[hue](picture.at(px, py))) return true;
    }
  return false;
}

/** The box of what is not white in a part of a picture between title and legend (`footer` pixels high; on a page it always is), which says where a square is without asking the page. */
export function boxOf(picture, { x = 0, y = 26, width = picture.width - x, footer = 93 } = {}) {
  const height = picture.height - y - footer;
  const box = { left: Infinity, right: -1, top: Infinity, bottom: -1 };
  for (let j = y; j < y + height; ++j)
    for (let i = x; i < x + width; ++i) {
      if (hues.white(picture.at(i, j))) continue;
      box.left = Math.min(box.left, i);
      box.right = Math.max(box.right, i);
      box.top = Math.min(box.top, j);
      box.bottom = Math.max(box.bottom, j);
    }
  if (box.right < 0) throw new Error('there is nothing in the picture');
  /** The pixel of the point (x, y) of the unit square. */
  box.at = (u, v) => [box.left + u * (box.right - box.left), box.bottom - v * (box.bottom - box.top)];
  return box;
}

/** How many pixels of a part of two pictures differ by more than a hair. */
export function differing(a, b, { x = 0, y = 0, width = a.width, height = a.height } = {}) {
  let count = 0;
  for (let j = y; j < y + height; ++j)
    for (let i = x; i < x + width; ++i) {
      let sum = 0;
      for (let c = 0; c < 3; ++c)
        sum += Math.abs(a.pixels[(j * a.width + i) * a.channels + c] - b.pixels[(j * b.width + i) * b.channels + c]);
      if (sum > 12) ++count;
    }
  return count;
}
