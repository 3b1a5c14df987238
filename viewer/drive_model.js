// The drives as data: reads what the page carries and answers questions about an instant.
(function (slalom) {
  'use strict';

  /** One drive, or two that are compared. */
  const drives = [];
  /** From when to when there is something to see of any of them [s]. */
  const span = { start: 0, end: 0 };
  const COLOURS = ['blue', 'orange'];

  /** Index of the last element of the ascending `values` that is <= v; -1 before the first. */
  function lastAtOrBefore(values, v) {
    let lo = 0;
    let hi = values.length;
    while (lo < hi) {
      const mid = (lo + hi) >> 1;
      if (values[mid] <= v) lo = mid + 1; else hi = mid;
    }
    return lo - 1;
  }

  function between(values, i, w) {
    const a = values[i];
    const b = values[Math.min(i + 1, values.length - 1)];
    if (a === null || a === undefined || b === null || b === undefined) return a === undefined ? null : a;
    return a + (b - a) * w;
  }

  /** All columns at absolute time t [s], interpolated linearly; null when nothing was recorded. */
  function sampleAt(columns, t) {
    const times = columns.t;
    if (!times.length) return null;
    const i = Math.min(Math.max(lastAtOrBefore(times, t), 0), times.length - 1);
    const next = Math.min(i + 1, times.length - 1);
    const h = times[next] - times[i];
    const w = h > 0 ? Math.min(Math.max((t - times[i]) / h, 0), 1) : 0;
    const sample = {};
    for (const name of Object.keys(columns)) sample[name] = between(columns[name], i, w);
    return sample;
  }

  /** Where an obstacle is at absolute time t, its heading and velocity; null while it is not there. */
  function obstacleAt(o, t) {
    if (!o.track) return { x: o.x + o.vx * t, y: o.y + o.vy * t, psi: o.psi || 0, vx: o.vx, vy: o.vy, omega: 0 };
    const { track, there: [from, to] } = o;
    if (!track.t.length || (from !== null && t < from) || (to !== null && t > to)) return null;
    const i = Math.min(Math.max(lastAtOrBefore(track.t, t), 0), Math.max(track.t.length - 2, 0));
    const h = track.t[i + 1] - track.t[i];
    const rate = (column) => (h > 0 && t < track.t[track.t.length - 1] ? (column[i + 1] - column[i]) / h : 0);
    const { x, y, psi } = sampleAt(track, t);
    return { x, y, psi, vx: rate(track.x), vy: rate(track.y), omega: rate(track.psi) };
  }

  function moves(o) {
    return Boolean(o.track) || o.vx !== 0 || o.vy !== 0;
  }

  /** Where a plan made at `t0` takes an obstacle to be at t: where it will be, or as it goes then. */
  function expectedAt(o, t, t0, prediction) {
    if (!o.track || !prediction || prediction === 'known') return obstacleAt(o, t);
    const p = obstacleAt(o, t0);
    if (!p) return null;
    const turned = prediction === 'constant_turn' ? p.omega * (t - t0) : 0;
    // The velocity turns evenly; its integral is the chord.
    const way = (t - t0) * (turned ? Math.sin(turned / 2) / (turned / 2) : 1);
    const c = Math.cos(turned / 2);
    const s = Math.sin(turned / 2);
    return { ...p, x: p.x + way * (c * p.vx - s * p.vy), y: p.y + way * (s * p.vx + c * p.vy), psi: p.psi + turned };
  }

  /** A place of the world in the frame of a body at p. */
  function toBody(p, x, y) {
    const c = Math.cos(p.psi);
    const s = Math.sin(p.psi);
    return [c * (x - p.x) + s * (y - p.y), c * (y - p.y) - s * (x - p.x)];
  }

  /** The corners of a polygon, larger by `margin` all around and then rounded, that is at p. */
  function corners(polygon, p, margin) {
    const out = [];
    const n = polygon.length;
    const add = (x, y) => out.push([p.x + Math.cos(p.psi) * x - Math.sin(p.psi) * y, p.y + Math.sin(p.psi) * x + Math.cos(p.psi) * y]);
    polygon.forEach(([x, y], k) => {
      if (!margin) return add(x, y);
      const [bx, by] = polygon[(k + n - 1) % n];
      const [ax, ay] = polygon[(k + 1) % n];
      const from = Math.atan2(y - by, x - bx);
      const turn = ((Math.atan2(ay - y, ax - x) - from) % (2 * Math.PI) + 2 * Math.PI) % (2 * Math.PI);
      for (let i = 0; i <= 6; ++i) {
        const angle = from - Math.PI / 2 + turn * i / 6;
        add(x + margin * Math.cos(angle), y + margin * Math.sin(angle));
      }
    });
    return out;
  }

  /** Half of how broad an obstacle is where it is narrowest. */
  function halfBreadth(o) {
    if (!o.polygon) return Math.min(o.a, o.b);
    const n = o.polygon.length;
    return Math.min(...o.polygon.map(([x, y], k) => {
      const [ax, ay] = o.polygon[(k + 1) % n];
      return Math.max(...o.polygon.map(([px, py]) => (ax - x) * (py - y) - (ay - y) * (px - x))) / Math.hypot(ax - x, ay - y);
    })) / 2;
  }

  /** Whether the place (x, y) lies within an obstacle at p that is larger by `margin` all around. */
  function covers(o, p, margin, x, y) {
    const [bx, by] = toBody(p, x, y);
    if (!o.polygon) return Math.hypot(bx / (o.a + margin), by / (o.b + margin)) <= 1;
    const n = o.polygon.length;
    return o.polygon.every(([cx, cy], k) => {
      const [ax, ay] = o.polygon[(k + 1) % n];
      return ((ax - cx) * (by - cy) - (ay - cy) * (bx - cx)) / Math.hypot(ax - cx, ay - cy) >= -margin;
    });
  }

  /** Velocity of the front axle's centre; section 1 of the formulation. */
  function velocity(vehicle, p, k) {
    const lateral = p.v[k] + vehicle.la * p.r[k];
    const c = Math.cos(p.psi[k]);
    const s = Math.sin(p.psi[k]);
    return [p.ux[k] * c - lateral * s, p.ux[k] * s + lateral * c];
  }

  class Drive {
    constructor(data, index) {
      this.data = data;
      this.letter = 'AB'[index];
      this.colour = COLOURS[index];
      const { t } = data.plant;
      this.start = t.length ? t[0] : 0;
      this.end = t.length ? Math.max(t[t.length - 1], this.start) : 0;
      this.driven = data.cycles.filter((c) => c.used && c.plan.t.length);
      this.takeover = this.driven.map((c) => c.t_swap);
      /** The cycles on the clock: not the warm-up. */
      this.clocked = data.cycles.filter((c) => c.index > 0);
      this.clockedFrom = this.clocked.map((c) => c.t0);
      this.plannedAt = this.clocked.map((c) => c.t0 + c.tex);
    }

    get name() {
      return `${this.data.scenario} with ${this.data.planner.name}`;
    }

    /** One drive has a colour for each kind of thing; of two, each has its own for all that is its. */
    ink(usual) {
      return drives.length > 1 ? this.colour : usual;
    }

    /** The plant at absolute time t [s]; null when nothing was recorded. */
    sampleAt(t) {
      return sampleAt(this.data.plant, t);
    }

    /** Whether the drive is over at t: that of the other goes on. */
    overAt(t) {
      return t > this.end + 1e-9;
    }

    /** The cycle whose plan is being driven at t; null while the vehicle goes straight on, and when the drive is over. */
    cycleAt(t) {
      if (this.overAt(t)) return null;
      const i = lastAtOrBefore(this.takeover, t + 1e-9);
      return i < 0 ? null : this.driven[i];
    }

    /** The cycle that was planned last at t, if that gave no plan to drive; else null. */
    failedAt(t) {
      const cycle = this.clocked[lastAtOrBefore(this.plannedAt, t + 1e-6)];
      return cycle && !this.overAt(t) && !cycle.solved && !cycle.used ? cycle : null;
    }

    /** The obstacles that plans do not get past at t, by name, each with when: of the plan being driven and of one that failed. */
    blockersAt(t) {
      return [this.cycleAt(t), this.failedAt(t)].flatMap((cycle) => (cycle && cycle.blocker ? [cycle.blocker] : []));
    }

    /** When the next plan takes over from that of a planner that verifies; others' are drawn whole. */
    cutAt(cycle) {
      if (!cycle.rung) return Infinity;
      const next = this.driven[this.driven.indexOf(cycle) + 1];
      return cycle.until ?? (next ? next.t_swap : Infinity);
    }

    /** The cycle that is being solved while the vehicle drives through t, or null. */
    solvingAt(t) {
      const i = lastAtOrBefore(this.clockedFrom, t + 1e-9);
      return i < 0 ? null : this.clocked[i];
    }

    /** Points along a plan with their absolute times: cubic Hermite between its nodes, whose slopes the model gives. */
    planPath(plan) {
      const points = [];
      for (let k = 0; k + 1 < plan.t.length; ++k) {
        const h = plan.t[k + 1] - plan.t[k];
        const [ax, ay] = velocity(this.data.vehicle, plan, k);
        const [bx, by] = velocity(this.data.vehicle, plan, k + 1);
        for (let j = 0; j < 8; ++j) {
          const s = j / 8;
          const s2 = s * s;
          const s3 = s2 * s;
          const h00 = 2 * s3 - 3 * s2 + 1;
          const h10 = s3 - 2 * s2 + s;
          const h01 = 3 * s2 - 2 * s3;
          const h11 = s3 - s2;
          points.push([
            h00 * plan.x[k] + h10 * h * ax + h01 * plan.x[k + 1] + h11 * h * bx,
            h00 * plan.y[k] + h10 * h * ay + h01 * plan.y[k + 1] + h11 * h * by,
            plan.t_start + plan.t[k] + s * h,
          ]);
        }
      }
      const n = plan.t.length - 1;
      if (n >= 0) points.push([plan.x[n], plan.y[n], plan.t_start + plan.t[n]]);
      return points;
    }
  }

  /** When planning of a cycle ended [s]: a late plan takes over after its horizon. */
  function plannedUntil(cycle) {
    return Math.max(cycle.t0 + cycle.tex, cycle.t_swap);
  }

  /** The box around everything there is to see on the course [m]. */
  function courseBox() {
    const box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
    const add = (x, y, rx, ry) => {
      box.x0 = Math.min(box.x0, x - rx);
      box.x1 = Math.max(box.x1, x + rx);
      box.y0 = Math.min(box.y0, y - ry);
      box.y1 = Math.max(box.y1, y + ry);
    };
    for (const { data: { start, goal, plant, obstacles, region: r } } of drives) {
      add(start.x, start.y, 5, 5);
      goal.x.forEach((x, i) => add(x, goal.y[i], 0, 0));
      for (let i = 0; i < plant.t.length; ++i) add(plant.x[i], plant.y[i], 4, 4);
      for (const o of obstacles) {
        const { x, y } = o.track || { x: [o.x], y: [o.y] };
        const [a, b] = o.psi || o.track ? [Math.max(o.grown.a, o.grown.b), Math.max(o.grown.a, o.grown.b)] : [o.grown.a, o.grown.b];
        for (let i = 0; i < x.length; ++i) add(x[i], y[i], a, b);
      }
      if (r.x_min !== null) box.x0 = Math.min(box.x0, r.x_min - 2);
      if (r.x_max !== null) box.x1 = Math.max(box.x1, r.x_max + 2);
    }
    return box;
  }

  /** A number with a fixed number of digits and a proper minus sign; a dash for none. */
  function number(v, digits) {
    if (v === null || v === undefined || !Number.isFinite(v)) return '–';
    const text = v.toFixed(digits);
    return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', '−');
  }

  /** A text as HTML. */
  function escape(text) {
    return String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
  }

  /** Steps of 1, 2 or 5 times a power of ten that cut [lo, hi] into about `count` parts. */
  function ticks(lo, hi, count) {
    const raw = (hi - lo) / Math.max(count, 1);
    if (!(raw > 0)) return [lo];
    const power = Math.pow(10, Math.floor(Math.log10(raw)));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
    const out = [];
    for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + step * 1e-9; ++i) out.push(i * step);
    out.step = step;
    return out;
  }

  /**
   * What the labels of an axis from lo to hi leave out, to be said once: zero, but the nearest round
   * number where places are so far from zero that labels would be all digits.
   */
  function offset(lo, hi) {
    const length = Math.max(hi - lo, 1);
    if (Math.max(Math.abs(lo), Math.abs(hi)) < Math.max(1e4, 20 * length)) return 0;
    const power = Math.pow(10, Math.ceil(Math.log10(length)));
    return Math.round((lo + hi) / 2 / power) * power;
  }

  /** An offset as an axis says it: "+5.4e6"; nothing for none. */
  function offsetText(value) {
    if (value === 0) return '';
    return (value < 0 ? '−' : '+') + Math.abs(value).toExponential().replace('e+', 'e');
  }

  /**
   * Adds a drive by its data; of two that are there, it takes the place of the second. What is drawn
   * has to be told.
   */
  function add(data) {
    const index = Math.min(drives.length, COLOURS.length - 1);
    drives[index] = new Drive(data, index);
    span.start = Math.min(...drives.map((d) => d.start));
    span.end = Math.max(...drives.map((d) => d.end));
  }

  const element = document.getElementById('drive-data');
  [JSON.parse(element.textContent)].flat().forEach(add);

  Object.assign(slalom, {
    drives, span, add, lastAtOrBefore, sampleAt, obstacleAt, expectedAt, moves, corners, halfBreadth, covers, courseBox, plannedUntil, number, escape, ticks, offset, offsetText,
  });
})(window.slalom = window.slalom || {});
