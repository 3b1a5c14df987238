// The folders and pages that the tests look at, and what they do with a page.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export const out = process.env.SLALOM_TEST_DIR || join(tmpdir(), 'slalom-browser-test');
mkdirSync(out, { recursive: true });

/** Runs the program. */
export function slalom(...command) {
  assert.ok(process.env.SLALOM, 'set SLALOM to the program');
  execFileSync(process.env.SLALOM, command, { stdio: ['ignore', 'ignore', 'inherit'] });
}

const folders = new Map();

/** The folder named by an environment variable, or made by the program. */
export function made(variable, name, command) {
  if (process.env[variable]) return process.env[variable];
  if (!folders.has(name)) {
    assert.ok(process.env.SLALOM, `set ${variable}, or SLALOM to the program that makes one`);
    folders.set(name, join(out, name));
    slalom(...command, '--out', join(out, name), '--force', '--quiet');
  }
  return folders.get(name);
}

export const driveDir = made('SLALOM_DRIVE_DIR', 'drive', ['simulate', 'E_B', '--planner', 'P_D']);
export const verifiedDir = made('SLALOM_VERIFIED_DIR', 'verified', ['simulate', 'E_C', '--planner', 'P_E']);
export const report = join(driveDir, 'report.html');

const OPEN = '<script type="application/json" id="drive-data">';

/** The page with its data changed by `change`, which may return other data. */
export function changedPage(name, change, page = report) {
  const html = readFileSync(page, 'utf8');
  const from = html.indexOf(OPEN) + OPEN.length;
  const to = html.indexOf('</script', from);
  const data = JSON.parse(html.slice(from, to));
  const changed = change(data) ?? data;
  const file = join(out, `${name}.html`);
  writeFileSync(file, html.slice(0, from) + JSON.stringify(changed).replaceAll('<', '\\u003c') + html.slice(to));
  return file;
}

export const timeOf = (page) => page.evaluate(() => window.slalom.now);
export const textOf = (page, selector) => page.textContent(selector);
export const valuesOf = (page) => page.$$eval('.chart .values', (all) => all.map((v) => v.textContent));

/** Waits for a condition; fails after ten seconds. */
export async function until(holds) {
  for (const stop = Date.now() + 10000; Date.now() < stop;) {
    if (await holds()) return;
    await new Promise((wake) => { setTimeout(wake, 20); });
  }
  assert.fail('nothing happened within ten seconds');
}
