// The pages in a real browser: they play, their parts agree, they ask for nothing.
//
//   SLALOM_DRIVE_DIR      a drive's folder; else one is made by `slalom simulate E_B --planner P_D`
//   SLALOM_OTHER_DIR      the same with P_A, to compare
//   SLALOM_VERIFIED_DIR   the same with P_E in E_C, whose plans are verified
//   SLALOM_SHAPES_DIR    a drive past obstacles of every shape and motion
//   SLALOM_REPRODUCE_DIR  a reproduction's folder; else one is made by `slalom reproduce`
//   SLALOM_SWEEP_DIR      a sweep's folder; else one of a small study is made
//   SLALOM                the program, for making them
//   SLALOM_TEST_DIR       where screenshots go
import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { lookAt, openBrowser } from './browser.mjs';
import './blockers.mjs';
import './compare.mjs';
import { legibility } from './legibility.mjs';
import './long.mjs';
import { changedPage, driveDir, made, out, report, slalom, textOf, timeOf, until, valuesOf } from './pages.mjs';
import './shapes.mjs';
import './signals.mjs';
import './verified.mjs';

/** A study of eight short drives over tex and the speed of O2, as the paper's. */
function smallStudy() {
  const file = join(out, 'small.yaml');
  writeFileSync(file, `scenario: E_C
planners: [P_C, P_D]
set: {loop.timeout: 1, goal.y: 20}
axes:
  - {key: loop.tex, values: [0.25, 0.5]}
  - {key: obstacles.O2.vy, values: [0, -10]}
`);
  return file;
}

const sweepDir = made('SLALOM_SWEEP_DIR', 'sweep', ['sweep', smallStudy()]);
if (process.env.SLALOM) slalom('study-report', sweepDir, '--trial', '2');
const reproduceDir = made('SLALOM_REPRODUCE_DIR', 'reproduce', ['reproduce']);

const cursorsOf = (page) => page.$$eval('.chart .cursor line', (all) => all.map((l) => Number(l.getAttribute('x1'))));

/** Moves the slider to a share of its length, as a person does. */
async function moveSlider(page, share) {
  const box = await (await page.$('#time')).boundingBox();
  await page.mouse.click(box.x + 8 + (box.width - 16) * share, box.y + box.height / 2);
}

describe('the page of a drive', () => {
  let browser;
  let page;
  let complaints;
  before(async () => {
    browser = await openBrowser();
    ({ page, complaints } = await browser.open(report));
  });
  after(async () => browser.close());

  test('says how the drive went', async () => {
    assert.match(await textOf(page, 'h1'), /E_B\s+with\s+P_D/);
    assert.ok((await textOf(page, '.outcome')).length > 3);
    assert.equal((await page.$$('.chart')).length, 7);
  });

  test('shows vehicle, obstacles and goal', async () => {
    await page.click('#view-course');
    const seen = await lookAt(page, ['blue', 'vermilion', 'orange']);
    assert.ok(seen.colours > 20, `only ${seen.colours} colours`);
    assert.ok(seen.vermilion.count > 200, 'no obstacle');
    assert.ok(seen.blue.count > 20, `no vehicle: ${seen.blue.count} pixels`);
  });

  test('moves with the slider: picture, time, plan and charts', async () => {
    const wasSeen = await lookAt(page, ['blue']);
    const wasText = await textOf(page, '#time-text');
    const wasValues = await valuesOf(page);
    const wasCursors = await cursorsOf(page);
    const wasPlan = await textOf(page, '#cycle');
    await moveSlider(page, 0.5);

    const t = await timeOf(page);
    const end = Number(await page.getAttribute('#time', 'max'));
    assert.ok(Math.abs(t - end / 2) < 0.05 * end, `at ${t} of ${end}`);
    assert.notEqual(await textOf(page, '#time-text'), wasText);
    assert.ok((await textOf(page, '#time-text')).startsWith(t.toFixed(2)));
    const seen = await lookAt(page, ['blue', 'orange']);
    // The vehicle drives north: up the canvas, with its path behind it.
    assert.ok(wasSeen.blue.y - seen.blue.y > 30, 'the vehicle did not move');
    assert.ok(seen.orange.count > 60, 'no plan');
    const values = await valuesOf(page);
    const changed = values.filter((v, i) => v !== wasValues[i]).length;
    assert.ok(changed >= 6, `only ${changed} charts changed their values`);
    (await cursorsOf(page)).forEach((x, i) => assert.ok(x > wasCursors[i] + 20, `cursor ${i} stayed`));
    assert.notEqual(await textOf(page, '#cycle'), wasPlan);
  });

  test('a click on a chart goes to that time', async () => {
    const box = await (await page.$('.chart svg')).boundingBox();
    await page.mouse.move(box.x + box.width * 0.3, box.y + 40);
    await page.mouse.down();
    const first = await timeOf(page);
    await page.mouse.move(box.x + box.width * 0.8, box.y + 40, { steps: 4 });
    await page.mouse.up();
    const second = await timeOf(page);
    const end = Number(await page.getAttribute('#time', 'max'));
    assert.ok(first > 0.1 * end && first < 0.35 * end, `clicked to ${first}`);
    assert.ok(second > 0.65 * end && second < 0.95 * end, `dragged to ${second}`);
  });

  test('answers to keys', async () => {
    await page.keyboard.press('Home');
    assert.equal(await timeOf(page), 0);
    await page.keyboard.press('ArrowRight');
    assert.ok(Math.abs((await timeOf(page)) - 0.1) < 1e-9);
    await page.keyboard.press('Shift+ArrowRight');
    assert.ok(Math.abs((await timeOf(page)) - 0.5) < 1e-6, 'the first plan takes over at tex');
    await page.keyboard.press('End');
    assert.ok(Math.abs((await timeOf(page)) - Number(await page.getAttribute('#time', 'max'))) < 1e-6);
  });

  test('plays and pauses', async () => {
    await page.keyboard.press('Home');
    await page.selectOption('#speed', '2');
    await page.click('#play');
    await until(async () => (await timeOf(page)) > 0.4);
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
    await page.keyboard.press(' ');
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
    const stopped = await timeOf(page);
    await page.waitForTimeout(150);
    assert.equal(await timeOf(page), stopped);
  });

  test('zooms, pans and follows', async () => {
    await page.click('#view-follow');
    const box = await (await page.$('#stage')).boundingBox();
    const before = await lookAt(page, ['blue']);
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.wheel(0, -600);
    assert.ok((await lookAt(page, ['blue'])).blue.count > 1.2 * before.blue.count, 'did not zoom in');
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 60, { steps: 4 });
    await page.mouse.up();
    assert.equal(await page.getAttribute('#view-follow', 'aria-pressed'), 'false');
    await page.keyboard.press('f');
    assert.equal(await page.getAttribute('#view-follow', 'aria-pressed'), 'true');
  });

  test('zooms the charts in time', async () => {
    const ticks = () => page.$$eval('.chart:first-child text', (all) => all.map((t) => t.textContent).join(' '));
    const before = await ticks();
    const box = await (await page.$('.chart:first-child svg')).boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.keyboard.down('Shift');
    await page.mouse.wheel(0, -900);
    await page.keyboard.up('Shift');
    await until(async () => (await ticks()) !== before);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    const middle = await timeOf(page);
    assert.ok(Math.abs(middle - Number(await page.getAttribute('#time', 'max')) / 2) < 0.8, `at ${middle} s`);
    await page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
    assert.equal(await ticks(), before);
  });

  test('hides what is switched off', async () => {
    await moveSlider(page, 0.5);
    const shown = await lookAt(page, ['orange']);
    await page.uncheck('#layer-plan');
    assert.ok((await lookAt(page, ['orange'])).orange.count < shown.orange.count / 2);
    await page.check('#layer-plan');
  });

  test('complains of nothing and asks for nothing', async () => {
    await page.screenshot({ path: join(out, 'drive-light.png') });
    assert.deepEqual(complaints, []);
  });
});

describe('the page of a drive on other screens', () => {
  for (const [name, options] of Object.entries({
    dark: { colorScheme: 'dark' },
    laptop: { width: 1280, height: 720 },
    narrow: { width: 600, height: 900 },
  })) {
    test(name, async () => {
      const browser = await openBrowser(options);
      try {
        const { page, complaints } = await browser.open(report, '#t=2');
        assert.ok(Math.abs((await timeOf(page)) - 2) < 1e-9, 'the address names the time');
        const seen = await lookAt(page, ['blue', 'vermilion', 'orange']);
        assert.ok(seen.blue.count > 40 && seen.vermilion.count > 200 && seen.orange.count > 60);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(wide <= 0, `${wide} pixels too wide`);
        await page.screenshot({ path: join(out, `drive-${name}.png`), fullPage: true });
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});

describe('the page of a drive from west to east', () => {
  /** The drive turned by a quarter: x is y, and y is -x. */
  const turned = (data) => {
    const turn = (o, names) => {
      for (const [x, y] of names) if (o[x] !== undefined) {
        const minus = Array.isArray(o[x]) ? o[x].map((v) => -v) : -o[x];
        [o[x], o[y]] = [o[y], minus];
      }
    };
    for (const part of [data.start, data.goal, data.plant, ...data.cycles.map((c) => c.plan), ...data.obstacles]) {
      turn(part, [['x', 'y'], ['vx', 'vy']]);
      if (part.psi) part.psi = Array.isArray(part.psi) ? part.psi.map((v) => v - Math.PI / 2) : part.psi;
    }
    data.region = { x_min: null, x_max: null, y_min: null, y_max: null };
    data.marks = [{ kind: 'wheel_load', text: 'a mark', times: [1, 3] }];
  };

  test('has a stage that is wider than high, above the charts, and margins that can be drawn', async () => {
    const browser = await openBrowser();
    try {
      const { page, complaints } = await browser.open(changedPage('east', turned), '#t=2');
      const stage = await (await page.$('#stage')).boundingBox();
      const charts = await (await page.$('#charts')).boundingBox();
      assert.ok(stage.width > 2 * stage.height && stage.y + stage.height <= charts.y);
      const before = await lookAt(page, ['vermilion']);
      await page.check('#layer-margins');
      assert.ok((await lookAt(page, ['vermilion'])).vermilion.count > before.vermilion.count);
      assert.equal((await page.$$('#marks i[title="a mark"]')).length, 2);
      await page.screenshot({ path: join(out, 'east.png'), fullPage: true });
      assert.deepEqual(complaints, []);
    } finally {
      await browser.close();
    }
  });
});

describe('the page of an odd drive', () => {
  const cut = (data, n) => {
    for (const name of Object.keys(data.plant)) data.plant[name].length = n;
  };
  for (const [name, change] of Object.entries({
    'nothing-driven': (d) => { cut(d, 0); d.cycles = []; d.goal_time = null; d.least_clearance_t = null; },
    'one-sample': (d) => { cut(d, 1); d.cycles = []; },
    'no-obstacles': (d) => { d.obstacles = []; d.plant.clearance.fill(null); d.least_clearance_t = null; },
    'empty-plan': (d) => {
      d.outcome = 'not_optimal';
      const last = d.cycles[d.cycles.length - 1];
      Object.assign(last, { solved: false, used: false, cost: null, wall: null, violation: null, terms: [] });
      for (const key of Object.keys(last.plan)) if (Array.isArray(last.plan[key])) last.plan[key] = [];
    },
  })) {
    test(name, async () => {
      const browser = await openBrowser();
      try {
        const { page, complaints } = await browser.open(changedPage(name, change));
        await page.click('#view-course');
        for (const key of ['End', 'Home', 'ArrowRight', ' ', ' ']) await page.keyboard.press(key);
        await page.click('#view-follow');
        const values = (await valuesOf(page)).join(' ');
        assert.ok(!/NaN|undefined|Infinity/.test(values), values);
        const drawn = await page.$$eval('.chart svg', (all) => all.map((s) => s.outerHTML).join(''));
        assert.ok(!/NaN|undefined|Infinity/.test(drawn), 'a chart has coordinates that are no numbers');
        assert.ok((await lookAt(page, ['blue'])).colours > 2);
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});

describe('the page of the reproduction', () => {
  for (const colorScheme of ['light', 'dark']) {
    test(colorScheme, async () => {
      const browser = await openBrowser({ colorScheme, width: 1280, height: 900 });
      try {
        const { page, complaints } = await browser.open(join(reproduceDir, 'index.html'));
        assert.ok((await page.$$('table')).length >= 6);
        const figures = await page.$$eval('.figure svg', (all) => all.map((s) => s.getBoundingClientRect().height));
        assert.ok(figures.length >= 8 && figures.every((h) => h > 100), String(figures));
        const links = await page.$$eval('a[href]', (all) => all.map((a) => a.getAttribute('href').split('#')[0]));
        for (const link of new Set(links.filter((l) => l !== ''))) {
          assert.ok(existsSync(join(reproduceDir, link)), `no ${link}`);
        }
        await page.screenshot({ path: join(out, `reproduction-${colorScheme}.png`), fullPage: true });
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});

describe('the page of a sweep', () => {
  for (const colorScheme of ['light', 'dark']) {
    test(colorScheme, async () => {
      const browser = await openBrowser({ colorScheme, width: 1280, height: 900 });
      try {
        const { page, complaints } = await browser.open(join(sweepDir, 'index.html'));
        assert.ok((await page.$$('table')).length >= 5);
        const figures = await page.$$eval('.figure svg', (all) => all.map((s) => s.getBoundingClientRect().height));
        assert.ok(figures.length === 3 && figures.every((h) => h > 100), String(figures));
        const links = await page.$$eval('a[href]', (all) => all.map((a) => a.getAttribute('href').split('#')[0]));
        for (const link of new Set(links.filter((l) => l !== ''))) {
          assert.ok(existsSync(join(sweepDir, link)), `no ${link}`);
        }
        await page.click('summary >> nth=1');
        assert.ok(await page.isVisible('details >> nth=1 >> table'));
        await page.click('[data-mark="2"]');
        assert.match(await page.textContent('dialog'), /Trial 2.*planner.*P_C.*obstacles.O2.vy.*10/s);
        assert.equal(await page.getAttribute('dialog a.open', 'href'), 'drives/000002/report.html');
        await page.screenshot({ path: join(out, `sweep-trial-${colorScheme}.png`) });
        await page.click('dialog button');
        await page.focus('[data-mark="3"]');
        await page.keyboard.press('Enter');
        assert.match(await page.textContent('dialog'), /Trial 3.*was not kept.*--trial 3/s);
        await page.keyboard.press('Escape');
        assert.ok(!(await page.isVisible('dialog')));
        await page.screenshot({ path: join(out, `sweep-${colorScheme}.png`), fullPage: true });
        assert.deepEqual(complaints, []);
      } finally {
        await browser.close();
      }
    });
  }
});

describe('figures for print', () => {
  const folders = [driveDir, reproduceDir, sweepDir, join(reproduceDir, 'E_A', 'P_A'),
    join(reproduceDir, 'E_C', 'P_C')].map((folder) => join(folder, 'figures'));
  const files = folders.flatMap((f) => readdirSync(f).filter((n) => n.endsWith('.svg')).map((n) => join(f, n)));

  test('are pictures without scripts', async () => {
    assert.ok(files.length >= 14, `${files.length} figures`);
    const browser = await openBrowser();
    try {
      for (const file of files) {
        assert.ok(statSync(file).size > 500, file);
        assert.ok(!readFileSync(file, 'utf8').includes('<script'), file);
        const { page, complaints } = await browser.open(file);
        const shapes = await page.evaluate(() => document.querySelectorAll('polyline, ellipse, line').length);
        assert.ok(shapes > 5, `${file}: ${shapes} shapes`);
        assert.deepEqual(complaints, [], file);
        const { font, line, overlaps, outside } = await legibility(page);
        assert.ok(font >= 6 - 1e-3, `${file}: letters of ${font} pt in print`);
        assert.ok(line >= 0.3, `${file}: a line of ${line} pt in print`);
        assert.deepEqual({ overlaps, outside }, { overlaps: [], outside: [] }, file);
        await page.close();
      }
    } finally {
      await browser.close();
    }
  });

  test('are judged by what can be read of them', async () => {
    const words = (size, x) => `<text x="${x}" y="50" font-size="${size}">solve time</text>`;
    const file = join(out, 'illegible.svg');
    writeFileSync(file, `<svg xmlns="http://www.w3.org/2000/svg" width="226.77pt" height="50pt"
      viewBox="0 0 453.54 100">${words(10, 5)}${words(20, 30)}${words(20, 440)}
      <line x1="0" y1="0" x2="9" y2="9" stroke="#000" stroke-width="0.5"/></svg>`);
    const browser = await openBrowser();
    try {
      const { page } = await browser.open(file);
      const { font, line, overlaps, outside } = await legibility(page);
      assert.ok(Math.abs(font - 5) < 1e-3 && Math.abs(line - 0.25) < 1e-3, `${font}, ${line}`);
      assert.equal(overlaps.length, 1);
      assert.deepEqual(outside, ['solve time']);
    } finally {
      await browser.close();
    }
  });
});
