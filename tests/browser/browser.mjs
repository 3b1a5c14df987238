// Opens pages of files in Debian's Chromium and notes whatever they complain of or ask for.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const executablePath = process.env.SLALOM_CHROMIUM || '/usr/bin/chromium';
const args = ['--no-sandbox', '--headless', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

/** A browser with a profile of its own, for one colour scheme and size. */
export async function openBrowser({ colorScheme = 'light', width = 1440, height = 900 } = {}) {
  const profile = mkdtempSync(join(tmpdir(), 'slalom-browser-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath, args, colorScheme, viewport: { width, height }, headless: true,
    // The flags above say all of it; playwright's own would only add to them.
    ignoreDefaultArgs: ['--enable-automation'],
  });
  return {
    /** Loads a file; `complaints` fills with console messages, errors and requests. */
    async open(file, hash = '') {
      const page = await context.newPage();
      const complaints = [];
      const address = pathToFileURL(file).href;
      page.on('console', (m) => complaints.push(`console ${m.type()}: ${m.text()}`));
      page.on('pageerror', (e) => complaints.push(`error: ${e.stack || e.message}`));
      page.on('request', (r) => {
        const url = r.url().split('#')[0];
        if (url !== address && !url.startsWith('data:')) complaints.push(`request: ${url}`);
      });
      await page.goto(address + hash);
      return { page, complaints };
    },
    async close() {
      await context.close();
      rmSync(profile, { recursive: true, force: true });
    },
  };
}

/** What the canvas shows: how many colours, and where the pixels of some of them lie. */
export function lookAt(page, names) {
  return page.evaluate((wanted) => {
    const canvas = document.getElementById('stage');
    const { width, height } = canvas;
    const copy = document.createElement('canvas');
    Object.assign(copy, { width, height });
    const probe = copy.getContext('2d', { willReadFrequently: true });
    probe.drawImage(canvas, 0, 0);
    const { data } = probe.getImageData(0, 0, width, height);
    const style = getComputedStyle(document.documentElement);
    const key = (r, g, b) => (r << 16) | (g << 8) | b;
    const marks = {};
    for (const name of wanted) {
      probe.fillStyle = style.getPropertyValue('--' + name).trim();
      probe.fillRect(0, 0, 1, 1);
      const [r, g, b] = probe.getImageData(0, 0, 1, 1).data;
      marks[name] = { key: key(r, g, b), count: 0, x: 0, y: 0 };
    }
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      const k = key(data[i], data[i + 1], data[i + 2]);
      colours.add(k);
      for (const m of Object.values(marks)) {
        if (m.key !== k) continue;
        m.count += 1;
        m.x += (i / 4) % width;
        m.y += Math.floor(i / 4 / width);
      }
    }
    for (const m of Object.values(marks)) { m.x /= m.count; m.y /= m.count; }
    return { colours: colours.size, width, height, ...marks };
  }, names);
}
