// The charts over time, their shared cursor and their values at it.
(function (slalom) {
  'use strict';

  const { drives, span, number, signals, offset, offsetText } = slalom;
  const SVG = 'http://www.w3.org/2000/svg';
  const margin = { left: 42, right: 8, top: 6, bottom: 18 };
  const charts = [];
  let onSeek = () => {};
  /** The stretch of time that the charts show [s]. */
  const shown = { from: span.start, to: span.end };
  const SHORTEST = 0.1;

  const length = () => Math.max(shown.to - shown.from, 1e-9);

  /** Zooms all charts about a time, no further than the drive. */
  function zoomTime(factor, about) {
    const { start, end } = span;
    const long = Math.min(Math.max(length() * factor, Math.min(SHORTEST, end - start)), end - start);
    const share = (about - shown.from) / length();
    shown.from = Math.min(Math.max(about - share * long, start), end - long);
    shown.to = shown.from + long;
    layout();
    moveTo(slalom.now);
  }

  function element(name, attributes, parent) {
    const node = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes || {})) node.setAttribute(key, value);
    if (parent) parent.appendChild(node);
    return node;
  }

  /** Least and greatest of what is drawn, widened to whole ticks. */
  function domain(spec, curves, limits) {
    let lo = Infinity;
    let hi = -Infinity;
    for (const { values } of curves) {
      for (const v of values) {
        if (v === null || !Number.isFinite(v)) continue;
        lo = Math.min(lo, v);
        hi = Math.max(hi, v);
      }
    }
    if (!(lo <= hi)) { lo = 0; hi = 1; }
    if (spec.top !== undefined) hi = Math.max(Math.min(hi, spec.top), Math.min(lo, spec.top) + 1);
    if (spec.floor !== undefined) lo = Math.min(lo, spec.floor);
    if (spec.zero) { lo = Math.min(lo, 0); hi = Math.max(hi, 0); }
    for (const l of limits) {
      // A limit that is near what was driven comes into the picture; a far one stays outside.
      const values = l.values || [l.value];
      const span = Math.max(hi - lo, 1e-3);
      for (const v of values) {
        if (v > hi && v - hi < 0.6 * span) hi = v;
        if (v < lo && lo - v < 0.6 * span) lo = v;
      }
    }
    const pad = Math.max((hi - lo) * 0.06, 1e-3 * Math.min(Math.max(Math.abs(hi), 1e-3), 1e3));
    return [spec.floor !== undefined && lo === spec.floor ? lo : lo - pad, hi + pad];
  }

  class Chart {
    constructor(spec, parent) {
      this.spec = spec;
      this.what = (drives.length > 1 && spec.comparedWhat) || spec.what;
      this.curves = signals.curves(spec);
      this.limits = signals.limits(spec);
      this.prepare();
      this.offset = this.log ? 0 : offset(...this.range);
      this.figure = document.createElement('figure');
      this.figure.className = 'chart card';
      const unit = `${spec.unit}${this.offset ? ', ' + offsetText(this.offset) : ''}`;
      const caption = document.createElement('figcaption');
      caption.innerHTML = `<span class="what">${this.what}${spec.symbol ? ` <span class="unit">${spec.symbol}</span>` : ''} <span class="unit">[${unit}]</span></span><span class="values"></span>`;
      this.figure.appendChild(caption);
      this.values = caption.querySelector('.values');
      this.svg = element('svg', { role: 'img', 'aria-label': this.describe() }, null);
      this.figure.appendChild(this.svg);
      parent.appendChild(this.figure);
      this.listen();
    }

    describe() {
      const { spec, what } = this;
      if (spec.bars) return `${what} of each planning cycle beside the execution horizon of ${drives[0].data.loop.tex} s`;
      const all = this.curves.flatMap((s) => s.values).filter((v) => v !== null);
      if (!all.length) return `${what} over time, empty`;
      const lo = all.reduce((a, b) => Math.min(a, b));
      const hi = all.reduce((a, b) => Math.max(a, b));
      return `${what} over time, from ${number(lo, spec.digits)} to ${number(hi, spec.digits)} ${spec.unit}`;
    }

    x(t) {
      return margin.left + ((t - shown.from) / length()) * (this.width - margin.left - margin.right);
    }

    y(v) {
      const [lo, hi] = this.range;
      const w = this.log ? Math.log(Math.max(v, lo) / lo) / Math.log(hi / lo) : (v - lo) / (hi - lo);
      return this.height - margin.bottom - w * (this.height - margin.top - margin.bottom);
    }

    measure() {
      const rect = this.svg.getBoundingClientRect();
      this.width = Math.max(rect.width, 120);
      this.height = Math.max(rect.height, 60);
    }

    layout() {
      this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
      this.svg.replaceChildren();
      this.shownPlans = [];
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
      this.dots = (this.asBars ? [] : this.curves).map((s) => element('circle', { r: 3.5, style: `fill:var(${s.colour})` }, this.cursor));
    }

    prepare() {
      this.log = false;
      this.range = domain(this.spec, this.curves, this.limits);
    }

    axes() {
      const bottom = this.height - margin.bottom;
      const marks = this.yTicks();
      for (const v of marks) {
        const y = Math.round(this.y(v + this.offset)) + 0.5;
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
      return slalom.ticks(this.range[0] - this.offset, this.range[1] - this.offset, Math.max(Math.round(this.height / 38), 2));
    }

    tickText(v, marks) {
      return number(v, Math.max(0, -Math.floor(Math.log10(marks.step || 1) + 1e-9)));
    }

    /** When each drive reached its goal, or ended otherwise. */
    events() {
      for (const drive of drives) {
        const { data, end } = drive;
        const mark = (t, usual) => element('line', { class: 'event', style: `stroke:var(--${drive.ink(usual)})`,
          x1: this.x(t), x2: this.x(t), y1: margin.top, y2: this.height - margin.bottom }, this.plot);
        if (data.goal_time !== null) mark(data.goal_time, 'green');
        if (data.outcome !== 'goal' && data.plant.t.length) mark(end, 'vermilion');
      }
    }

    /** The shown part of a curve. Of values in one half pixel, the first, least, greatest and last: others cannot be seen. */
    path(times, values) {
      let d = '';
      let pen = 'M';
      let column = null;
      const there = (i) => values[i] !== null && values[i] !== undefined;
      const line = (i) => {
        d += `${pen}${this.x(times[i]).toFixed(1)} ${this.y(values[i]).toFixed(1)}`;
        pen = 'L';
      };
      const close = () => {
        if (column) [...new Set([column.first, ...[column.least, column.most].sort((a, b) => a - b), column.last])].forEach(line);
        column = null;
      };
      const end = Math.min(slalom.lastAtOrBefore(times, shown.to) + 2, times.length);
      for (let i = Math.max(slalom.lastAtOrBefore(times, shown.from), 0); i < end; ++i) {
        if (!there(i)) { close(); pen = 'M'; continue; }
        const at = Math.floor(2 * this.x(times[i]));
        if (!column || column.at !== at) {
          close();
          column = { at, first: i, least: i, most: i, last: i };
        }
        if (values[i] < values[column.least]) column.least = i;
        if (values[i] > values[column.most]) column.most = i;
        column.last = i;
      }
      close();
      return d;
    }

    content() {
      for (const l of this.limits) {
        const times = l.values ? l.drive.data.plant.t : [span.start, span.end];
        element('path', { class: 'limit' + (l.hard ? ' hard' : ''), d: this.path(times, l.values || [l.value, l.value]) }, this.plot);
      }
      // Under the curves: a limit is named where a curve comes near it.
      this.limits.forEach((l, i) => { if (l.label && this.limits.findIndex((o) => o.label === l.label) === i) this.limitLabel(l); });
      this.planned = drives.map((drive) => element('path', { class: 'planned', style: `stroke:var(--${drive.ink('orange')})` }, this.plot));
      this.draw();
    }

    draw() {
      for (const { times, values, colour } of this.curves) {
        element('path', { class: 'series', style: `stroke:var(${colour})`, d: this.path(times, values) }, this.plot);
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
      this.placeCursor(t);
      const x = this.x(t);
      const inside = t >= shown.from && t <= shown.to;
      const at = this.curves.map((curve) => this.valueOf(curve, t));
      at.forEach((v, i) => {
        const dot = this.dots[i];
        const seen = inside && v !== null && v <= this.range[1] && v >= this.range[0];
        dot.setAttribute('visibility', seen ? 'visible' : 'hidden');
        if (seen) { dot.setAttribute('cx', x); dot.setAttribute('cy', this.y(v)); }
      });
      this.values.innerHTML = this.curves.map((s, i) =>
        `<span>${s.label ? `<em style="color:var(${s.colour})">${s.label}</em> ` : ''}<b>${number(at[i], this.spec.digits)}</b></span>`).join('');
      drives.forEach((drive, i) => this.showPlan(i, drive.cycleAt(t)));
    }

    /** A curve's value at t; none when its drive is over. */
    valueOf({ drive, times, values }, t) {
      if (drive.overAt(t)) return null;
      const at = slalom.sampleAt({ t: times, v: values }, t);
      return at && at.v;
    }

    placeCursor(t) {
      this.cursor.setAttribute('visibility', t < shown.from || t > shown.to ? 'hidden' : 'visible');
      for (const end of ['x1', 'x2']) this.cursor.firstChild.setAttribute(end, this.x(t));
    }

    showPlan(i, cycle) {
      if (!this.spec.planned || cycle === this.shownPlans[i]) return;
      this.shownPlans[i] = cycle;
      const [name, factor] = this.spec.planned;
      this.planned[i].setAttribute('d', cycle ? this.path(cycle.plan.t.map((s) => s + cycle.plan.t_start), signals.scaled(cycle.plan[name], factor)) : '');
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
      this.svg.addEventListener('dblclick', () => zoomTime(Infinity, span.start));
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

  /**
   * Solve time of each cycle over the time it ran in, beside the execution horizon: as bars, or as
   * curves where drives are compared.
   */
  class SolveChart extends Chart {
    get asBars() {
      return drives.length === 1;
    }

    prepare() {
      const times = this.curves.flatMap((c) => c.values).filter((v) => v > 0);
      const least = times.reduce((a, b) => Math.min(a, b), Infinity);
      const most = times.reduce((a, b) => Math.max(a, b), Math.max(...drives.map((d) => d.data.loop.tex)));
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

    draw() {
      if (!this.asBars) {
        super.draw();
        return;
      }
      const bottom = this.height - margin.bottom;
      const [{ clocked, end }] = drives;
      this.bars = new Map();
      let last = null;
      for (const c of clocked) {
        const x0 = this.x(c.t0);
        const x1 = this.x(Math.min(slalom.plannedUntil(c), end));
        if (x1 < margin.left || x0 > this.width - margin.right) continue;
        const y = Math.min(this.y(c.wall), bottom - 1);
        // Of several in one pixel, the highest.
        if (!last || last.at !== Math.floor(x0) || last.solved !== c.solved) {
          last = { at: Math.floor(x0), solved: c.solved, y: bottom, bar: element('rect', { x: x0 + 0.5,
            width: Math.max(x1 - x0 - 1, 1), class: c.solved ? 'bar' : 'bar bad' }, this.plot) };
        }
        if (y < last.y) {
          last.y = y;
          last.bar.setAttribute('y', y);
          last.bar.setAttribute('height', bottom - y);
        }
        this.bars.set(c, last.bar);
      }
    }

    moveTo(t) {
      if (!this.asBars) {
        super.moveTo(t);
        return;
      }
      this.placeCursor(t);
      const current = drives[0].solvingAt(t);
      this.bars.get(this.now)?.classList.remove('now');
      this.bars.get(current)?.classList.add('now');
      this.now = current;
      this.values.innerHTML = current
        ? `<span>cycle ${current.index} <b>${number(current.wall, 3)}</b></span><span class="unit">CPU ${number(current.cpu, 3)}</span>`
        : '<span>–</span>';
    }
  }

  /** Draws the charts of these signals, and of the drives there are now, anew. */
  function show(specs) {
    const parent = document.getElementById('charts');
    parent.replaceChildren();
    charts.length = 0;
    Object.assign(shown, { from: span.start, to: span.end });
    for (const spec of specs) charts.push(new (spec.bars ? SolveChart : Chart)(spec, parent));
    layout();
    moveTo(slalom.now);
  }

  /** `seek` is called with the time [s] that is pointed at. */
  function listen(seek) {
    onSeek = seek;
    new ResizeObserver(() => { layout(); moveTo(slalom.now); }).observe(document.getElementById('charts'));
  }

  /** All are measured before any is drawn, for each would have the browser lay the page out anew. */
  function layout() {
    for (const chart of charts) chart.measure();
    for (const chart of charts) chart.layout();
  }

  function moveTo(t) {
    for (const chart of charts) chart.moveTo(t);
  }

  slalom.charts = { show, listen, moveTo };
})(window.slalom = window.slalom || {});
