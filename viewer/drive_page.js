// Playback: the one time all views share, its slider, keys and the words beside it.
(function (slalom) {
  'use strict';

  const { drives, span, number, escape, stage, charts, choice, compare, verification } = slalom;
  const slider = document.getElementById('time');
  const timeText = document.getElementById('time-text');
  const readout = document.getElementById('readout');
  const playButton = document.getElementById('play');
  const speed = document.getElementById('speed');
  let playing = false;
  let last = 0;
  let shownStates = [];

  function setTime(t) {
    slalom.now = Math.min(Math.max(t, span.start), span.end);
    slider.value = String(slalom.now);
    slider.setAttribute('aria-valuetext', number(slalom.now, 2) + ' seconds');
    timeText.innerHTML = `<b>${number(slalom.now, 2)}</b> of ${number(span.end, 2)} s`;
    stage.draw(slalom.now);
    charts.moveTo(slalom.now);
    showState();
    showCycles();
  }

  function stateWords(drive) {
    const s = drive.sampleAt(slalom.now);
    if (!s) return 'nothing was driven';
    const place = `x ${number(s.x, 2)} m   y ${number(s.y, 2)} m`;
    if (drives.length > 1) return `${drive.letter}   ${place}`;
    return `${place}\nheading ${number(s.psi * 180 / Math.PI, 1)}°   yaw rate ${number(s.r * 180 / Math.PI, 1)}°/s`;
  }

  function showState() {
    readout.textContent = drives.map(stateWords).join('\n');
  }

  function fact(name, value) {
    return `<div><dt>${name}</dt><dd>${value}</dd></div>`;
  }

  function costTerms(cycle) {
    return `<div class="terms"><span>Cost <b>${number(cycle.cost, 2)}</b> =</span>
      ${cycle.terms.map(([name, value]) => `<span>${escape(name)} <b>${number(value, 3)}</b></span>`).join('')}</div>`;
  }

  /** What the plans being driven are. */
  function showCycles() {
    const cycles = drives.map((drive) => drive.cycleAt(slalom.now));
    const failed = drives.map((drive) => drive.failedAt(slalom.now));
    const states = [...drives.map((drive, i) => drive.overAt(slalom.now) || cycles[i]), ...failed];
    if (states.length === shownStates.length && states.every((state, i) => state === shownStates[i])) return;
    shownStates = states;
    const words = new Set(cycles.map(ghostWords));
    document.getElementById('ghost-words').textContent = words.size === 1 ? [...words][0] : ghostWords(null);
    document.getElementById('cycle').innerHTML = drives.map((drive, i) => {
      const head = drives.length > 1 ? `<h3><i class="swatch drive" style="background:var(--${drive.colour})"></i>${drive.letter} ${escape(drive.name)}</h3>` : '';
      return `<div>${head}${drive.overAt(slalom.now) ? `<p class="sub">${escape(drive.data.outcome_words)}: the drive is over.</p>` : failedWords(failed[i]) + cycleWords(cycles[i])}</div>`;
    }).join('');
  }

  /** Where the dashed outlines on the stage are. */
  function ghostWords(cycle) {
    if (!cycle) return 'where the plan expects obstacles';
    if (cycle.plan.held !== null) return 'obstacles as the plan holds them';
    return cycle.rung ? 'obstacles along the plan and at its end' : 'obstacles at the plan’s nodes and end';
  }

  /** A cycle that gave no plan, and what was in the way. */
  function failedWords(cycle) {
    if (!cycle) return '';
    return `<p class="bad failed">Cycle ${cycle.index} was not solved, ${escape(cycle.status)}${cycle.blocks ? `: ${escape(cycle.blocks)}` : ''}</p>`;
  }

  /** A plan in words and numbers. */
  function cycleWords(cycle) {
    if (!cycle) return '<p class="sub">None yet: the vehicle goes straight on at constant speed until the first plan takes over.</p>';
    const { plan } = cycle;
    return `<div class="row"><dl>
      ${fact('Cycle', `${cycle.index}${cycle.left_out ? ` <small>the next ${cycle.left_out} are left out</small>` : ''}`)}
      ${fact('Planned during', `${number(cycle.t0, 2)} – ${number(cycle.t0 + cycle.tex, 2)} s`)}
      ${fact('Horizon tf', `${number(plan.tf, 2)} s`)}
      ${fact('Solve time', `${number(cycle.wall, 3)} s <small>CPU ${number(cycle.cpu, 3)} s</small>`)}
      ${fact('Solver', `${cycle.rung ? '' : escape(cycle.status) + ', '}${cycle.iterations} iterations`)}
      ${cycle.start_slack[0] > 0.005 || cycle.start_slack[1] > 0.05 ? fact('Begins', `${number(cycle.start_slack[0], 2)} m and ${number(cycle.start_slack[1], 1)}° beside the vehicle`) : ''}
      ${cycle.blocks ? fact('What blocks', escape(cycle.blocks)) : ''}
      ${cycle.passage ? fact(cycle.passage[2] > 0 ? 'Soft rows' : 'Between nodes', `${number(cycle.passage[0], 2)} m into the margin of ${escape(cycle.passage[1])}${cycle.passage[2] > 0 ? `, up to ${number(cycle.passage[2], 2)} m at nodes` : ''}`) : ''}
      ${cycle.road_exit ? fact('Between nodes', `${number(cycle.road_exit[0], 2)} m off the road at its ${cycle.road_exit[1]} edge`) : ''}
      ${fact('Goal', cycle.goal_in_range ? 'in range' : 'out of range')}
      ${fact('Obstacles', plan.held !== null ? `held where they are at ${number(plan.held, 2)} s` : 'move as predicted')}
      ${cycle.worst ? fact('Largest violation', `${escape(cycle.worst)} <small>${cycle.violation === null ? '' : cycle.violation.toExponential(1)}</small>`) : ''}
      ${verification.facts(cycle).map(([name, value]) => fact(name, value)).join('')}
      </dl></div>
      ${cycle.terms.length ? costTerms(cycle) : ''}
      ${verification.table(cycle)}`;
  }

  function setPlaying(on) {
    playing = on && span.end > span.start;
    document.body.classList.toggle('playing', playing);
    playButton.setAttribute('aria-label', playing ? 'Pause' : 'Play');
    if (!playing) return;
    if (slalom.now >= span.end) setTime(span.start);
    last = performance.now();
    requestAnimationFrame(frame);
  }

  function frame(at) {
    if (!playing) return;
    const t = slalom.now + Math.max(at - last, 0) / 1000 * Number(speed.value);
    last = at;
    setTime(t);
    if (t >= span.end) setPlaying(false); else requestAnimationFrame(frame);
  }

  function seek(t) {
    setPlaying(false);
    setTime(t);
  }

  /** The next or last instant at which a plan takes over. */
  function neighbour(direction) {
    const { start, end } = span;
    const plans = drives.flatMap(({ data }) => data.cycles.filter((c) => c.used).map((c) => c.t_swap));
    const times = [start, ...plans.sort((a, b) => a - b), end];
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
      Home: () => seek(span.start),
      End: () => seek(span.end),
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

  /** Marks on the time line: what happened when. */
  function showMarks() {
    const line = document.getElementById('marks');
    line.replaceChildren();
    for (const drive of drives) {
      const { data, end } = drive;
      const there = new Set();
      const add = (t, kind, title) => {
        // Of those that cannot be told apart, one.
        const key = `${Math.round(2000 * (t - span.start) / Math.max(span.end - span.start, 1e-9))} ${kind}`;
        if (there.has(key)) return;
        there.add(key);
        const mark = document.createElement('i');
        mark.className = kind;
        mark.title = (drives.length > 1 ? `${drive.letter}: ` : '') + title;
        mark.style.left = `${(100 * (t - span.start)) / Math.max(span.end - span.start, 1e-9)}%`;
        if (drives.length > 1) mark.style.background = `var(--${drive.colour})`;
        line.appendChild(mark);
      };
      if (data.goal_time !== null) add(data.goal_time, 'goal', 'goal reached');
      if (data.least_clearance_t !== null) add(data.least_clearance_t, 'near', 'least clearance');
      if (data.outcome !== 'goal' && data.plant.t.length) add(end, 'bad', data.outcome);
      for (const m of data.marks) for (const t of m.times) add(Math.min(t, end), 'bad', m.text);
      for (const c of drive.clocked) if (!c.solved) add(Math.min(c.t0 + c.tex, end), 'bad', 'not solved' + (c.blocks ? ': ' + c.blocks : ''));
    }
  }

  /** What the page of a long drive leaves out. */
  function leftOutWords(drive) {
    const { samples, cycles, detailed, nodes } = drive.data.left_out;
    const of = ([kept, all], what) => (kept < all ? `${kept} of ${all} ${what}` : `all ${all} ${what}`);
    const whose = drives.length > 1 ? `${drive.letter}: ` : '';
    if (samples[0] === samples[1] && detailed === cycles[1]) return `${whose}Each plan is drawn by up to ${nodes} of its nodes; plans.csv has them all.`;
    return `${whose}This drive is too long for a page of all of it: here are ${of(samples, 'samples')}
      (among them the dips of wheel load and clearance) and ${of(cycles, 'cycles')} (among them those that failed, changed something or were the worst),
      ${detailed < cycles[0] ? `${detailed} of these with cost terms and candidates` : 'with cost terms and candidates'}${nodes === null ? '' : `, and up to ${nodes} nodes of each plan`}.
      The CSV files beside the page have all samples, cycles and nodes.`;
  }

  function showLeftOut() {
    const words = document.getElementById('left-out');
    const long = drives.filter((drive) => drive.data.left_out);
    words.textContent = long.map(leftOutWords).join(' ').replace(/\s+/g, ' ');
    words.hidden = !long.length;
    document.getElementById('blocker-key').hidden = !drives.some((drive) => drive.data.cycles.some((c) => c.blocker));
  }

  /** Shows the drives that there are now, from the time it was at. */
  function refresh() {
    slider.min = String(span.start);
    slider.max = String(Math.max(span.end, span.start + 1e-9));
    shownStates = [];
    compare.show();
    stage.survey();
    showMarks();
    showLeftOut();
    verification.show();
    choice.refresh();
    setTime(slalom.now);
  }

  // report.html#t=3.2 opens the page at that instant.
  window.addEventListener('hashchange', () => {
    if (choice.fromAddress()) choice.refresh();
    setTime(choice.timeInAddress() ?? slalom.now);
  });
  choice.fromAddress();
  slalom.now = choice.timeInAddress() ?? span.start;
  charts.listen(seek);
  compare.listen(refresh);
  slider.addEventListener('input', () => seek(Number(slider.value)));
  playButton.addEventListener('click', () => setPlaying(!playing));
  playButton.addEventListener('keyup', (event) => { if (event.key === ' ') event.preventDefault(); });
  document.addEventListener('keydown', onKey);
  refresh();
})(window.slalom = window.slalom || {});
