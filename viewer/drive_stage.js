// The top view: course, obstacles, vehicle, path and plan on a canvas.
(function (slalom) {
  'use strict';

  const { data } = slalom;
  const { obstacles, goal, region, loop } = data;

  const canvas = document.getElementById('stage');
  const ctx = canvas.getContext('2d');
  const box = slalom.courseBox();
  const camera = { mode: 'follow', x: 0, y: 0, scale: 8, span: 90 };
  const layers = { grown: true, margins: false, path: true, plan: true, ghosts: true, range: false };
  /** A course that is wider than it is high has a stage that is, too, above the charts. */
  const WIDE = 1.3;
  document.body.classList.toggle('wide', box.x1 - box.x0 > WIDE * (box.y1 - box.y0));
  /** At most so many of an obstacle are drawn along a plan. */
  const MOST_GHOSTS = 40;
  let colour = {};
  let width = 1;
  let height = 1;
  let now = slalom.start;

  function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ['bg', 'card', 'ink', 'muted', 'line', 'grid', 'ground', 'road', 'blue',
      'vermilion', 'green', 'orange', 'purple', 'vehicle-glass', 'tyre']) {
      colour[name] = style.getPropertyValue('--' + name).trim();
    }
  }

  const sx = (x) => width / 2 + (x - camera.x) * camera.scale;
  const sy = (y) => height / 2 - (y - camera.y) * camera.scale;

  /** Of path and plan [pixels]: finer where the course is seen from far. */
  const lineWidth = () => Math.min(Math.max(camera.scale * 0.7, 1.2), 2.5);

  function fitCourse() {
    camera.x = (box.x0 + box.x1) / 2;
    camera.y = (box.y0 + box.y1) / 2;
    camera.scale = Math.min(width / (box.x1 - box.x0), (height - 60) / (box.y1 - box.y0)) * 0.96;
  }

  function follow(sample) {
    camera.scale = height / camera.span;
    if (!sample) return fitCourse();
    // A little ahead of the vehicle, so that the plan is in view; as much as both sides allow.
    const ahead = Math.min(camera.span * 0.28, (camera.span * width) / height * 0.28 + Math.abs(Math.sin(sample.psi)) * camera.span * 0.2);
    camera.x = sample.x + Math.cos(sample.psi) * ahead;
    camera.y = sample.y + Math.sin(sample.psi) * ahead;
  }

  function drawGround() {
    ctx.fillStyle = colour.ground;
    ctx.fillRect(0, 0, width, height);
    const x0 = region.x_min === null ? 0 : sx(region.x_min);
    const x1 = region.x_max === null ? width : sx(region.x_max);
    const y0 = region.y_max === null ? 0 : sy(region.y_max);
    const y1 = region.y_min === null ? height : sy(region.y_min);
    ctx.fillStyle = colour.road;
    ctx.fillRect(x0, y0, x1 - x0, y1 - y0);
    drawGrid();
    ctx.strokeStyle = colour.muted;
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    if (region.x_min !== null) { ctx.moveTo(x0, y0); ctx.lineTo(x0, y1); }
    if (region.x_max !== null) { ctx.moveTo(x1, y0); ctx.lineTo(x1, y1); }
    if (region.y_max !== null) { ctx.moveTo(x0, y0); ctx.lineTo(x1, y0); }
    if (region.y_min !== null) { ctx.moveTo(x0, y1); ctx.lineTo(x1, y1); }
    ctx.stroke();
  }

  function drawGrid() {
    const step = slalom.ticks(0, 110 / camera.scale, 1).step;
    const left = camera.x - width / 2 / camera.scale;
    const right = camera.x + width / 2 / camera.scale;
    const bottom = camera.y - height / 2 / camera.scale;
    const top = camera.y + height / 2 / camera.scale;
    ctx.strokeStyle = colour.grid;
    ctx.fillStyle = colour.muted;
    ctx.lineWidth = 1;
    ctx.font = '11px ' + getComputedStyle(document.body).fontFamily;
    ctx.beginPath();
    for (let i = Math.ceil(left / step); i * step <= right; ++i) {
      const p = Math.round(sx(i * step)) + 0.5;
      ctx.moveTo(p, 0);
      ctx.lineTo(p, height);
    }
    for (let i = Math.ceil(bottom / step); i * step <= top; ++i) {
      const p = Math.round(sy(i * step)) + 0.5;
      ctx.moveTo(0, p);
      ctx.lineTo(width, p);
    }
    ctx.stroke();
    ctx.textAlign = 'right';
    ctx.textBaseline = 'middle';
    for (let i = Math.ceil(bottom / step); i * step <= top; ++i) {
      const p = sy(i * step);
      if (p > 20 && p < height - 30) ctx.fillText(slalom.number(i * step, step < 1 ? 1 : 0), width - 8, p);
    }
    ctx.textAlign = 'center';
    for (let i = Math.ceil(left / step); i * step <= right; ++i) {
      const p = sx(i * step);
      if (p > 225 && p < width - 60) ctx.fillText(slalom.number(i * step, step < 1 ? 1 : 0), p, height - 12);
    }
    ctx.textAlign = 'right';
    ctx.fillText('x, y [m]', width - 8, height - 12);
  }

  function drawGoal() {
    const s = goal.sigma * camera.scale;
    ctx.save();
    ctx.translate(sx(goal.x), sy(goal.y));
    ctx.fillStyle = colour.green;
    ctx.globalAlpha = 0.13;
    ctx.fillRect(-s, -s, 2 * s, 2 * s);
    ctx.globalAlpha = 0.9;
    ctx.strokeStyle = colour.green;
    ctx.lineWidth = 1.5;
    ctx.strokeRect(-s, -s, 2 * s, 2 * s);
    ctx.beginPath();
    ctx.moveTo(-5, 0); ctx.lineTo(5, 0);
    ctx.moveTo(0, -5); ctx.lineTo(0, 5);
    ctx.stroke();
    ctx.fillStyle = colour.green;
    ctx.font = '600 12px ' + getComputedStyle(document.body).fontFamily;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'bottom';
    ctx.fillText('goal', 0, -s - 4);
    ctx.restore();
  }

  function ellipse(x, y, a, b) {
    ctx.beginPath();
    ctx.ellipse(sx(x), sy(y), Math.max(a * camera.scale, 0.1), Math.max(b * camera.scale, 0.1), 0, 0, 2 * Math.PI);
  }

  function drawObstacles(t) {
    for (const o of obstacles) {
      const p = slalom.obstacleAt(o, t);
      if (layers.grown) {
        ellipse(p.x, p.y, o.grown.a, o.grown.b);
        ctx.strokeStyle = colour.vermilion;
        ctx.globalAlpha = 0.6;
        ctx.lineWidth = 1;
        ctx.stroke();
        ctx.globalAlpha = 1;
      }
      if (layers.margins) {
        ctx.strokeStyle = colour.vermilion;
        ctx.lineWidth = 1.5;
        ctx.setLineDash([3, 3]);
        for (const margin of data.planner.margins) {
          ellipse(p.x, p.y, o.a + margin, o.b + margin);
          ctx.stroke();
        }
        ctx.setLineDash([]);
      }
      ellipse(p.x, p.y, Math.max(o.a, 1.2 / camera.scale), Math.max(o.b, 1.2 / camera.scale));
      ctx.fillStyle = colour.vermilion;
      ctx.fill();
      if (slalom.moves(o)) drawArrow(p, o);
    }
  }

  function drawNames(t) {
    ctx.fillStyle = colour.card;
    ctx.font = '600 12px ' + getComputedStyle(document.body).fontFamily;
    ctx.textAlign = 'center';
    ctx.textBaseline = 'middle';
    for (const o of obstacles) {
      if (Math.min(o.a, o.b) * camera.scale < 12) continue;
      const p = slalom.obstacleAt(o, t);
      ctx.fillText(o.name, sx(p.x), sy(p.y));
    }
  }

  /** Where the obstacle will be in one second. */
  function drawArrow(p, o) {
    const dx = o.vx * camera.scale;
    const dy = -o.vy * camera.scale;
    const length = Math.hypot(dx, dy);
    if (length < 6) return;
    const edge = Math.hypot(o.a * o.vx, o.b * o.vy) / Math.hypot(o.vx, o.vy) * camera.scale;
    ctx.save();
    ctx.translate(sx(p.x), sy(p.y));
    ctx.rotate(Math.atan2(dy, dx));
    ctx.strokeStyle = colour.vermilion;
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
  function drawGhosts(plan) {
    ctx.strokeStyle = colour.purple;
    ctx.fillStyle = colour.purple;
    for (const o of obstacles) {
      if (!slalom.moves(o)) continue;
      const n = plan.t.length - 1;
      const held = plan.held !== null;
      ctx.lineWidth = 1;
      ctx.setLineDash([]);
      const step = Math.ceil(n / MOST_GHOSTS);
      for (let k = step; !held && k < n; k += step) {
        const p = slalom.obstacleAt(o, plan.t_start + plan.t[k]);
        ctx.globalAlpha = 0.22;
        ellipse(p.x, p.y, o.a, o.b);
        ctx.stroke();
      }
      const p = slalom.obstacleAt(o, held ? plan.held : plan.t_start + plan.t[n]);
      ellipse(p.x, p.y, Math.max(o.a, 4 / camera.scale), Math.max(o.b, 4 / camera.scale));
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

  function drawPath(t) {
    const { x, y } = data.plant;
    const last = slalom.lastAtOrBefore(data.plant.t, t);
    const sample = slalom.sampleAt(data.plant, t);
    if (!sample) return;
    ctx.strokeStyle = colour.blue;
    ctx.lineWidth = lineWidth();
    ctx.lineJoin = 'round';
    ctx.beginPath();
    for (let i = 0; i <= last; ++i) {
      if (i === 0) ctx.moveTo(sx(x[i]), sy(y[i])); else ctx.lineTo(sx(x[i]), sy(y[i]));
    }
    ctx.lineTo(sx(sample.x), sy(sample.y));
    ctx.stroke();
  }

  /** Solid as far as it is driven before the next plan takes over, dashed after that. */
  function drawPlan(cycle) {
    const { plan } = cycle;
    const cut = slalom.cutAt(cycle);
    const points = slalom.planPath(plan);
    const kept = points.findIndex((p) => p[2] > cut + 1e-9);
    const end = kept < 0 ? points.length : kept;
    const line = (part) => {
      ctx.beginPath();
      part.forEach(([x, y], i) => (i ? ctx.lineTo(sx(x), sy(y)) : ctx.moveTo(sx(x), sy(y))));
      ctx.stroke();
    };
    ctx.strokeStyle = colour.orange;
    ctx.fillStyle = colour.orange;
    ctx.lineWidth = lineWidth();
    line(points.slice(0, end));
    ctx.setLineDash([3 * lineWidth(), 3 * lineWidth()]);
    line(points.slice(Math.max(end - 1, 0)));
    ctx.setLineDash([]);
    // A verified motion has a node at each of its many samples: only its end says anything.
    for (let k = cycle.rung ? Math.max(plan.t.length - 1, 0) : 0; k < plan.t.length; ++k) {
      ctx.beginPath();
      ctx.arc(sx(plan.x[k]), sy(plan.y[k]), (k === plan.t.length - 1 ? 2 : 1.3) * lineWidth(), 0, 2 * Math.PI);
      ctx.fill();
      ctx.strokeStyle = colour.card;
      ctx.lineWidth = lineWidth() / 2;
      ctx.stroke();
    }
  }

  function drawRange(plan) {
    const range = data.planner.L_range;
    ctx.strokeStyle = colour.muted;
    ctx.lineWidth = 1.25;
    ctx.setLineDash([2, 4]);
    ellipse(plan.x[0], plan.y[0], range, range);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** A ring where the drive ended other than at the goal. */
  function drawEnd(sample) {
    if (data.outcome === 'goal' || now < slalom.end - 1e-9) return;
    ctx.save();
    ctx.translate(sx(sample.x), sy(sample.y));
    ctx.strokeStyle = colour.vermilion;
    ctx.lineWidth = 3;
    ctx.beginPath();
    ctx.arc(0, 0, 17, 0, 2 * Math.PI);
    ctx.stroke();
    ctx.restore();
  }

  function draw(t) {
    now = t;
    const sample = slalom.sampleAt(data.plant, t);
    const cycle = slalom.cycleAt(t);
    if (camera.mode === 'follow') follow(sample);
    if (camera.mode === 'course') fitCourse();
    drawGround();
    drawGoal();
    if (cycle && layers.range) drawRange(cycle.plan);
    if (layers.path) drawPath(t);
    drawObstacles(t);
    if (cycle && layers.ghosts) drawGhosts(cycle.plan);
    drawNames(t);
    if (cycle && layers.plan) drawPlan(cycle);
    if (sample) {
      slalom.drawVehicle(ctx, colour, sample, sx(sample.x), sy(sample.y), camera.scale);
      drawEnd(sample);
    }
    if (camera.mode !== 'course') slalom.drawMap(ctx, colour, box, sample, t, { ...camera, width, height });
  }

  function resize() {
    const ratio = window.devicePixelRatio || 1;
    const rect = canvas.getBoundingClientRect();
    width = Math.max(rect.width, 1);
    height = Math.max(rect.height, 1);
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw(now);
  }

  function setMode(mode) {
    camera.mode = mode;
    document.getElementById('view-follow').setAttribute('aria-pressed', String(mode === 'follow'));
    document.getElementById('view-course').setAttribute('aria-pressed', String(mode === 'course'));
    draw(now);
  }

  /** Zooms by `factor` about a point of the canvas; a camera that follows goes on following. */
  function zoom(factor, px, py) {
    if (camera.mode === 'follow') {
      camera.span = Math.min(Math.max(camera.span / factor, 8), 4000);
    } else {
      if (camera.mode === 'course') setMode('free');
      const x = camera.x + (px - width / 2) / camera.scale;
      const y = camera.y - (py - height / 2) / camera.scale;
      camera.scale = Math.min(Math.max(camera.scale * factor, 0.05), 200);
      camera.x = x - (px - width / 2) / camera.scale;
      camera.y = y + (py - height / 2) / camera.scale;
    }
    draw(now);
  }

  function pan(dx, dy) {
    if (camera.mode !== 'free') setMode('free');
    camera.x -= dx / camera.scale;
    camera.y += dy / camera.scale;
    draw(now);
  }

  function listen() {
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY * 0.0012), event.offsetX, event.offsetY);
    }, { passive: false });
    let drag = null;
    canvas.addEventListener('pointerdown', (event) => {
      drag = { x: event.clientX, y: event.clientY };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!drag) return;
      const dx = event.clientX - drag.x;
      const dy = event.clientY - drag.y;
      if (camera.mode !== 'free' && Math.hypot(dx, dy) < 4) return;
      drag = { x: event.clientX, y: event.clientY };
      pan(dx, dy);
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, () => { drag = null; });
    canvas.addEventListener('dblclick', () => setMode('follow'));
    document.getElementById('view-follow').addEventListener('click', () => { camera.span = 90; setMode('follow'); });
    document.getElementById('view-course').addEventListener('click', () => setMode('course'));
    document.getElementById('zoom-in').addEventListener('click', () => zoom(1.3, width / 2, height / 2));
    document.getElementById('zoom-out').addEventListener('click', () => zoom(1 / 1.3, width / 2, height / 2));
    for (const name of Object.keys(layers)) {
      const toggle = document.getElementById('layer-' + name);
      layers[name] = toggle.checked;
      toggle.addEventListener('change', () => { layers[name] = toggle.checked; draw(now); });
    }
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readColours(); draw(now); });
    new ResizeObserver(resize).observe(canvas);
  }

  readColours();
  listen();
  resize();
  slalom.stage = { draw, setMode, zoom: (factor) => zoom(factor, width / 2, height / 2) };
})(window.slalom = window.slalom || {});
