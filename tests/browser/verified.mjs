// The page of a drive whose planner verifies its plans.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { openBrowser } from './browser.mjs';
import { changedPage, out, report, textOf, until, verifiedDir } from './pages.mjs';

describe('the page of a drive of verified plans', () => {
  const verifiedReport = join(verifiedDir, 'report.html');
  const refused = 'clearance to <O2> at 3.5 s';
  /** One cycle in the middle has the least bad of two motions. */
  const unverified = (data) => {
    const cycle = data.cycles[10];
    const certificate = { ...cycle.certificate, verified: false, refused };
    Object.assign(cycle, { rung: 'least_bad', solved: false, cost: 0, certificate,
      candidates: [{ name: 'rest', cost: null, certificate: { ...certificate, until: 1 }, path: [] },
        { name: 'way 1', cost: null, certificate, path: [] }] });
  };
  const stripOf = (page) => page.$$eval('#rungs i', (all) => all.map((i) => ({ rung: i.className,
    from: i.offsetLeft, to: i.offsetLeft + i.offsetWidth, colour: getComputedStyle(i).backgroundColor })));

  test('shows where each plan comes from, and what else there was', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(verifiedReport, '#t=8.2');
      const [{ driven, data }] = await page.evaluate(() => window.slalom.drives);
      const changes = driven.map((c) => c.rung).filter((rung, i, all) => rung !== all[i - 1]);
      const strip = await stripOf(page);
      assert.deepEqual(strip.map((s) => s.rung), changes);
      strip.forEach((s, i) => assert.ok(s.to > s.from && (i === 0 || Math.abs(s.from - strip[i - 1].to) <= 1)));
      const counted = (await page.$$eval('#rung-legend b', (all) => all.map((b) => Number(b.textContent))));
      assert.deepEqual(counted, ['new', 'rest', 'least_bad'].map((rung) =>
        data.cycles.filter((c) => c.index > 0 && c.rung === rung).length));
      const cycle = await page.evaluate(() => window.slalom.drives[0].cycleAt(8.2));
      const rows = await page.$$eval('.candidates tbody tr', (all) => all.map((r) => r.textContent));
      assert.equal(rows.length, cycle.candidates.length);
      assert.equal(rows.filter((r) => r.includes('driven')).length, 1);
      assert.match(await textOf(page, '#cycle'), /Verified\s*until/);
      await page.screenshot({ path: join(out, 'verified.png'), fullPage: true });
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  /** The first cycle has a plan beside a rest that is verified too. */
  const beside = (data) => {
    const cycle = data.cycles.find((c) => c.index === 1);
    const path = cycle.plan.x.map((x, k) => [x + 3, cycle.plan.y[k]]);
    const certificate = { ...cycle.certificate, until: 1 };
    Object.assign(cycle, { rung: 'new', candidates: [{ name: 'rest', cost: 9, certificate, path },
      { name: 'way 1', cost: 1, certificate: cycle.certificate, path: path.map(([x, y]) => [x - 6, y]) }] });
  };

  test('draws the other motions, and dashed what would be driven instead', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(changedPage('candidates', beside, verifiedReport), '#t=0.6');
      const drawn = () => page.evaluate(() => {
        const at = window.slalom.drives[0].cycleAt(0.6);
        const canvas = document.getElementById('stage');
        return { candidates: at.candidates.length, image: canvas.toDataURL() };
      });
      await until(async () => (await drawn()).candidates === 2);
      const shown = await drawn();
      assert.ok(await page.isVisible('#candidates-key'));
      await page.screenshot({ path: join(out, 'candidates.png'), fullPage: true });
      await page.click('#layer-candidates');
      await until(async () => (await drawn()).image !== shown.image);
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  test('shows an unverified cycle, and why', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(changedPage('unverified', unverified, verifiedReport));
      const at = await page.evaluate(() => window.slalom.drives[0].data.cycles[10].t_swap + 0.1);
      await page.evaluate((t) => { window.location.hash = `t=${t}`; }, at);
      await until(async () => (await page.$$('.candidates tr.taken')).length === 1);
      assert.match(await textOf(page, '.candidates tr.taken'), /way 1.*refused: clearance to <O2> at 3.5 s.*driven/s);
      const strip = await stripOf(page);
      assert.equal(strip.filter((s) => s.rung === 'least_bad').length, 1);
      const colours = Object.fromEntries(strip.map((s) => [s.rung, s.colour]));
      assert.equal(new Set(Object.values(colours)).size, Object.keys(colours).length);
      await page.screenshot({ path: join(out, 'unverified.png'), fullPage: true });
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });

  test('has no such thing for other planners', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(report, '#t=2');
      assert.equal((await page.$$('#rungs i, .candidates')).length, 0);
      assert.ok(!(await page.isVisible('#rung-legend')));
      assert.ok(!(await page.isVisible('#candidates-key')));
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });
});
