// The charts over time, their shared cursor and their values at it.
(function (slalom) {
  'use strict';

  const { data, start, end, number } = slalom;
  const SVG = 'http://www.w3.org/2000/svg';
  const margin = { left: 42, right: 8, top: 6, bottom: 18 };
  const deg = 180 / Math.PI;
  const charts = [];
  let onSeek = () => {};
  /** The stretch of time that the charts show [s]. */
  const shown = { from: start, to: end };
  const SHORTEST = 0.1;

  const length = () => Math.max(shown.to - shown.from, 1e-9);

  /** Zooms all charts about a time, no further than the drive. */
  function zoomTime(factor, about) {
    const long = Math.min(Math.max(length() * factor, Math.min(SHORTEST, end - start)), end - start);
    const share = (about - shown.from) / length();
    shown.from = Math.min(Math.max(about - share * long, start), end - long);
    shown.to = shown.from + long;
    layout();
    moveTo(slalom.now || start);
  }

  function element(name, attributes, parent) {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes || {})) node.setAttribute(key, value);
    if (parent) parent.appendChild(node);
    return node;
  }

  const scaled = (values, factor) => values.map((v) => (v === null ? null : v * factor));
  const cubic = (c, u) => ((c[0] * u + c[1]) * u + c[2]) * u + c[3];

  /** What is drawn: one entry a chart. `planned` names a column of the plan with its factor. */
  function specifications() {
    const p = data.plant;
    const v = data.vehicle;
    const limit = (value, label, hard, side) => ({ value, label, hard, side });
    return [
      { what: 'Speed', symbol: 'ux', unit: 'm/s', digits: 2, series: [{ label: '', values: p.ux, colour: '--blue' }],
        limits: [limit(v.ux_max, 'bound')], planned: ['ux', 1] },
      { what: 'Acceleration', symbol: 'ax', unit: 'm/s²', digits: 2, series: [{ label: '', values: p.ax, colour: '--blue' }],
        limits: [{ values: p.ux.map((u) => cubic(v.ax_max, u)), label: 'limits at this speed' },
          { values: p.ux.map((u) => cubic(v.ax_min, u)) }], planned: ['ax', 1] },
      { what: 'Steering angle', symbol: 'sa', unit: '°, left positive', digits: 2, series: [{ label: '', values: scaled(p.sa, deg), colour: '--blue' }],
        limits: [limit(v.sa_max * deg, 'bound'), limit(-v.sa_max * deg)], zero: true, planned: ['sa', deg] },
      { what: 'Steering rate', symbol: 'sr', unit: '°/s', digits: 2, series: [{ label: '', values: scaled(p.sr, deg), colour: '--blue' }],
        limits: [limit(v.sr_max * deg, 'bound'), limit(-v.sr_max * deg)], zero: true, planned: ['sr', deg] },
      { what: 'Wheel loads', unit: 'kN', digits: 1, floor: 0,
        series: [['rl', '--blue', 'RL'], ['rr', '--vermilion', 'RR'], ['fl', '--green', 'FL'], ['fr', '--purple', 'FR']]
          .map(([key, colour, label]) => ({ label, values: scaled(p['Fz_' + key], 1e-3), colour })),
        limits: [limit(v.Fz_min / 1000, number(v.Fz_min, 0) + ' N, least in a plan'),
          limit(data.loop.Fz_failure / 1000, number(data.loop.Fz_failure, 0) + ' N, failure', true, 'left')] },
      { what: 'Clearance', unit: 'm beyond the crash edge', digits: 2, top: 20,
        series: [{ label: '', values: p.clearance, colour: '--blue' }],
        limits: [limit(0, 'crash', true)] },
      { what: 'Solve time', unit: 's, each cycle', digits: 3, bars: true, wide: true },
    ];
  }

  /** Least and greatest of what is drawn, widened to whole ticks. */
  function domain(spec) {
    let lo = Infinity;
    let hi = -Infinity;
    for (const s of spec.series) {
      for (const v of s.values) {
        if (v === null || !Number.isFinite(v)) continue;
        lo = Math.min(lo, v);
        hi = Math.max(hi, v);
      }
    }
    if (!(lo <= hi)) { lo = 0; hi = 1; }
    if (spec.top !== undefined) hi = Math.max(Math.min(hi, spec.top), Math.min(lo, spec.top) + 1);
    if (spec.floor !== undefined) lo = Math.min(lo, spec.floor);
    if (spec.zero) { lo = Math.min(lo, 0); hi = Math.max(hi, 0); }
    for (const l of spec.limits) {
      // A limit that is near what was driven comes into the picture; a far one stays outside.
      const values = l.values || [l.value];
      const span = Math.max(hi - lo, 1e-3);
      for (const v of values) {
        if (v > hi && v - hi < 0.6 * span) hi = v;
        if (v < lo && lo - v < 0.6 * span) lo = v;
      }
    }
    const pad = Math.max((hi - lo) * 0.06, 1e-3 * Math.max(Math.abs(hi), 1e-3));
    return [spec.floor !== undefined && lo === spec.floor ? lo : lo - pad, hi + pad];
  }

  class Chart {
    constructor(spec, parent) {
      this.spec = spec;
      this.figure = document.createElement('figure');
      this.figure.className = 'chart card' + (spec.wide ? ' wide' : '');
      const caption = document.createElement('figcaption');
      caption.innerHTML = `<span class="what">${spec.what}${spec.symbol ? ` <span class="unit">${spec.symbol}</span>` : ''} <span class="unit">[${spec.unit}]</span></span><span class="values"></span>`;
      this.figure.appendChild(caption);
      this.values = caption.querySelector('.values');
      this.svg = element('svg', { role: 'img', 'aria-label': this.describe() }, null);
      this.figure.appendChild(this.svg);
      parent.appendChild(this.figure);
      this.listen();
    }

    describe() {
      const { spec } = this;
      if (spec.bars) return `${spec.what} of each planning cycle beside the execution horizon of ${data.loop.tex} s`;
      const all = spec.series.flatMap((s) => s.values).filter((v) => v !== null);
      if (!all.length) return `${spec.what} over time, empty`;
      const lo = all.reduce((a, b) => Math.min(a, b));
      const hi = all.reduce((a, b) => Math.max(a, b));
      return `${spec.what} over time, from ${number(lo, spec.digits)} to ${number(hi, spec.digits)} ${spec.unit}`;
    }

    x(t) {
      return margin.left + ((t - shown.from) / length()) * (this.width - margin.left - margin.right);
    }

    y(v) {
      const [lo, hi] = this.range;
      const w = this.log ? Math.log(Math.max(v, lo) / lo) / Math.log(hi / lo) : (v - lo) / (hi - lo);
      return this.height - margin.bottom - w * (this.height - margin.top - margin.bottom);
    }

    layout() {
      const rect = this.svg.getBoundingClientRect();
      this.width = Math.max(rect.width, 120);
      this.height = Math.max(rect.height, 60);
      this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
      this.svg.replaceChildren();
      this.prepare();
      this.axes();
      const id = 'clip-' + charts.indexOf(this);
      const clip = element('clipPath', { id }, element('defs', {}, this.svg));
      element('rect', { x: margin.left, y: margin.top - 2, width: this.width - margin.left - margin.right,
        height: this.height - margin.top - margin.bottom + 4 }, clip);
      this.plot = element('g', { 'clip-path': `url(#${id})` }, this.svg);
      this.events();
      this.content();
      this.cursor = element('g', { class: 'cursor' }, this.svg);
      element('line', { y1: margin.top, y2: this.height - margin.bottom }, this.cursor);
      this.dots = (this.spec.series || []).map((s) => element('circle', { r: 3.5, style: `fill:var(${s.colour})` }, this.cursor));
    }

    prepare() {
      this.log = false;
      this.range = domain(this.spec);
    }

    axes() {
      const bottom = this.height - margin.bottom;
      const marks = this.yTicks();
      for (const v of marks) {
        const y = Math.round(this.y(v)) + 0.5;
        element('line', { class: 'grid', x1: margin.left, x2: this.width - margin.right, y1: y, y2: y }, this.svg);
        element('text', { x: margin.left - 6, y: y + 3.5, 'text-anchor': 'end' }, this.svg).textContent = this.tickText(v, marks);
      }
      const times = slalom.ticks(shown.from, shown.to, Math.max(Math.round(this.width / 75), 2));
      for (const t of times) {
        const x = Math.round(this.x(t)) + 0.5;
        element('line', { class: 'grid', x1: x, x2: x, y1: margin.top, y2: bottom }, this.svg);
        element('text', { x, y: bottom + 13, 'text-anchor': 'middle' }, this.svg).textContent = Number(t.toFixed(3)) + (t === times[times.length - 1] ? ' s' : '');
      }
      element('line', { class: 'axis', x1: margin.left, x2: this.width - margin.right, y1: bottom + 0.5, y2: bottom + 0.5 }, this.svg);
    }

    yTicks() {
      return slalom.ticks(this.range[0], this.range[1], Math.max(Math.round(this.height / 38), 2));
    }

    tickText(v, marks) {
      return number(v, Math.max(0, -Math.floor(Math.log10(marks.step || 1) + 1e-9)));
    }

    events() {
      const mark = (t, kind) => element('line', { class: 'event ' + kind, x1: this.x(t), x2: this.x(t), y1: margin.top, y2: this.height - margin.bottom }, this.plot);
      if (data.goal_time !== null) mark(data.goal_time, 'goal');
      if (data.outcome !== 'goal' && data.plant.t.length) mark(end, 'bad');
    }

    path(times, values) {
      let d = '';
      let pen = 'M';
      for (let i = 0; i < times.length; ++i) {
        if (values[i] === null || values[i] === undefined) { pen = 'M'; continue; }
        d += `${pen}${this.x(times[i]).toFixed(1)} ${this.y(values[i]).toFixed(1)}`;
        pen = 'L';
      }
      return d;
    }

    content() {
      const { spec } = this;
      for (const l of spec.limits) {
        const values = l.values || data.plant.t.map(() => l.value);
        element('path', { class: 'limit' + (l.hard ? ' hard' : ''), d: this.path(data.plant.t, values) }, this.plot);
      }
      // Under the curves: a limit is named where a curve comes near it.
      for (const l of spec.limits) if (l.label) this.limitLabel(l);
      this.planned = element('path', { class: 'planned' }, this.plot);
      for (const s of spec.series) {
        element('path', { class: 'series', style: `stroke:var(${s.colour})`, d: this.path(data.plant.t, s.values) }, this.plot);
      }
    }

    limitLabel(l) {
      const last = l.values ? l.values[l.values.length - 1] : l.value;
      if (last === undefined || last < this.range[0] || last > this.range[1]) return;
      const y = this.y(last);
      const below = y - margin.top < 14;
      const left = l.side === 'left';
      element('text', { class: 'limit-label', x: left ? margin.left + 4 : this.width - margin.right - 3,
        y: below ? y + 11 : y - 3, 'text-anchor': left ? 'start' : 'end' }, this.plot)
        .textContent = l.label;
    }

    moveTo(t) {
      const { spec } = this;
      const sample = { t: data.plant.t };
      spec.series.forEach((s, i) => { sample[i] = s.values; });
      const at = slalom.sampleAt(sample, t);
      const x = this.x(t);
      this.placeCursor(t);
      const inside = t >= shown.from && t <= shown.to;
      spec.series.forEach((s, i) => {
        const v = at ? at[i] : null;
        const dot = this.dots[i];
        const seen = inside && v !== null && v <= this.range[1] && v >= this.range[0];
        dot.setAttribute('visibility', seen ? 'visible' : 'hidden');
        if (seen) { dot.setAttribute('cx', x); dot.setAttribute('cy', this.y(v)); }
      });
      this.values.innerHTML = spec.series.map((s, i) =>
        `<span>${s.label ? `<em style="color:var(${s.colour})">${s.label}</em> ` : ''}<b>${number(at ? at[i] : null, spec.digits)}</b></span>`).join('');
      this.showPlan(slalom.cycleAt(t));
    }

    placeCursor(t) {
      this.cursor.setAttribute('visibility', t < shown.from || t > shown.to ? 'hidden' : 'visible');
      for (const end of ['x1', 'x2']) this.cursor.firstChild.setAttribute(end, this.x(t));
    }

    showPlan(cycle) {
      if (!this.spec.planned || cycle === this.shownPlan) return;
      this.shownPlan = cycle;
      const [name, factor] = this.spec.planned;
      this.planned.setAttribute('d', cycle ? this.path(cycle.plan.t.map((s) => s + cycle.plan.t_start), scaled(cycle.plan[name], factor)) : '');
    }

    listen() {
      let down = false;
      const timeAt = (event) => {
        const rect = this.svg.getBoundingClientRect();
        const w = (event.clientX - rect.left - margin.left) / Math.max(rect.width - margin.left - margin.right, 1);
        return shown.from + Math.min(Math.max(w, 0), 1) * length();
      };
      const seek = (event) => onSeek(timeAt(event));
      this.svg.addEventListener('wheel', (event) => {
        if (!event.shiftKey) return;  // the page scrolls
        event.preventDefault();
        zoomTime(Math.exp((event.deltaY || event.deltaX) * 0.0015), timeAt(event));
      }, { passive: false });
      this.svg.addEventListener('dblclick', () => zoomTime(Infinity, start));
      this.svg.addEventListener('pointerdown', (event) => {
        down = true;
        this.svg.setPointerCapture(event.pointerId);
        event.preventDefault();
        seek(event);
      });
      this.svg.addEventListener('pointermove', (event) => { if (down) seek(event); });
      for (const name of ['pointerup', 'pointercancel']) this.svg.addEventListener(name, () => { down = false; });
    }
  }

  /** Solve time of each cycle as a bar over the time it ran in, beside the execution horizon. */
  class SolveChart extends Chart {
    prepare() {
      this.cycles = data.cycles.filter((c) => c.index > 0);
      const times = this.cycles.map((c) => c.wall).filter((v) => v > 0);
      const least = times.reduce((a, b) => Math.min(a, b), Infinity);
      const most = times.reduce((a, b) => Math.max(a, b), data.loop.tex);
      this.log = times.length > 0 && most / least > 8;
      this.range = this.log ? [Math.pow(10, Math.floor(Math.log10(least) - 0.15)), most * 1.6] : [0, most * 1.18];
    }

    yTicks() {
      if (!this.log) return super.yTicks();
      const out = [];
      const [lo, hi] = this.range;
      const each = hi / lo < 50 ? [1, 2, 5] : [1];
      for (let k = Math.floor(Math.log10(lo)); k <= Math.ceil(Math.log10(hi)); ++k) {
        for (const m of each) if (m * 10 ** k >= lo * 0.999 && m * 10 ** k <= hi) out.push(m * 10 ** k);
      }
      return out;
    }

    tickText(v, marks) {
      if (!this.log) return super.tickText(v, marks);
      return v < 1e-4 ? v.toExponential(0).replace('-', '−') : String(Number(v.toPrecision(1)));
    }

    content() {
      const bottom = this.height - margin.bottom;
      this.bars = this.cycles.map((c) => {
        const x0 = this.x(c.t0);
        const x1 = this.x(Math.min(c.t0 + c.tex, end));
        const y = Math.min(this.y(c.wall), bottom - 1);
        return element('rect', { x: x0 + 0.5, width: Math.max(x1 - x0 - 1, 1), y, height: bottom - y,
          class: c.solved ? 'bar' : 'bar bad' }, this.plot);
      });
      const y = this.y(data.loop.tex);
      element('line', { class: 'limit hard', x1: margin.left, x2: this.width - margin.right, y1: y, y2: y }, this.plot);
      element('text', { class: 'limit-label', x: this.width - margin.right - 3, y: y - 3, 'text-anchor': 'end' }, this.svg)
        .textContent = `execution horizon tex ${data.loop.tex} s`;
    }

    moveTo(t) {
      this.placeCursor(t);
      const current = slalom.solvingAt(t);
      this.bars.forEach((bar, i) => bar.classList.toggle('now', this.cycles[i] === current));
      this.values.innerHTML = current
        ? `<span>cycle ${current.index} <b>${number(current.wall, 3)}</b></span><span class="unit">CPU ${number(current.cpu, 3)}</span>`
        : '<span>–</span>';
    }
  }

  function build(seek) {
    onSeek = seek;
    const parent = document.getElementById('charts');
    for (const spec of specifications()) charts.push(new (spec.bars ? SolveChart : Chart)(spec, parent));
    layout();
    new ResizeObserver(() => { layout(); moveTo(slalom.now || start); }).observe(parent);
  }

  function layout() {
    for (const chart of charts) { chart.shownPlan = undefined; chart.layout(); }
  }

  function moveTo(t) {
    for (const chart of charts) chart.moveTo(t);
  }

  slalom.charts = { build, moveTo };
})(window.slalom = window.slalom || {});
