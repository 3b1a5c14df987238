// The top view: course, obstacles, vehicle, path and plan on a canvas.
(function (slalom) {
  'use strict';

  const { course, drives, span } = slalom;

  const canvas = document.getElementById('stage');
  const ctx = canvas.getContext('2d');
  const camera = { mode: 'follow', x: 0, y: 0, scale: 8, span: 90 };
  const layers = { grown: true, margins: false, path: true, plan: true, candidates: true, ghosts: true, range: false };
  /** A course that is wider than it is high has a stage that is, too, above the charts. */
  const WIDE = 1.3;
  /** Of the stage's sides, the share that two vehicles may be apart in. */
  const APART = 0.35;
  const colour = {};
  /** What everything is drawn with; x() and y() go from metres to pixels. */
  const view = {
    ctx, colour, camera, layers, width: 1, height: 1, scene: null, box: null,
    x: (x) => view.width / 2 + (x - camera.x) * camera.scale,
    y: (y) => view.height / 2 - (y - camera.y) * camera.scale,
  };
  let now = span.start;

  /** Looks anew at what there is: a drive was added. */
  function survey() {
    view.scene = course.scene();
    const box = view.box = slalom.courseBox();
    document.body.classList.toggle('wide', box.x1 - box.x0 > WIDE * (box.y1 - box.y0));
  }

  function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ['bg', 'card', 'ink', 'muted', 'line', 'grid', 'ground', 'road', 'blue',
      'vermilion', 'green', 'orange', 'purple', 'vehicle-glass', 'tyre']) {
      colour[name] = style.getPropertyValue('--' + name).trim();
    }
  }

  function fitCourse() {
    const { box } = view;
    camera.x = (box.x0 + box.x1) / 2;
    camera.y = (box.y0 + box.y1) / 2;
    camera.scale = Math.min(view.width / (box.x1 - box.x0), (view.height - 60) / (box.y1 - box.y0)) * 0.96;
  }

  /** Looks a little ahead of the vehicle, so that the plan is in view; as much as both sides allow. Two that drive stay in view. */
  function follow(samples) {
    if (!samples.length) return fitCourse();
    const { width, height } = view;
    const mean = (of) => samples.reduce((sum, s) => sum + of(s), 0) / samples.length;
    const apart = (of) => Math.max(...samples.map(of)) - Math.min(...samples.map(of));
    camera.scale = Math.min(height / camera.span, APART * width / apart((s) => s.x), APART * height / apart((s) => s.y));
    const high = height / camera.scale;
    const psi = Math.atan2(mean((s) => Math.sin(s.psi)), mean((s) => Math.cos(s.psi)));
    const ahead = Math.min(high * 0.28, (high * width) / height * 0.28 + Math.abs(Math.sin(psi)) * high * 0.2);
    camera.x = mean((s) => s.x) + Math.cos(psi) * ahead;
    camera.y = mean((s) => s.y) + Math.sin(psi) * ahead;
  }

  /** What one drive has to show at t, under the obstacles' names or over them. */
  const under = (drive, cycle, t) => {
    if (cycle && layers.range) slalom.drawRange(view, drive, cycle.plan);
    if (layers.path) slalom.drawPath(view, drive, t);
  };
  const over = (drive, cycle, sample, t) => {
    if (cycle && layers.candidates) slalom.verification.drawCandidates(view, drive, cycle);
    if (cycle && layers.plan) slalom.drawPlan(view, drive, cycle);
    if (!sample) return;
    slalom.drawVehicle(view, drive, sample);
    if (drive.data.outcome !== 'goal' && t > drive.end - 1e-9) slalom.drawEnd(view, drive, sample);
  };

  function draw(t) {
    now = t;
    const at = drives.map((drive) => ({ drive, sample: drive.sampleAt(t), cycle: drive.cycleAt(t) }));
    if (camera.mode === 'follow') follow(at.filter((one) => one.sample && !one.drive.overAt(t)).map((one) => one.sample));
    if (camera.mode === 'course') fitCourse();
    course.ground(view);
    course.goals(view);
    for (const { drive, cycle } of at) under(drive, cycle, t);
    course.obstacles(view, t);
    if (layers.ghosts) for (const { drive, cycle } of at) if (cycle) course.ghosts(view, drive, cycle);
    course.names(view, t);
    for (const { drive } of at) course.blockers(view, drive, t);
    for (const { drive, cycle, sample } of at) over(drive, cycle, sample, t);
    if (camera.mode !== 'course') slalom.drawMap(view, at, t);
  }

  function resize() {
    const ratio = window.devicePixelRatio || 1;
    const rect = canvas.getBoundingClientRect();
    view.width = Math.max(rect.width, 1);
    view.height = Math.max(rect.height, 1);
    canvas.width = Math.round(view.width * ratio);
    canvas.height = Math.round(view.height * ratio);
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
      const x = camera.x + (px - view.width / 2) / camera.scale;
      const y = camera.y - (py - view.height / 2) / camera.scale;
      camera.scale = Math.min(Math.max(camera.scale * factor, 0.05), 200);
      camera.x = x - (px - view.width / 2) / camera.scale;
      camera.y = y + (py - view.height / 2) / camera.scale;
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
      if (!drag) {
        canvas.title = course.wordsAt(view, now, event.offsetX, event.offsetY);
        return;
      }
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
    document.getElementById('zoom-in').addEventListener('click', () => zoom(1.3, view.width / 2, view.height / 2));
    document.getElementById('zoom-out').addEventListener('click', () => zoom(1 / 1.3, view.width / 2, view.height / 2));
    for (const name of Object.keys(layers)) {
      const toggle = document.getElementById('layer-' + name);
      layers[name] = toggle.checked;
      toggle.addEventListener('change', () => { layers[name] = toggle.checked; draw(now); });
    }
    window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readColours(); draw(now); });
    new ResizeObserver(resize).observe(canvas);
  }

  readColours();
  survey();
  listen();
  resize();
  slalom.stage = { draw, survey, setMode, pixelOf: (x, y) => [view.x(x), view.y(y)], zoom: (factor) => zoom(factor, view.width / 2, view.height / 2) };
})(window.slalom = window.slalom || {});
