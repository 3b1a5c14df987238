// What a drive shows on the stage: vehicle, path, plan; and the whole course in a corner.
(function (slalom) {
  'use strict';

  const { ellipse, outline } = slalom.course;

  /** Of path and plan [pixels]: finer where the course is seen from far. */
  const lineWidth = (view) => Math.min(Math.max(view.camera.scale * 0.7, 1.2), 2.5);

  function trace(ctx, points) {
    ctx.beginPath();
    points.forEach(([x, y], i) => (i ? ctx.lineTo(x, y) : ctx.moveTo(x, y)));
    ctx.stroke();
  }

  /**
   * Strokes `count` places of a line, at(i) its pixels, as far as they lie in a box of pixels; those
   * that are less than half a pixel from the last are passed over.
   */
  function traceLong(ctx, count, at, [left, top, right, bottom]) {
    const beside = ([ax, ay], [bx, by]) => (ax < left && bx < left) || (ax > right && bx > right) || (ay < top && by < top) || (ay > bottom && by > bottom);
    ctx.beginPath();
    let last = null;
    let down = false;
    for (let i = 0; i < count; ++i) {
      const p = at(i);
      if (last && i < count - 1 && Math.abs(p[0] - last[0]) + Math.abs(p[1] - last[1]) < 0.5) continue;
      if (last && !beside(last, p)) {
        if (!down) ctx.moveTo(...last);
        ctx.lineTo(...p);
        down = true;
      } else {
        down = false;
      }
      last = p;
    }
    ctx.stroke();
  }

  function drawPath(view, drive, t) {
    const { ctx, colour } = view;
    const { plant } = drive.data;
    const sample = drive.sampleAt(t);
    if (!sample) return;
    ctx.strokeStyle = colour[drive.ink('blue')];
    ctx.lineWidth = lineWidth(view);
    ctx.lineJoin = 'round';
    const last = slalom.lastAtOrBefore(plant.t, t);
    traceLong(ctx, last + 2, (i) => (i > last ? [view.x(sample.x), view.y(sample.y)] : [view.x(plant.x[i]), view.y(plant.y[i])]),
      [0, 0, view.width, view.height]);
  }

  /** Solid as far as it is driven before the next plan takes over, dashed after that. */
  function drawPlan(view, drive, cycle) {
    const { ctx, colour } = view;
    const { plan } = cycle;
    const cut = drive.cutAt(cycle);
    const points = drive.planPath(plan).map(([x, y, t]) => [view.x(x), view.y(y), t]);
    const kept = points.findIndex((p) => p[2] > cut + 1e-9);
    const end = kept < 0 ? points.length : kept;
    const line = lineWidth(view);
    ctx.strokeStyle = colour[drive.ink('orange')];
    ctx.fillStyle = ctx.strokeStyle;
    ctx.lineWidth = line;
    trace(ctx, points.slice(0, end));
    ctx.setLineDash([3 * line, 3 * line]);
    trace(ctx, points.slice(Math.max(end - 1, 0)));
    ctx.setLineDash([]);
    // A verified motion has a node at each of its many samples: only its end says anything.
    for (let k = cycle.rung ? Math.max(plan.t.length - 1, 0) : 0; k < plan.t.length; ++k) {
      ctx.beginPath();
      ctx.arc(view.x(plan.x[k]), view.y(plan.y[k]), (k === plan.t.length - 1 ? 2 : 1.3) * line, 0, 2 * Math.PI);
      ctx.fill();
      ctx.strokeStyle = colour.card;
      ctx.lineWidth = line / 2;
      ctx.stroke();
    }
  }

  function drawRange(view, drive, plan) {
    const { ctx, colour } = view;
    const range = drive.data.planner.L_range;
    ctx.strokeStyle = colour[drive.ink('muted')];
    ctx.lineWidth = 1.25;
    ctx.setLineDash([2, 4]);
    ellipse(view, plan.x[0], plan.y[0], range, range);
    ctx.stroke();
    ctx.setLineDash([]);
  }

  /** A ring where the drive ended other than at the goal. */
  function drawEnd(view, drive, sample) {
    const { ctx, colour } = view;
    ctx.strokeStyle = colour[drive.ink('vermilion')];
    ctx.lineWidth = 3;
    ctx.beginPath();
    ctx.arc(view.x(sample.x), view.y(sample.y), 17, 0, 2 * Math.PI);
    ctx.stroke();
  }

  function roundRect(ctx, x, y, w, h, r) {
    ctx.beginPath();
    ctx.moveTo(x + r, y);
    ctx.arcTo(x + w, y, x + w, y + h, r);
    ctx.arcTo(x + w, y + h, x, y + h, r);
    ctx.arcTo(x, y + h, x, y, r);
    ctx.arcTo(x, y, x + w, y, r);
    ctx.closePath();
  }

  /** The rectangle that keeps off obstacles, to scale, in the vehicle's frame. */
  function footprint(view, drive) {
    const { ctx, colour, camera } = view;
    const { length, width, front_overhang: front } = drive.data.vehicle;
    ctx.strokeStyle = colour[drive.ink('blue')];
    ctx.lineWidth = 1;
    ctx.strokeRect((front - length) * camera.scale, -width / 2 * camera.scale, length * camera.scale, width * camera.scale);
  }

  /** The vehicle, its reference point the front axle's centre; never smaller than 16 pixels. */
  function drawVehicle(view, drive, sample) {
    const { ctx, colour } = view;
    const { vehicle } = drive.data;
    const s = Math.max(view.camera.scale, 16 / vehicle.length);
    const wheelbase = (vehicle.la + vehicle.lb) * s;
    const l = vehicle.length * s;
    const w = vehicle.width * s;
    const front = vehicle.front_overhang * s;
    ctx.save();
    ctx.translate(view.x(sample.x), view.y(sample.y));
    ctx.rotate(-sample.psi);
    if (vehicle.footprint === 'rectangle') footprint(view, drive);
    ctx.fillStyle = colour.tyre;
    for (const [x, angle] of [[0, sample.sa], [-wheelbase, 0]]) {
      for (const side of [-1, 1]) {
        ctx.save();
        ctx.translate(x, side * (w / 2 - 0.1 * s));
        ctx.rotate(-angle);
        ctx.fillRect(-0.47 * s, -0.19 * s, 0.94 * s, 0.38 * s);
        ctx.restore();
      }
    }
    roundRect(ctx, front - l, -w / 2 + 0.06 * s, l, w - 0.12 * s, 0.22 * w);
    ctx.fillStyle = colour[drive.ink('blue')];
    ctx.fill();
    ctx.strokeStyle = colour.card;
    ctx.lineWidth = 1.25;
    ctx.stroke();
    ctx.fillStyle = colour['vehicle-glass'];
    roundRect(ctx, -wheelbase * 0.42, -w * 0.34, wheelbase * 0.16, w * 0.68, 0.06 * w);
    ctx.fill();
    // Front wheels over the body, so that their angle shows.
    ctx.fillStyle = colour.tyre;
    for (const side of [-1, 1]) {
      ctx.save();
      ctx.translate(0, side * (w / 2 - 0.16 * s));
      ctx.rotate(-sample.sa);
      ctx.fillRect(-0.47 * s, -0.19 * s, 0.94 * s, 0.38 * s);
      ctx.restore();
    }
    ctx.fillStyle = colour.card;
    ctx.beginPath();
    ctx.arc(0, 0, Math.max(0.14 * s, 1.2), 0, 2 * Math.PI);
    ctx.fill();
    ctx.restore();
  }

  /** The whole course in a corner at time t, with a frame around what the camera shows. */
  function drawMap(view, at, t) {
    const { ctx, colour, camera, width, height, box, scene } = view;
    const w = box.x1 - box.x0;
    const h = box.y1 - box.y0;
    const k = Math.min((width * 0.14) / w, (height * 0.55) / h);
    const left = width - w * k - 44;
    const top = 12;
    const mx = (x) => left + (x - box.x0) * k;
    const my = (y) => top + (box.y1 - y) * k;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left - 4, top - 4, w * k + 8, h * k + 8);
    ctx.fillStyle = colour.card;
    ctx.globalAlpha = 0.92;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.strokeStyle = colour.line;
    ctx.lineWidth = 1;
    ctx.stroke();
    ctx.clip();
    for (const road of scene.roads) {
      ctx.strokeStyle = colour[road.ink];
      for (const edge of [road.left, road.right]) trace(ctx, edge.map(([x, y]) => [mx(x), my(y)]));
    }
    ctx.globalAlpha = 0.3;
    for (const goal of scene.goals) {
      ctx.fillStyle = ctx.strokeStyle = colour[goal.ink];
      ctx.lineWidth = 2;
      ctx.beginPath();
      goal.x.forEach((x, i) => ctx.lineTo(mx(x), my(goal.y[i])));
      ctx.fill();
      if (goal.x.length === 2) ctx.stroke();
    }
    ctx.globalAlpha = 1;
    for (const o of scene.obstacles) {
      const p = slalom.obstacleAt(o, t);
      if (!p) continue;
      ctx.fillStyle = colour[o.ink];
      outline({ ctx, x: mx, y: my, scale: k }, o, p, 0, 1);
      ctx.fill();
    }
    for (const { drive, sample } of at) {
      const { x, y } = drive.data.plant;
      ctx.strokeStyle = colour[drive.ink('blue')];
      ctx.lineWidth = 1;
      traceLong(ctx, x.length, (i) => [mx(x[i]), my(y[i])], [left - 4, top - 4, left + w * k + 4, top + h * k + 4]);
      if (!sample) continue;
      ctx.fillStyle = ctx.strokeStyle;
      ctx.beginPath();
      ctx.arc(mx(sample.x), my(sample.y), 3.5, 0, 2 * Math.PI);
      ctx.fill();
    }
    ctx.strokeStyle = colour.muted;
    ctx.strokeRect(mx(camera.x - width / 2 / camera.scale), my(camera.y + height / 2 / camera.scale),
      (width / camera.scale) * k, (height / camera.scale) * k);
    ctx.restore();
  }

  Object.assign(slalom, { drawPath, drawPlan, drawRange, drawEnd, drawVehicle, drawMap });
})(window.slalom = window.slalom || {});
