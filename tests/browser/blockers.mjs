// The obstacle that a plan does not get past is ringed on the stage.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { describe, test } from 'node:test';
import { lookAt, openBrowser } from './browser.mjs';
import { changedPage, out, report, textOf, verifiedDir } from './pages.mjs';

/** How many pixels of a ring, and what is written on the stage, at t. */
async function ringAt(page, t) {
  const words = await page.evaluate((at) => {
    const said = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function note(text, ...rest) {
      said.push(text);
      return fillText.call(this, text, ...rest);
    };
    const slider = document.getElementById('time');
    slider.value = String(at);
    slider.dispatchEvent(new Event('input'));
    CanvasRenderingContext2D.prototype.fillText = fillText;
    return said.filter((w) => w.endsWith('in the way'));
  }, t);
  return { words, ...(await lookAt(page, ['ink'])).ink };
}

/** Looks at a page in the view of the whole course. */
async function on(file, look) {
  const browser = await openBrowser();
  try {
    const { page, complaints } = await browser.open(file);
    await page.click('#view-course');
    await look(page);
    assert.deepEqual(complaints, []);
  } finally {
    await browser.close();
  }
}

describe('the obstacle in the way of a plan', () => {
  const blocks = 'O<1> in the way: node 3 of the plan comes 1.00 m inside its edge';
  const blocker = { name: 'O<1>', t: 3 };

  /** One cycle in the middle of the drive fails; the last plan is driven on. */
  const failed = (data) => {
    data.obstacles[0].name = 'O<1>';
    Object.assign(data.cycles[5], { solved: false, used: false, status: 'infeasible', blocks, blocker });
  };

  test('is ringed while the vehicle drives on without the plan that failed', () => on(changedPage('failed', failed), async (page) => {
    const { data } = await page.evaluate(() => window.slalom.drives[0]);
    const [cycle, next] = [data.cycles[5], data.cycles[6]];
    const before = await ringAt(page, cycle.t0 + cycle.tex - 0.1);
    assert.deepEqual([before.count, before.words.length], [0, 0]);
    assert.ok(!(await textOf(page, '#cycle')).includes('was not solved'));
    const during = await ringAt(page, (cycle.t_swap + next.t_swap) / 2);
    assert.ok(during.count > 20, `${during.count} pixels`);
    assert.deepEqual(during.words, ['O<1> in the way']);
    assert.ok((await textOf(page, '#cycle')).includes(`Cycle ${cycle.index} was not solved, infeasible: ${blocks}`));
    const place = await page.evaluate((t) => {
      const o = window.slalom.obstacleAt(window.slalom.drives[0].data.obstacles[0], t);
      return window.slalom.stage.pixelOf(o.x, o.y);
    }, (cycle.t_swap + next.t_swap) / 2);
    assert.ok(Math.abs(during.y - place[1]) < 30, `the ring is at ${during.y}, the obstacle at ${place[1]}`);
    await page.screenshot({ path: join(out, 'blocker.png') });
    assert.equal((await ringAt(page, next.t_swap + 0.1)).count, 0);
    assert.ok(await page.isVisible('#blocker-key'));
  }));

  test('is ringed at the end of a drive that ends so', () => on(changedPage('failed-last', (data) => {
    failed(data);
    data.outcome = 'not_optimal';
    const keep = data.plant.t.filter((t) => t <= data.cycles[5].t_swap + 1e-9).length;
    for (const column of Object.values(data.plant)) column.length = keep;
    data.cycles.length = 6;
  }), async (page) => {
    const end = await page.evaluate(() => window.slalom.span.end);
    assert.deepEqual((await ringAt(page, end)).words, ['O<1> in the way']);
  }));

  test('is ringed while a plan is driven that does not get past it', () => on(changedPage('least-bad', (data) => {
    const cycle = data.cycles[10];
    cycle.rung = 'least_bad';
    cycle.solved = false;
    cycle.blocker = { name: 'O2', t: cycle.t_swap + 2 };
  }, join(verifiedDir, 'report.html')), async (page) => {
    const { data } = await page.evaluate(() => window.slalom.drives[0]);
    const ring = await ringAt(page, data.cycles[10].t_swap + 0.1);
    assert.deepEqual(ring.words, ['O2 in the way']);
    assert.ok(ring.count > 20, 'where it is, and where it will be');
  }));

  test('there is none', () => on(report, async (page) => {
    assert.equal((await ringAt(page, 2)).count, 0);
    assert.ok(!(await page.isVisible('#blocker-key')));
  }));
});
