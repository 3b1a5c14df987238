// Parts of the top view: the vehicle, and the whole course in a corner.
(function (slalom) {
  'use strict';

  const { data } = slalom;
  const { obstacles, vehicle, goal } = data;

  function roundRect(ctx, x, y, w, h, r) {
    ctx.beginPath();
    ctx.moveTo(x + r, y);
    ctx.arcTo(x + w, y, x + w, y + h, r);
    ctx.arcTo(x + w, y + h, x, y + h, r);
    ctx.arcTo(x, y + h, x, y, r);
    ctx.arcTo(x, y, x + w, y, r);
    ctx.closePath();
  }

  /**
   * The vehicle with the front axle's centre, its reference point, at (px, py) of the canvas.
   * Never smaller than 16 pixels.
   */
  function drawVehicle(ctx, colour, sample, px, py, scale) {
    const s = Math.max(scale, 16 / vehicle.length);
    const wheelbase = (vehicle.la + vehicle.lb) * s;
    const l = vehicle.length * s;
    const w = vehicle.width * s;
    const front = Math.max((l - wheelbase) / 2, 0);
    ctx.save();
    ctx.translate(px, py);
    ctx.rotate(-sample.psi);
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
    ctx.fillStyle = colour.blue;
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
  function drawMap(ctx, colour, box, sample, t, camera) {
    const { width, height } = camera;
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
    ctx.fillStyle = colour.green;
    ctx.globalAlpha = 0.3;
    ctx.fillRect(mx(goal.x - goal.sigma), my(goal.y + goal.sigma), 2 * goal.sigma * k, 2 * goal.sigma * k);
    ctx.globalAlpha = 1;
    ctx.fillStyle = colour.vermilion;
    for (const o of obstacles) {
      const p = slalom.obstacleAt(o, t);
      ctx.beginPath();
      ctx.ellipse(mx(p.x), my(p.y), Math.max(o.a * k, 1), Math.max(o.b * k, 1), 0, 0, 2 * Math.PI);
      ctx.fill();
    }
    ctx.strokeStyle = colour.blue;
    ctx.lineWidth = 1;
    ctx.beginPath();
    data.plant.x.forEach((x, i) => (i ? ctx.lineTo(mx(x), my(data.plant.y[i])) : ctx.moveTo(mx(x), my(data.plant.y[i]))));
    ctx.stroke();
    if (sample) {
      ctx.fillStyle = colour.blue;
      ctx.beginPath();
      ctx.arc(mx(sample.x), my(sample.y), 3.5, 0, 2 * Math.PI);
      ctx.fill();
    }
    ctx.strokeStyle = colour.muted;
    ctx.strokeRect(mx(camera.x - width / 2 / camera.scale), my(camera.y + height / 2 / camera.scale),
      (width / camera.scale) * k, (height / camera.scale) * k);
    ctx.restore();
  }

  Object.assign(slalom, { drawVehicle, drawMap });
})(window.slalom = window.slalom || {});
