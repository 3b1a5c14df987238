// Playback: the one time all views share, its slider, keys and the words beside it.
(function (slalom) {
  'use strict';

  const { data, start, end, number, escape, stage, charts, verification } = slalom;
  const slider = document.getElementById('time');
  const timeText = document.getElementById('time-text');
  const readout = document.getElementById('readout');
  const playButton = document.getElementById('play');
  const speed = document.getElementById('speed');
  let playing = false;
  let last = 0;
  let shownCycle;

  function setTime(t) {
    slalom.now = Math.min(Math.max(t, start), end);
    slider.value = String(slalom.now);
    slider.setAttribute('aria-valuetext', number(slalom.now, 2) + ' seconds');
    timeText.innerHTML = `<b>${number(slalom.now, 2)}</b> of ${number(end, 2)} s`;
    stage.draw(slalom.now);
    charts.moveTo(slalom.now);
    showState();
    showCycle();
  }

  function showState() {
    const s = slalom.sampleAt(data.plant, slalom.now);
    readout.textContent = s
      ? `x ${number(s.x, 2)} m   y ${number(s.y, 2)} m\nheading ${number(s.psi * 180 / Math.PI, 1)}°   yaw rate ${number(s.r * 180 / Math.PI, 1)}°/s`
      : 'nothing was driven';
  }

  function fact(name, value) {
    return `<div><dt>${name}</dt><dd>${value}</dd></div>`;
  }

  function costTerms(cycle) {
    return `<div class="terms"><span>Cost <b>${number(cycle.cost, 2)}</b> =</span>
      ${cycle.terms.map(([name, value]) => `<span>${escape(name)} <b>${number(value, 3)}</b></span>`).join('')}</div>`;
  }

  /** What the plan being driven is, in words and numbers. */
  function showCycle() {
    const cycle = slalom.cycleAt(slalom.now);
    if (cycle === shownCycle) return;
    shownCycle = cycle;
    const words = document.getElementById('ghost-words');
    const panel = document.getElementById('cycle');
    if (!cycle) {
      words.textContent = 'where the plan expects obstacles';
      panel.innerHTML = '<p class="sub">None yet: the vehicle goes straight on at constant speed until the first plan takes over.</p>';
      return;
    }
    const plan = cycle.plan;
    const held = plan.held !== null;
    words.textContent = held ? 'obstacles as the plan holds them' : cycle.rung ? 'obstacles along the plan and at its end' : 'obstacles at the plan’s nodes and end';
    panel.innerHTML = `<div class="row"><dl>
      ${fact('Cycle', cycle.index)}
      ${fact('Planned during', `${number(cycle.t0, 2)} – ${number(cycle.t0 + cycle.tex, 2)} s`)}
      ${fact('Horizon tf', `${number(plan.tf, 2)} s`)}
      ${fact('Solve time', `${number(cycle.wall, 3)} s <small>CPU ${number(cycle.cpu, 3)} s</small>`)}
      ${fact('Solver', `${cycle.rung ? '' : escape(cycle.status) + ', '}${cycle.iterations} iterations`)}
      ${cycle.start_slack[0] > 0.005 || cycle.start_slack[1] > 0.05 ? fact('Begins', `${number(cycle.start_slack[0], 2)} m and ${number(cycle.start_slack[1], 1)}° beside the vehicle`) : ''}
      ${cycle.blocks ? fact('What blocks', escape(cycle.blocks)) : ''}
      ${cycle.passage ? fact('Between nodes', `${number(cycle.passage[0], 2)} m into the margin of ${escape(cycle.passage[1])}`) : ''}
      ${fact('Goal', cycle.goal_in_range ? 'in range' : 'out of range')}
      ${fact('Obstacles', held ? `held where they are at ${number(plan.held, 2)} s` : 'move as predicted')}
      ${cycle.worst ? fact('Largest violation', `${escape(cycle.worst)} <small>${cycle.violation === null ? '' : cycle.violation.toExponential(1)}</small>`) : ''}
      ${verification.facts(cycle).map(([name, value]) => fact(name, value)).join('')}
      </dl></div>
      ${cycle.terms.length ? costTerms(cycle) : ''}
      ${verification.table(cycle)}`;
  }

  function setPlaying(on) {
    playing = on && end > start;
    document.body.classList.toggle('playing', playing);
    playButton.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    if (!playing) return;
    if (slalom.now >= end) setTime(start);
    last = performance.now();
    requestAnimationFrame(frame);
  }

  function frame(at) {
    if (!playing) return;
    const t = slalom.now + Math.max(at - last, 0) / 1000 * Number(speed.value);
    last = at;
    setTime(t);
    if (t >= end) setPlaying(false); else requestAnimationFrame(frame);
  }

  function seek(t) {
    setPlaying(false);
    setTime(t);
  }

  /** The next or last instant at which a plan takes over. */
  function neighbour(direction) {
    const times = [start, ...data.cycles.filter((c) => c.used).map((c) => c.plan.t_start), end];
    return direction > 0
      ? times.find((t) => t > slalom.now + 1e-6) ?? end
      : [...times].reverse().find((t) => t < slalom.now - 1e-6) ?? start;
  }

  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (['SELECT', 'SUMMARY'].includes(event.target.tagName)) return;
    const actions = {
      ' ': () => setPlaying(!playing),
      ArrowLeft: () => seek(event.shiftKey ? neighbour(-1) : slalom.now - 0.1),
      ArrowRight: () => seek(event.shiftKey ? neighbour(1) : slalom.now + 0.1),
      Home: () => seek(start),
      End: () => seek(end),
      f: () => stage.setMode('follow'),
      c: () => stage.setMode('course'),
      '+': () => stage.zoom(1.3),
      '-': () => stage.zoom(1 / 1.3),
    };
    const action = actions[event.key];
    if (!action) return;
    // The space bar presses a focused button or box; it plays everywhere else.
    const presses = event.target.tagName === 'BUTTON' || event.target.type === 'checkbox';
    if (event.key === ' ' && presses && event.target !== playButton) return;
    event.preventDefault();
    action();
  }

  function addMark(t, kind, title) {
    const mark = document.createElement('i');
    mark.className = kind;
    mark.title = title;
    mark.style.left = `${(100 * (t - start)) / Math.max(end - start, 1e-9)}%`;
    document.getElementById('marks').appendChild(mark);
  }

  function addMarks() {
    if (data.goal_time !== null) addMark(data.goal_time, 'goal', 'goal reached');
    if (data.least_clearance_t !== null) addMark(data.least_clearance_t, 'near', 'least clearance');
    if (data.outcome !== 'goal' && data.plant.t.length) addMark(end, 'bad', data.outcome);
    for (const m of data.marks) for (const t of m.times) addMark(Math.min(t, end), 'bad', m.text);
    for (const c of data.cycles) if (c.index > 0 && !c.solved) addMark(Math.min(c.t0 + c.tex, end), 'bad', 'not solved' + (c.blocks ? ': ' + c.blocks : ''));
  }

  slider.min = String(start);
  slider.max = String(Math.max(end, start + 1e-9));
  slalom.now = start;
  charts.build(seek);
  addMarks();
  slider.addEventListener('input', () => seek(Number(slider.value)));
  playButton.addEventListener('click', () => setPlaying(!playing));
  playButton.addEventListener('keyup', (event) => { if (event.key === ' ') event.preventDefault(); });
  document.addEventListener('keydown', onKey);
  // report.html#t=3.2 opens the page at that instant.
  const fromAddress = () => {
    const match = /^#t=(-?[\d.]+)$/.exec(location.hash);
    setTime(match ? Number(match[1]) : slalom.now);
  };
  window.addEventListener('hashchange', fromAddress);
  fromAddress();
})(window.slalom = window.slalom || {});
