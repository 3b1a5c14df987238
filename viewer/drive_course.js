// What stands on the stage and what moves by itself: ground, grid, goals, obstacles. `view` is the
// stage's: its canvas, colours, camera, and x(), y() from metres to pixels.
(function (slalom) {
  'use strict';

  const { drives, moves, number, obstacleAt, offset, offsetText } = slalom;
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
    for (const { x0, x1, y0, y1 } of sides) ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    grid(view);
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

  function goals(view) {
    const { ctx, colour, camera, scene } = view;
    for (const goal of scene.goals) {
      const s = goal.sigma * camera.scale;
      const ink = colour[goal.ink];
      ctx.save();
      ctx.translate(view.x(goal.x), view.y(goal.y));
      ctx.fillStyle = ink;
      ctx.globalAlpha = 0.13;
      ctx.fillRect(-s, -s, 2 * s, 2 * s);
      ctx.globalAlpha = 0.9;
      ctx.strokeStyle = ink;
      ctx.lineWidth = 1.5;
      ctx.strokeRect(-s, -s, 2 * s, 2 * s);
      ctx.beginPath();
      ctx.moveTo(-5, 0); ctx.lineTo(5, 0);
      ctx.moveTo(0, -5); ctx.lineTo(0, 5);
      ctx.stroke();
      ctx.font = font('600', 12);
      ctx.textAlign = 'center';
      ctx.textBaseline = 'bottom';
      ctx.fillText('goal', 0, -s - 4);
      ctx.restore();
    }
  }

  function ellipse(view, x, y, a, b) {
    const { ctx, camera } = view;
    ctx.beginPath();
    ctx.ellipse(view.x(x), view.y(y), Math.max(a * camera.scale, 0.1), Math.max(b * camera.scale, 0.1), 0, 0, 2 * Math.PI);
  }

  function obstacles(view, t) {
    const { ctx, colour, camera, layers, scene } = view;
    for (const o of scene.obstacles) {
      const p = obstacleAt(o, t);
      if (layers.grown) {
        ellipse(view, p.x, p.y, o.grown.a, o.grown.b);
        ctx.strokeStyle = colour[o.ink];
        ctx.globalAlpha = 0.6;
        ctx.lineWidth = 1;
        ctx.stroke();
        ctx.globalAlpha = 1;
      }
      ellipse(view, p.x, p.y, Math.max(o.a, 1.2 / camera.scale), Math.max(o.b, 1.2 / camera.scale));
      ctx.fillStyle = colour[o.ink];
      ctx.fill();
      if (moves(o)) arrow(view, p, o);
    }
    if (layers.margins) for (const drive of drives) margins(view, drive, t);
  }

  /** Around each obstacle, the margins that a drive's planner keeps. */
  function margins(view, drive, t) {
    const { ctx, colour } = view;
    ctx.strokeStyle = colour[drive.ink('vermilion')];
    ctx.lineWidth = 1.5;
    ctx.setLineDash([3, 3]);
    for (const o of drive.data.obstacles) {
      const p = obstacleAt(o, t);
      for (const margin of drive.data.planner.margins) {
        ellipse(view, p.x, p.y, o.a + margin, o.b + margin);
        ctx.stroke();
      }
    }
    ctx.setLineDash([]);
  }

  function names(view, t) {
    const { ctx, colour, camera, scene } = view;
    ctx.fillStyle = colour.card;
    ctx.font = font('600', 12);
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    for (const o of scene.obstacles) {
      if (Math.min(o.a, o.b) * camera.scale < 12) continue;
      const p = obstacleAt(o, t);
      ctx.fillText(o.name, view.x(p.x), view.y(p.y));
    }
  }

  /** Where the obstacle will be in one second. */
  function arrow(view, p, o) {
    const { ctx, colour, camera } = view;
    const dx = o.vx * camera.scale;
    const dy = -o.vy * camera.scale;
    const length = Math.hypot(dx, dy);
    if (length < 6) return;
    const edge = Math.hypot(o.a * o.vx, o.b * o.vy) / Math.hypot(o.vx, o.vy) * camera.scale;
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
  function ghosts(view, drive, plan) {
    const { ctx, colour, camera } = view;
    ctx.strokeStyle = colour[drive.ink('purple')];
    ctx.fillStyle = ctx.strokeStyle;
    for (const o of drive.data.obstacles) {
      if (!moves(o)) continue;
      const n = plan.t.length - 1;
      const held = plan.held !== null;
      ctx.lineWidth = 1;
      ctx.setLineDash([]);
      const step = Math.ceil(n / MOST_GHOSTS);
      for (let k = step; !held && k < n; k += step) {
        const p = obstacleAt(o, plan.t_start + plan.t[k]);
        ctx.globalAlpha = 0.22;
        ellipse(view, p.x, p.y, o.a, o.b);
        ctx.stroke();
      }
      const p = obstacleAt(o, held ? plan.held : plan.t_start + plan.t[n]);
      ellipse(view, p.x, p.y, Math.max(o.a, 4 / camera.scale), Math.max(o.b, 4 / camera.scale));
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

  /** What stands on the course of the drives there are now. */
  function scene() {
    return {
      obstacles: shared('vermilion', (data) => data.obstacles),
      goals: shared('green', (data) => [data.goal]),
      regions: shared('muted', (data) => [data.region]),
    };
  }

  slalom.course = { scene, ground, goals, obstacles, names, ghosts, ellipse };
})(window.slalom = window.slalom || {});
