// Two drives on one page, made by the program or by dropping a second page onto the first.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { describe, test } from 'node:test';
import { lookAt, openBrowser } from './browser.mjs';
import { changedPage, driveDir, made, out, report, slalom, textOf, until, valuesOf, verifiedDir } from './pages.mjs';

const otherDir = made('SLALOM_OTHER_DIR', 'other', ['simulate', 'E_B', '--planner', 'P_A']);

function compared(name, ...folders) {
  const file = join(out, `${name}.html`);
  slalom('compare', ...folders, '--out', file, '--force');
  return file;
}

const summary = (folder) => JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8'));
const cellsOf = (page) => page.$$eval('table.compared tr', (rows) => rows.map((r) => [...r.cells].map((c) => c.textContent.trim())));
const seriesOf = (page) => page.$$eval('.chart', (all) => all.map((c) => [...c.querySelectorAll('.series')].map((s) => s.getAttribute('style'))));

/** Drops files on the page, as a person does. */
function drop(page, files) {
  const contents = files.map((file) => ({ name: basename(file), text: readFileSync(file, 'latin1') }));
  return page.evaluate((all) => {
    const transfer = new DataTransfer();
    for (const { name, text } of all) transfer.items.add(new File([Uint8Array.from(text, (c) => c.charCodeAt(0))], name));
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, cancelable: true, bubbles: true }));
  }, contents);
}

/** What every page of two drives has. */
async function looksCompared(page, names) {
  const cells = await cellsOf(page);
  assert.deepEqual(cells.slice(1).map((row) => row[0]), [`A ${names[0]}`, `B ${names[1]}`, 'B − A']);
  const series = await seriesOf(page);
  assert.equal(series.length, 7);
  for (const colours of series) assert.deepEqual(colours, ['stroke:var(--blue)', 'stroke:var(--orange)']);
  await page.click('#view-course');
  const seen = await lookAt(page, ['blue', 'orange']);
  assert.ok(seen.blue.count > 60 && seen.orange.count > 60, `${seen.blue.count}, ${seen.orange.count}`);
  return cells;
}

describe('the page of two drives', () => {
  test('of one scenario: one stage, one axis of time, overlaid charts and a table', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(compared('compare-same', otherDir, driveDir), '#t=2.5');
      const cells = await looksCompared(page, ['E_B with P_A', 'E_B with P_D']);
      const [a, b] = [otherDir, driveDir].map(summary);
      const column = (name) => cells.map((row) => row[cells[0].findIndex((c) => c.startsWith(name))]);
      const [, ...loads] = column('Least wheel load');
      assert.deepEqual(loads.map((l) => Number(l.replace('−', '-'))),
        [a.least_wheel_load_N, b.least_wheel_load_N, b.least_wheel_load_N - a.least_wheel_load_N].map(Math.round));
      assert.equal(column('Time to goal')[2], b.goal_time_s.toFixed(2));
      assert.equal(column('Least clearance')[2], b.least_clearance_m.toFixed(2));
      assert.deepEqual(column('not solved').slice(1, 3), [a, b].map((s) => String(s.cycles_unsolved)));
      assert.equal(column('not verified')[3], '–');
      assert.equal(Number(await page.getAttribute('#time', 'max')), Math.max(a.time_s, b.time_s));
      assert.equal((await page.$$('#differing')).length, 0);
      // The obstacles of both are drawn once, in the colour of neither.
      assert.equal((await lookAt(page, ['vermilion'])).vermilion.count, 0);
      assert.deepEqual(new Set(await page.evaluate(() => window.slalom.course.scene().obstacles.map((o) => o.ink))), new Set(['muted']));
      assert.match(await textOf(page, '.settings'), /planner\.w_t/);
      const marks = [['A', a], ['B', b]].flatMap(([letter, s]) => s.marks.map((m) => `${letter}: ${m.text}`));
      assert.ok(marks.length > 0);
      assert.deepEqual(await page.$$eval('.top .mark', (all) => all.map((m) => m.textContent)), marks);
      assert.equal((await page.$$('#cycle h3')).length, 2);
      await page.screenshot({ path: join(out, 'compare-same.png'), fullPage: true });
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  test('goes on with one when the other is over', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(compared('compare-same', otherDir, driveDir), '#t=6');
      assert.match(await textOf(page, '#cycle'), /the drive is over/);
      assert.match((await valuesOf(page))[0], /A – *B \d/);
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  test('of two scenarios: says so, and draws the obstacles of each in its colour', async () => {
    const browser = await openBrowser({ colorScheme: 'dark' });
    try {
      const { page, complaints } = await browser.open(compared('compare-other', driveDir, verifiedDir), '#t=2');
      await looksCompared(page, ['E_B with P_D', 'E_C with P_E']);
      assert.match(await textOf(page, '#differing'), /scenarios differ: goal; .*obstacles O1, .*start\.x/);
      const inks = await page.evaluate(() => window.slalom.course.scene().obstacles.map((o) => `${o.drive.letter} ${o.ink}`));
      assert.deepEqual(new Set(inks), new Set(['A blue', 'B orange']));
      assert.equal((await page.$$('#rungs div')).length, 1, 'only one of the planners verifies');
      assert.match(await textOf(page, '#rung-legend'), /Plans of B/);
      await page.screenshot({ path: join(out, 'compare-other.png'), fullPage: true });
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  for (const [width, height] of [[1280, 720], [600, 900]]) {
    test(`fits a screen of ${width} pixels`, async () => {
      const browser = await openBrowser({ width, height });
      try {
        const { page, complaints } = await browser.open(compared('compare-same', otherDir, driveDir), '#t=3');
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(wide <= 0, `${wide} pixels too wide`);
        const over = await page.$$eval('figcaption', (all) => all.filter((c) => c.scrollWidth > c.clientWidth).map((c) => c.textContent));
        assert.deepEqual(over, []);
        await page.screenshot({ path: join(out, `compare-${width}.png`) });
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});

describe('a page dropped onto that of a drive', () => {
  test('is compared with it; another takes its place', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(report, '#t=2');
      await drop(page, [join(otherDir, 'report.html')]);
      await until(async () => (await page.$$('table.compared')).length === 1);
      await looksCompared(page, ['E_B with P_D', 'E_B with P_A']);
      assert.equal(await page.evaluate(() => window.slalom.now), 2);
      await page.setInputFiles('#other-drive', join(verifiedDir, 'report.html'));
      await until(async () => /E_C/.test(await textOf(page, 'h1')));
      await looksCompared(page, ['E_B with P_D', 'E_C with P_E']);
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  const file = (name, content) => {
    writeFileSync(join(out, name), content);
    return join(out, name);
  };
  for (const [name, { files, says }] of Object.entries({
    'no drive': { files: () => [file('text.html', 'text')], says: /^text\.html: found no drive, expected the report/ },
    'bytes': { files: () => [file('bytes.html', Buffer.from([0, 255, 128, 60]))], says: /^bytes\.html: found no drive/ },
    'damaged': { files: () => [file('damaged.html', readFileSync(report, 'utf8').replace('"plant":', '"plant"'))], says: /^damaged\.html: found a drive that is damaged/ },
    'without a plant': { files: () => [changedPage('plantless', (d) => { delete d.plant; })], says: /^plantless\.html: found a drive that is damaged/ },
    'another format': { files: () => [changedPage('older', (d) => { d.format = 'slalom drive 0'; })],
      says: /^older\.html: format: found "slalom drive 0", expected "slalom drive 3"$/ },
    'no format': { files: () => [changedPage('oldest', (d) => { delete d.format; })], says: /^oldest\.html: format: found none, expected/ },
    'nothing driven': { files: () => [changedPage('undriven', (d) => { for (const column of Object.values(d.plant)) column.length = 0; })],
      says: /^undriven\.html: found a drive in which nothing was driven/ },
    'two drives': { files: () => [compared('compare-same', otherDir, driveDir)], says: /^compare-same\.html: found 2 drives/ },
    'two files': { files: () => [report, report], says: /^found 2 files, expected one$/ },
  })) {
    test(`is refused: ${name}`, async () => {
      const browser = await openBrowser();
      try {
        const { page, complaints } = await browser.open(report, '#t=2');
        await drop(page, files());
        await until(() => page.isVisible('#problem'));
        assert.match(await textOf(page, '#problem'), says);
        assert.equal((await page.$$('table.compared')).length, 0);
        assert.equal(await page.evaluate(() => window.slalom.drives.length), 1);
        await drop(page, [join(otherDir, 'report.html')]);
        await until(async () => (await page.$$('table.compared')).length === 1);
        assert.ok(!(await page.isVisible('#problem')), 'what is right is taken, and the message goes');
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});
