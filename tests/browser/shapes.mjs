// Obstacles of every shape and motion on the page: where they are, how they look, what they are called.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { lookAt, openBrowser } from './browser.mjs';
import { made, out } from './pages.mjs';

const file = join(out, 'shapes.yaml');
writeFileSync(file, `start: {x: 0, y: 0, psi_deg: 90, ux: 12}
goal: {x: 0, y: 300}
vehicle: {base: hmmwv, footprint: rectangle}
planner: P_D
loop: {timeout: 3}
obstacles:
  - {name: van, x: 12, y: 20, length: 12, width: 4, psi_deg: 30}
  - {name: rock, x: -12, y: 20, polygon: [[-4, -3], [5, -3], [0, 5]], vx: -0.5}
  - {name: egg, x: 14, y: 50, a: 6, b: 2, psi_deg: 90, margin_start: 0.5, margin_rate: 0.5}
  - {name: walker, r: 1, path: [[-20, 40], [-10, 40], [-10, 60]], speed: 5}
  - {name: ghost, length: 3, width: 3, before: absent, after: absent, table: [[1, 20, 30, 0], [2, 25, 30, 1]]}
`);
const shapesDir = made('SLALOM_SHAPES_DIR', 'shapes', ['simulate', file]);

/** The pixel of the canvas at a place of the world. */
const pixelOf = (page, x, y) => page.evaluate(([px, py]) => {
  const { left, top } = document.getElementById('stage').getBoundingClientRect();
  const [cx, cy] = window.slalom.stage.pixelOf(px, py);
  return [left + cx, top + cy];
}, [x, y]);

describe('the page of a drive past shapes of every kind', () => {
  let browser;
  let page;
  let complaints;
  before(async () => {
    browser = await openBrowser();
    ({ page, complaints } = await browser.open(join(shapesDir, 'report.html'), '#t=1.5'));
  });
  after(async () => browser.close());

  const titleAt = async (x, y) => {
    await page.mouse.move(...await pixelOf(page, x, y));
    return page.getAttribute('#stage', 'title');
  };

  test('obstacles are where their tables and paths have them, and absent else', async () => {
    const at = (name, t) => page.evaluate(([n, time]) => {
      const o = window.slalom.drives[0].data.obstacles.find((one) => one.name === n);
      return window.slalom.obstacleAt(o, time);
    }, [name, t]);
    const near = (p, x, y) => assert.ok(Math.hypot(p.x - x, p.y - y) < 0.03, JSON.stringify(p));
    near(await at('walker', 1.5), -12.5, 40);
    near(await at('walker', 2.6), -10, 43);
    assert.ok(Math.abs((await at('walker', 1)).vx - 5) < 0.1);
    near(await at('ghost', 1.5), 22.5, 30);
    assert.ok(Math.abs((await at('ghost', 1.5)).psi - 0.5) < 0.02);
    assert.equal(await at('ghost', 0.9), null);
    assert.equal(await at('ghost', 2.1), null);
  });

  test('the pointer finds each by its shape', async () => {
    await page.click('#view-course');
    assert.equal(await titleAt(12, 20), 'van');
    assert.equal(await titleAt(12 + 5 * Math.cos(Math.PI / 6), 20 + 5 * Math.sin(Math.PI / 6)), 'van');
    assert.equal(await titleAt(17, 14), '');
    assert.equal(await titleAt(-12.7, 23), 'rock, 0.5 m/s');
    assert.equal(await titleAt(-16, 24), '');
    assert.equal(await titleAt(14, 55), 'egg');
    assert.equal(await titleAt(21, 50), '');
    assert.match(await titleAt(-12.5, 40), /^walker, 5\.0 m\/s$/);
    assert.match(await titleAt(22.5, 30), /^ghost, [45]/);
  });

  test('they are drawn, and no longer when they are gone', async () => {
    await page.click('#view-course');
    const { vermilion } = await lookAt(page, ['vermilion']);
    assert.ok(vermilion.count > 200, String(vermilion.count));
    await page.screenshot({ path: join(out, 'shapes.png') });
    const count = async (t) => {
      await page.evaluate((time) => window.slalom.stage.draw(time), t);
      return (await lookAt(page, ['vermilion'])).vermilion.count;
    };
    assert.ok(await count(1.99) > await count(2.01) + 20);
    assert.deepEqual(complaints, []);
  });
});
