// Signals that the reader chooses, and axes of places far from zero.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { changedPage, out, report, textOf, timeOf, until, verifiedDir } from './pages.mjs';

/** Runs `look` on a page, which must complain of nothing. */
async function on(file, hash, look) {
  const browser = await openBrowser();
  try {
    const { page, complaints } = await browser.open(file, hash);
    await look(page, browser);
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
  }
}

const titlesOf = (page) => page.$$eval('.chart .what', (all) => all.map((w) => w.textContent));
const hashOf = (page) => page.evaluate(() => window.location.hash);
const checkedOf = (page) => page.$$eval('#signals input:checked', (all) => all.map((i) => i.value));
const ticksOf = (page) => page.$$eval('.chart text[text-anchor=end]:not(.limit-label)', (all) => all.map((t) => t.textContent));

describe('the signals of a drive', () => {
  test('are chosen in a menu, and the choice is in the address beside the time', () => on(report, '#t=2', async (page, browser) => {
    const usual = await titlesOf(page);
    await page.click('.choose summary');
    await page.check('#signals input[value=psi]');
    await page.uncheck('#signals input[value=sr]');
    const titles = await titlesOf(page);
    assert.equal(titles.length, usual.length);
    assert.ok(titles.some((t) => /Heading psi \[°/.test(t)) && !titles.some((t) => t.includes('Steering rate')), titles.join());
    assert.match(await hashOf(page), /^#t=2&show=[\w,]*psi/);
    assert.equal(await timeOf(page), 2);
    await page.screenshot({ path: join(out, 'signals.png') });

    const again = await browser.open(report, await hashOf(page));
    assert.deepEqual(await titlesOf(again.page), titles, 'the link shows the same');
    assert.equal(await timeOf(again.page), 2);
    assert.deepEqual(again.complaints, []);

    await page.click('#signals button');
    assert.deepEqual(await titlesOf(page), usual);
    assert.equal(await hashOf(page), '#t=2');
    await page.mouse.click(5, 5);
    assert.ok(!(await page.isVisible('#signals')), 'a click beside the menu closes it');
    await page.click('.choose summary');
    assert.ok(await page.isVisible('#signals'));
    await page.keyboard.press('Escape');
    assert.ok(!(await page.isVisible('#signals')), 'Escape closes it');
  }));

  test('are all on offer, each with its unit, and all can be drawn', () => on(join(verifiedDir, 'report.html'), '#t=8', async (page) => {
    const keys = await page.$$eval('#signals input', (all) => all.map((i) => i.value));
    const { plant } = await page.evaluate(() => window.slalom.drives[0].data);
    for (const name of Object.keys(plant)) assert.ok(name === 't' || keys.includes(name), `no signal ${name}`);
    for (const name of ['Fz', 'wall', 'cpu', 'slack', 'slack_psi', 'verified_clearance']) assert.ok(keys.includes(name), name);
    for (const label of await page.$$eval('#signals label', (all) => all.map((l) => l.textContent))) assert.match(label, /\[[^\]]+\]/);
    await page.evaluate((all) => { window.location.hash = `t=8&show=${all.join(',')}`; }, keys);
    await until(async () => (await page.$$('.chart')).length === keys.length);
    const curves = await page.$$eval('.chart', (all) => all.map((c) => [c.querySelector('.what').textContent,
      [...c.querySelectorAll('.series, .bar')].map((p) => p.outerHTML).join(''), c.querySelector('.values').textContent]));
    for (const [what, drawn, value] of curves) {
      assert.ok(drawn.length > 100 && !/NaN|undefined|Infinity/.test(drawn), what);
      assert.match(value, /\d/, what);
    }
    await page.screenshot({ path: join(out, 'all-signals.png'), fullPage: true });
  }));

  test('that nobody knows are left out, and none are shown where none are named', () => on(report, '#t=1&show=psi,nothing', async (page) => {
    assert.deepEqual(await checkedOf(page), ['psi']);
    assert.equal((await page.$$('.chart')).length, 1);
    await page.evaluate(() => { window.location.hash = 't=1&show='; });
    await until(async () => (await page.$$('.chart')).length === 0);
    assert.equal(await textOf(page, '#problem'), '');
  }));
});

describe('the page of a drive at UTM coordinates', () => {
  const [x0, y0] = [500000, 5.4e6];
  /** The drive moved there; E_B begins at x = 200. */
  const moved = (data) => {
    const move = (name, by) => (o) => {
      if (o[name] !== undefined && o[name] !== null) o[name] = Array.isArray(o[name]) ? o[name].map((v) => v + by) : o[name] + by;
    };
    const all = [data.start, data.goal, data.plant, ...data.cycles.map((c) => c.plan), ...data.obstacles];
    for (const [name, by] of [['x', x0 - 200], ['y', y0]]) all.forEach(move(name, by));
    for (const [name, by] of [['x_min', x0 - 200], ['x_max', x0 - 200], ['y_min', y0], ['y_max', y0]]) move(name, by)(data.region);
  };

  test('says an offset once, and has short labels', () => on(changedPage('utm', moved), '#t=2&show=x,y,ux', async (page) => {
    const words = await page.evaluate(() => {
      const said = [];
      const { fillText } = CanvasRenderingContext2D.prototype;
      CanvasRenderingContext2D.prototype.fillText = function note(text, ...rest) {
        said.push(text);
        return fillText.call(this, text, ...rest);
      };
      window.slalom.stage.draw(2);
      CanvasRenderingContext2D.prototype.fillText = fillText;
      return said;
    });
    assert.equal(words.filter((w) => w.includes('+5e5 m') && w.includes('+5.4e6 m')).length, 1, words.join());
    const numbers = words.filter((w) => /^−?\d/.test(w));
    assert.ok(numbers.length >= 4 && numbers.every((w) => w.length <= 4), numbers.join());
    assert.equal(new Set(numbers.filter((w) => Number(w) > 20)).size, numbers.filter((w) => Number(w) > 20).length);
    const titles = (await titlesOf(page)).join();
    assert.ok(titles.includes('[m, +5e5]') && titles.includes('[m, +5.4e6]'), titles);
    for (const tick of await ticksOf(page)) assert.ok(tick.length <= 5, tick);
    const values = await page.$$eval('.chart .values', (all) => all.map((v) => v.textContent));
    assert.ok(Number(values[2]) > 5.4e6, 'the value under the cursor is whole');
    await page.screenshot({ path: join(out, 'utm.png') });
  }));
});

describe('the page of a late plan', () => {
  test('shows the last plan until the late one takes over', async () => {
    const late = (data) => { data.cycles[3].t_swap += 0.3; };
    await on(changedPage('late', late), '', async (page) => {
      const [before, after, until, plain] = await page.evaluate(() => {
        const [drive] = window.slalom.drives;
        const { cycles } = drive.data;
        const drivenAt = (t) => cycles.indexOf(drive.cycleAt(t));
        const planned = (cycle) => window.slalom.plannedUntil(cycle) - cycle.t0 - cycle.tex;
        const { t_start: from } = cycles[3].plan;
        return [drivenAt(from + 0.2), drivenAt(from + 0.4), planned(cycles[3]), planned(cycles[4])];
      });
      assert.deepEqual([before, after], [2, 3]);
      assert.ok(Math.abs(until - 0.3) < 1e-6 && Math.abs(plain) < 1e-6, `${until}, ${plain}`);
    });
  });
});
