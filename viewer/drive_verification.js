// What a planner that verifies its plans says of them: where each comes from, what is known of it
// and which motions it looked at. Drives of other planners have none of this.
(function (slalom) {
  'use strict';

  const { drives, span, number, escape } = slalom;

  /** Best first, as the planner chooses: the words of the legend. */
  const RUNGS = { new: 'new', rest: 'rest of the last', least_bad: 'least bad, unverified' };

  /** Colours the time line by the plan being driven; plans of one rung in a row are one piece. */
  function strip(drive) {
    const strip = document.createElement('div');
    const share = (t) => (100 * (t - span.start)) / Math.max(span.end - span.start, 1e-9);
    let last = null;
    for (const cycle of drive.driven) {
      const from = share(cycle.t_swap);
      if (last) last.style.right = `${100 - from}%`;
      if (last && last.className === cycle.rung) continue;
      last = document.createElement('i');
      last.className = cycle.rung;
      last.style.left = `${from}%`;
      strip.appendChild(last);
    }
    if (last) last.style.right = `${100 - share(drive.end)}%`;
    return strip;
  }

  function legend(drive) {
    const keys = Object.entries(RUNGS).map(([rung, words]) =>
      `<span class="key"><i class="swatch rung ${rung}"></i>${words} <b>${drive.data.rungs[rung]}</b></span>`);
    return `<span>Plans${drives.length > 1 ? ` of ${drive.letter}` : ''}:</span>${keys.join('')}`;
  }

  /** The strips and their legend, of the drives there are now whose planners verify. */
  function show() {
    const verifying = drives.filter((drive) => drive.data.rungs);
    document.getElementById('rungs').replaceChildren(...verifying.map(strip));
    const words = document.getElementById('rung-legend');
    words.innerHTML = verifying.map(legend).join('');
    words.hidden = document.getElementById('candidates-key').hidden = !verifying.length;
    if (verifying.length) document.getElementById('plan-words').textContent = 'plan, dashed from the next swap on';
  }

  /** Names and values for the panel of a cycle. */
  function facts(cycle) {
    if (!cycle.rung) return [];
    const c = cycle.certificate;
    return [
      ['Comes from', RUNGS[cycle.rung]],
      ['Verified', c.verified ? `until ${number(c.until, 2)} s` : `<span class="bad">no: ${escape(c.refused)}</span>`],
      ['Its least clearance', c.nearest ? `${number(c.clearance, 2)} m <small>to ${escape(c.nearest)}</small>` : '–'],
      ['Its least wheel load', `${number(c.wheel_load, 0)} N`],
    ];
  }

  /** The candidates of a cycle as a table; the one that was taken stands out. */
  function table(cycle) {
    if (cycle.rung && !cycle.candidates) return '<p class="sub">What else there was is left out of the page of so long a drive.</p>';
    if (!cycle.candidates || !cycle.candidates.length) return '';
    const certificate = JSON.stringify(cycle.certificate);
    const taken = cycle.candidates.findIndex((c) => JSON.stringify(c.certificate) === certificate
      && (c.cost === null || c.cost === cycle.cost));
    const rows = cycle.candidates.map(({ name, cost, certificate: c }, i) => `<tr${i === taken ? ' class="taken"' : ''}>
      <td>${escape(name)}</td><td class="num">${number(cost, 2)}</td>
      <td class="num">${number(c.clearance, 2)}</td><td>${escape(c.nearest)}</td><td class="num">${number(c.wheel_load, 0)}</td>
      <td>${c.verified ? `verified until ${number(c.until, 2)} s` : `<span class="bad">refused: ${escape(c.refused)}</span>`}${i === taken ? ', driven' : ''}</td></tr>`);
    return `<div class="scroll"><table class="candidates"><thead><tr><th scope="col">Candidate</th><th scope="col" class="num">Cost</th>
      <th scope="col" class="num">Clearance [m]</th><th scope="col">to</th><th scope="col" class="num">Wheel load [N]</th><th scope="col">Verdict</th></tr></thead>
      <tbody>${rows.join('')}</tbody></table></div>`;
  }

  /** What would be driven in place of a new plan: the rest of the last, which is looked at first, if that is verified. */
  const isFallback = (cycle, candidate, i) => i === 0 && cycle.rung === 'new' && candidate.name === 'rest' && candidate.certificate.verified;

  /** Where the motions lead that a cycle looked at: faint lines, and dashed what would be driven in place of a new plan. */
  function drawCandidates(view, drive, cycle) {
    const { ctx, colour } = view;
    if (!cycle.candidates) return;
    ctx.save();
    ctx.lineWidth = 1.5;
    ctx.lineJoin = 'round';
    ctx.strokeStyle = colour[drive.ink('purple')];
    cycle.candidates.forEach((candidate, i) => {
      const fallback = isFallback(cycle, candidate, i);
      ctx.globalAlpha = fallback ? 0.9 : 0.35;
      ctx.setLineDash(fallback ? [7, 5] : []);
      ctx.beginPath();
      for (const [x, y] of candidate.path) ctx.lineTo(view.x(x), view.y(y));
      ctx.stroke();
    });
    ctx.restore();
  }

  slalom.verification = { show, facts, table, drawCandidates };
})(window.slalom = window.slalom || {});
