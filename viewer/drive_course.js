// What stands on the stage and what moves by itself: ground, grid, goals, obstacles. `view` is the
// stage's: its canvas, colours, camera, and x(), y() from metres to pixels.
(function (slalom) {
  'use strict';

  const { drives, moves, number, obstacleAt, expectedAt, offset, offsetText } = slalom;
  /** At most so many of an obstacle are drawn along a plan. */
  const MOST_GHOSTS = 40;

  const font = (weight, size) => `${weight} ${size}px ${getComputedStyle(document.body).fontFamily}`;

  /**
   * Things of a kind that the drives have, each with the ink it is drawn in: muted where both
   * drives have the same.
   */
  function shared(usual, of) {
    const list = [];
    for (const drive of drives) {
      for (const thing of of(drive.data)) {
        const key = JSON.stringify(thing);
        const same = list.find((one) => one.key === key && one.drive !== drive);
        if (same) same.ink = 'muted'; else list.push({ ...thing, key, drive, ink: drive.ink(usual) });
      }
    }
    return list;
  }

  function ground(view) {
    const { ctx, colour, width, height, scene } = view;
    ctx.fillStyle = colour.ground;
    ctx.fillRect(0, 0, width, height);
    const sides = scene.regions.map((r) => ({
      r,
      x0: r.x_min === null ? 0 : view.x(r.x_min),
      x1: r.x_max === null ? width : view.x(r.x_max),
      y0: r.y_max === null ? 0 : view.y(r.y_max),
      y1: r.y_min === null ? height : view.y(r.y_min),
    }));
    ctx.fillStyle = colour.road;
    if (!scene.roads.length) for (const { x0, x1, y0, y1 } of sides) ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    surfaces(view);
    grid(view);
    roadLines(view);
    ctx.lineWidth = 1.5;
    for (const { r, x0, x1, y0, y1 } of sides) {
      ctx.strokeStyle = colour[r.ink];
      ctx.beginPath();
      if (r.x_min !== null) { ctx.moveTo(x0, y0); ctx.lineTo(x0, y1); }
      if (r.x_max !== null) { ctx.moveTo(x1, y0); ctx.lineTo(x1, y1); }
      if (r.y_max !== null) { ctx.moveTo(x0, y0); ctx.lineTo(x1, y0); }
      if (r.y_min !== null) { ctx.moveTo(x0, y1); ctx.lineTo(x1, y1); }
      ctx.stroke();
    }
  }

  /** The multiples of `step` in [lo, hi], counted from `from`: labels and places. */
  function marks(lo, hi, step, from) {
    const out = [];
    for (let i = Math.ceil((lo - from) / step); from + i * step <= hi; ++i) {
      out.push({ label: number(i * step, step < 1 ? 1 : 0), at: from + i * step });
    }
    return out;
  }

  function grid(view) {
    const { ctx, colour, camera, width, height, box } = view;
    const step = slalom.ticks(0, 110 / camera.scale, 1).step;
    const across = width / 2 / camera.scale;
    const up = height / 2 / camera.scale;
    const from = { x: offset(box.x0, box.x1), y: offset(box.y0, box.y1) };
    const xs = marks(camera.x - across, camera.x + across, step, from.x);
    const ys = marks(camera.y - up, camera.y + up, step, from.y);
    ctx.strokeStyle = colour.grid;
    ctx.fillStyle = colour.muted;
    ctx.lineWidth = 1;
    ctx.font = font('', 11);
    ctx.beginPath();
    for (const { at } of xs) {
      const p = Math.round(view.x(at)) + 0.5;
      ctx.moveTo(p, 0);
      ctx.lineTo(p, height);
    }
    for (const { at } of ys) {
      const p = Math.round(view.y(at)) + 0.5;
      ctx.moveTo(0, p);
      ctx.lineTo(width, p);
    }
    ctx.stroke();
    ctx.textAlign = 'right';
    ctx.textBaseline = 'middle';
    for (const { at, label } of ys) {
      const p = view.y(at);
      if (p > 20 && p < height - 30) ctx.fillText(label, width - 8, p);
    }
    const words = from.x || from.y ? ['x', 'y'].map((name) => `${name} ${offsetText(from[name]) || 'in'} m`).join(', ') : 'x, y [m]';
    ctx.fillText(words, width - 8, height - 12);
    const free = width - 24 - ctx.measureText(words).width;
    ctx.textAlign = 'center';
    for (const { at, label } of xs) {
      const p = view.x(at);
      if (p > 225 && p < free) ctx.fillText(label, p, height - 12);
    }
  }

  /** Paths through places, from the first to the last. */
  function through(view, places) {
    view.ctx.beginPath();
    for (const [x, y] of places) view.ctx.lineTo(view.x(x), view.y(y));
  }

  function surfaces(view) {
    const { ctx, colour, scene } = view;
    ctx.fillStyle = colour.road;
    for (const { left, right } of scene.roads) {
      through(view, [...left, ...right.slice().reverse()]);
      ctx.fill();
    }
  }

  /** Edges, lanes and the reference line. */
  function roadLines(view) {
    const { ctx, colour, scene } = view;
    for (const { left, right, middle, lanes, ink } of scene.roads) {
      ctx.strokeStyle = colour[ink];
      const line = (places, width, alpha, dash) => {
        through(view, places);
        ctx.lineWidth = width;
        ctx.globalAlpha = alpha;
        ctx.setLineDash(dash);
        ctx.stroke();
      };
      for (const lane of lanes) line(lane, 1.25, 0.6, [9, 9]);
      line(middle, 1, 0.25, []);
      for (const edge of [left, right]) line(edge, 1.75, 0.9, []);
      ctx.globalAlpha = 1;
    }
  }

  function goals(view) {
    const { ctx, colour, scene } = view;
    for (const { x, y, ink } of scene.goals) {
      if (!x.length) continue;
      const shape = x.map((at, i) => [at, y[i]]);
      const top = shape.reduce((a, b) => (b[1] > a[1] ? b : a));
      const middle = [0, 1].map((k) => shape.reduce((sum, p) => sum + p[k], 0) / shape.length);
      ctx.save();
      through(view, shape);
      ctx.closePath();
      ctx.fillStyle = ctx.strokeStyle = colour[ink];
      ctx.globalAlpha = 0.13;
      ctx.fill();
      ctx.globalAlpha = 0.9;
      ctx.lineWidth = shape.length > 2 ? 1.5 : 3;
      ctx.stroke();
      ctx.translate(view.x(middle[0]), view.y(middle[1]));
      if (shape.length > 2) {
        ctx.lineWidth = 1.5;
        ctx.beginPath();
        ctx.moveTo(-5, 0); ctx.lineTo(5, 0);
        ctx.moveTo(0, -5); ctx.lineTo(0, 5);
        ctx.stroke();
      }
      ctx.font = font('600', 12);
      ctx.textAlign = 'center';
      ctx.textBaseline = 'bottom';
      ctx.fillText('goal', 0, view.y(top[1]) - view.y(middle[1]) - 4);
      ctx.restore();
    }
  }

  function ellipse(view, x, y, a, b) {
    const { ctx, camera } = view;
    ctx.beginPath();
    ctx.ellipse(view.x(x), view.y(y), Math.max(a * camera.scale, 0.1), Math.max(b * camera.scale, 0.1), 0, 0, 2 * Math.PI);
  }

  /** Paths an obstacle at p, larger by `margin` [m], but no smaller than a circle of `least` [pixels]. */
  function outline({ ctx, x, y, scale }, o, p, margin, least) {
    ctx.beginPath();
    const [a, b] = [(o.a + margin) * scale, (o.b + margin) * scale];
    if (!o.polygon || a < least) {
      ctx.ellipse(x(p.x), y(p.y), Math.max(a, least, 0.1), Math.max(b, least, 0.1), -p.psi, 0, 2 * Math.PI);
      return;
    }
    for (const [cx, cy] of slalom.corners(o.polygon, p, margin)) ctx.lineTo(x(cx), y(cy));
    ctx.closePath();
  }

  const on = (view) => ({ ctx: view.ctx, x: view.x, y: view.y, scale: view.camera.scale });

  function obstacles(view, t) {
    const { ctx, colour, layers, scene } = view;
    for (const o of scene.obstacles) {
      if (o.track) way(view, o, t);
      const p = obstacleAt(o, t);
      if (!p) continue;
      if (layers.grown) {
        outline(on(view), o, p, o.grown.a - o.a, 0);
        ctx.strokeStyle = colour[o.ink];
        ctx.globalAlpha = 0.6;
        ctx.lineWidth = 1;
        ctx.stroke();
        ctx.globalAlpha = 1;
      }
      outline(on(view), o, p, 0, 1.2);
      ctx.fillStyle = colour[o.ink];
      ctx.fill();
      if (moves(o)) arrow(view, p, o);
    }
    if (layers.margins) for (const drive of drives) margins(view, drive, t);
  }

  /** Where an obstacle that moves by a table or along a path will go. */
  function way(view, o, t) {
    const { ctx, colour } = view;
    const { track } = o;
    const p = obstacleAt(o, t);
    ctx.strokeStyle = colour[o.ink];
    ctx.globalAlpha = 0.3;
    ctx.lineWidth = 1;
    ctx.beginPath();
    if (p) ctx.moveTo(view.x(p.x), view.y(p.y));
    for (let i = slalom.lastAtOrBefore(track.t, t) + 1; i < track.t.length; ++i) ctx.lineTo(view.x(track.x[i]), view.y(track.y[i]));
    ctx.stroke();
    ctx.globalAlpha = 1;
  }

  /** Around each obstacle, the margins that a drive's planner keeps. */
  function margins(view, drive, t) {
    const { ctx, colour } = view;
    ctx.strokeStyle = colour[drive.ink('vermilion')];
    ctx.lineWidth = 1.5;
    ctx.setLineDash([3, 3]);
    for (const o of drive.data.obstacles) {
      const p = obstacleAt(o, t);
      if (!p) continue;
      for (const margin of drive.data.planner.margins) {
        outline(on(view), o, p, margin + grownBy(o, 0), 0);
        ctx.stroke();
      }
    }
    ctx.setLineDash([]);
  }

  /** By how much predictions take an obstacle for larger, `ahead` seconds from when they are made. */
  const grownBy = (o, ahead) => (o.margin ? o.margin[0] + o.margin[1] * Math.max(ahead, 0) : 0);

  function names(view, t) {
    const { ctx, colour, camera, scene } = view;
    ctx.fillStyle = colour.card;
    ctx.font = font('600', 12);
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    for (const o of scene.obstacles) {
      if (slalom.halfBreadth(o) * camera.scale < 12) continue;
      const p = obstacleAt(o, t);
      if (p) ctx.fillText(o.name, view.x(p.x), view.y(p.y));
    }
  }

  /** What the obstacle at a place of the canvas is called and how fast it is; nothing for none. */
  function wordsAt(view, t, px, py) {
    const x = view.camera.x + (px - view.width / 2) / view.camera.scale;
    const y = view.camera.y - (py - view.height / 2) / view.camera.scale;
    for (const o of view.scene.obstacles) {
      const p = obstacleAt(o, t);
      if (!p || !slalom.covers(o, p, 4 / view.camera.scale, x, y)) continue;
      return moves(o) ? `${o.name}, ${number(Math.hypot(p.vx, p.vy), 1)} m/s` : o.name;
    }
    return '';
  }

  /** Where the obstacle will be in one second. */
  function arrow(view, p, o) {
    const { ctx, colour, camera } = view;
    const dx = p.vx * camera.scale;
    const dy = -p.vy * camera.scale;
    const length = Math.hypot(dx, dy);
    if (length < 6) return;
    const speed = Math.hypot(p.vx, p.vy);
    const ahead = Math.atan2(p.vy, p.vx) - p.psi;
    const [c, s] = [Math.cos(ahead), Math.sin(ahead)];
    const edge = (o.polygon ? Math.max(...o.polygon.map(([x, y]) => c * x + s * y))
      : p.psi === 0 ? Math.hypot(o.a * p.vx, o.b * p.vy) / speed : Math.hypot(o.a * c, o.b * s)) * camera.scale;
    ctx.save();
    ctx.translate(view.x(p.x), view.y(p.y));
    ctx.rotate(Math.atan2(dy, dx));
    ctx.strokeStyle = colour[o.ink];
    ctx.lineWidth = 2;
    ctx.beginPath();
    ctx.moveTo(edge, 0);
    ctx.lineTo(edge + length, 0);
    ctx.moveTo(edge + length - 6, -4);
    ctx.lineTo(edge + length, 0);
    ctx.lineTo(edge + length - 6, 4);
    ctx.stroke();
    ctx.restore();
  }

  /** The moving obstacles where the plan being driven takes them to be. */
  function ghosts(view, drive, { plan, t0 }) {
    const { ctx, colour } = view;
    const { prediction } = drive.data.settings.planner;
    ctx.strokeStyle = colour[drive.ink('purple')];
    ctx.fillStyle = ctx.strokeStyle;
    for (const o of drive.data.obstacles) {
      if (!moves(o)) continue;
      const n = plan.t.length - 1;
      const held = plan.held !== null;
      const ghost = (t, least) => {
        const p = expectedAt(o, t, t0, prediction);
        if (p) outline(on(view), o, p, grownBy(o, t - t0), least); else ctx.beginPath();
      };
      ctx.lineWidth = 1;
      ctx.setLineDash([]);
      const step = Math.ceil(n / MOST_GHOSTS);
      for (let k = step; !held && k < n; k += step) {
        ctx.globalAlpha = 0.22;
        ghost(plan.t_start + plan.t[k], 0);
        ctx.stroke();
      }
      ghost(held ? plan.held : plan.t_start + plan.t[n], 4);
      ctx.globalAlpha = 0.12;
      ctx.fill();
      ctx.globalAlpha = 1;
      ctx.lineWidth = 1.75;
      ctx.setLineDash([5, 4]);
      ctx.stroke();
      ctx.setLineDash([]);
    }
    ctx.globalAlpha = 1;
  }

  /** The obstacles that a drive's plans do not get past at t: where they are, and dashed where they will be then. */
  function blockers(view, drive, t) {
    const { ctx, colour } = view;
    ctx.strokeStyle = ctx.fillStyle = colour[drive.ink('ink')];
    ctx.lineWidth = 3;
    for (const { name, t: then } of drive.blockersAt(t)) {
      const o = drive.data.obstacles.find((one) => one.name === name);
      const ring = (at, dash) => {
        const p = o && at !== null && obstacleAt(o, at);
        if (!p) return null;
        outline(on(view), o, p, 4 / view.camera.scale, 9);
        ctx.setLineDash(dash);
        ctx.stroke();
        ctx.setLineDash([]);
        return p;
      };
      if (o && moves(o)) ring(then, [4, 4]);
      const p = ring(t, []);
      if (!p) continue;
      ctx.font = font('600', 12);
      ctx.textAlign = 'left';
      ctx.textBaseline = 'middle';
      const reach = o.polygon ? Math.max(...o.polygon.map(([x, y]) => Math.hypot(x, y))) : o.a;
      ctx.fillText(`${name} in the way`, view.x(p.x) + Math.max(reach * view.camera.scale + 4, 9) + 6, view.y(p.y));
    }
  }

  /** What stands on the course of the drives there are now. */
  function scene() {
    return {
      obstacles: shared('vermilion', (data) => data.obstacles),
      goals: shared('green', (data) => [data.goal]),
      roads: shared('muted', (data) => (data.road ? [data.road] : [])),
      regions: shared('muted', (data) => [data.region]),
    };
  }

  slalom.course = { scene, ground, goals, obstacles, names, wordsAt, ghosts, blockers, ellipse, outline };
})(window.slalom = window.slalom || {});
