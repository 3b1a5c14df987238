// A second drive beside the first: read from the page of a drive that is dropped here, and what the
// two differ in.
(function (slalom) {
  'use strict';

  const { drives, escape, number } = slalom;
  const problem = document.getElementById('problem');
  let onAdded = () => {};
  const EXPECTED = 'expected the report.html of ‘slalom simulate’';

  /** What of a drive's summary is compared: name, key, unit, digits, factor. */
  const ROWS = [
    ['Time to goal', 'goal_time', 's', 2],
    ['Mean speed', 'mean_speed', 'm/s', 1],
    ['Least clearance', 'least_clearance', 'm', 2],
    ['Least wheel load', 'least_wheel_load', 'N', 0],
    ['Solve time, median', 'solve_time_median', 'ms', 2, 1e3],
    ['greatest', 'solve_time_max', 'ms', 2, 1e3],
    ['Cycles', 'cycles', '', 0],
    ['not solved', 'cycles_unsolved', '', 0],
    ['not verified', 'cycles_unverified', '', 0],
  ];

  /** The data of one drive in the text of its page; throws an Error that says what is wrong with it. */
  function readPage(text) {
    const { format } = drives[0].data;
    const element = new DOMParser().parseFromString(text, 'text/html').getElementById('drive-data');
    if (!element) throw new Error(`found no drive, ${EXPECTED}`);
    const damaged = new Error(`found a drive that is damaged, ${EXPECTED}`);
    let data;
    try {
      data = JSON.parse(element.textContent);
    } catch {
      throw damaged;
    }
    if (Array.isArray(data)) throw new Error(`found ${data.length} drives, expected the page of one`);
    if (data.format !== format) throw new Error(`format: found ${data.format ? `"${data.format}"` : 'none'}, expected "${format}"`);
    if (!data.plant?.t) throw damaged;
    if (!data.plant.t.length) throw new Error('found a drive in which nothing was driven');
    return data;
  }

  /** What the two scenarios differ in, each a few words. */
  function differences() {
    const [a, b] = drives.map((drive) => drive.data);
    const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
    const of = (data) => new Map(data.obstacles.map((o) => [o.name, o]));
    const [inA, inB] = [of(a), of(b)];
    const obstacles = [...new Set([...inA.keys(), ...inB.keys()])].filter((name) => !same(inA.get(name), inB.get(name)));
    const places = ['goal', 'region', 'road'].filter((name) => !same(a[name], b[name]));
    return [
      ...places,
      ...(obstacles.length ? [`obstacle${obstacles.length > 1 ? 's' : ''} ${obstacles.slice(0, 6).join(', ')}${obstacles.length > 6 ? ', …' : ''}`] : []),
      ...settings().filter(([section]) => section !== 'planner').map(([section, name]) => `${section}.${name}`),
    ];
  }

  /** Settings that differ: section, name and the two values. */
  function settings() {
    const [a, b] = drives.map((drive) => drive.data.settings);
    return Object.keys(a).flatMap((section) => Object.keys(a[section])
      .filter((name) => a[section][name] !== b[section][name])
      .map((name) => [section, name, a[section][name], b[section][name]]));
  }

  const key = (drive) => `<i class="swatch drive" style="background:var(--${drive.colour})"></i>${drive.letter}`;

  function table() {
    const values = drives.map(({ data }) => ROWS.map(([, name, , , factor = 1]) => {
      const v = data.summary[name];
      return v === null ? null : v * factor;
    }));
    const cells = (row, signed) => row.map((v, i) => {
      const text = number(v, ROWS[i][3]);
      return `<td class="num">${signed && v > 0 ? '+' : ''}${text}</td>`;
    }).join('');
    const rows = drives.map((drive, i) => `<tr><th scope="row">${key(drive)} ${escape(drive.name)}</th>
      <td class="${drive.data.outcome === 'goal' ? 'good' : 'bad'}" title="${escape(drive.data.message)}">${escape(drive.data.outcome_words)}</td>${cells(values[i])}</tr>`);
    const change = values[0].map((v, i) => (v === null || values[1][i] === null ? null : values[1][i] - v));
    return `<table class="compared"><thead><tr><th scope="col">Drive</th><th scope="col">Outcome</th>
      ${ROWS.map(([name, , unit]) => `<th scope="col" class="num">${name}${unit ? ` <span>[${unit}]</span>` : ''}</th>`).join('')}</tr></thead>
      <tbody>${rows.join('')}<tr><th scope="row">B − A</th><td></td>${cells(change, true)}</tr></tbody></table>`;
  }

  function showHead() {
    const differing = differences();
    const names = drives.map((drive) => escape(drive.name));
    const marks = drives.flatMap((drive) => drive.data.marks.map((mark) => `<p class="mark">${key(drive)}: ${escape(mark.text)}</p>`));
    document.title = `${drives.map((drive) => drive.name).join(' · ')} · compared`;
    document.querySelector('.top').innerHTML = `<div class="name both"><p class="kicker">Slalom · two drives compared</p>
      <h1>${names[0]} <span class="with">and</span> ${names[1]}</h1></div>
      ${differing.length ? `<p class="mark both" id="differing">The scenarios differ: ${escape(differing.join('; '))}</p>` : ''}
      <div class="both scroll">${table()}</div>${marks.join('')}`;
  }

  function showSettings() {
    const rows = settings().map(([section, name, a, b]) =>
      `<tr><td>${escape(section)}.${escape(name)}</td><td>${escape(a)}</td><td>${escape(b)}</td></tr>`);
    document.querySelector('.settings').innerHTML = `<details class="card" open><summary>Settings that differ</summary>
      ${rows.length ? `<table><thead><tr><th scope="col">Name</th>${drives.map((d) => `<th scope="col">${key(d)} ${escape(d.name)}</th>`).join('')}</tr></thead>
      <tbody>${rows.join('')}</tbody></table>` : '<p class="note">none</p>'}</details>`;
  }

  /** Says what there is to say of two drives; nothing for one. */
  function show() {
    document.body.classList.toggle('compared', drives.length > 1);
    if (drives.length < 2) return;
    showHead();
    showSettings();
  }

  async function take(files) {
    problem.hidden = true;
    try {
      if (files.length !== 1) throw new Error(`found ${files.length} files, expected one`);
      const text = await files[0].text().catch(() => { throw new Error(`cannot be read, ${EXPECTED}`); });
      slalom.add(readPage(text));
    } catch (error) {
      problem.textContent = `${files.length === 1 ? files[0].name + ': ' : ''}${error.message}`;
      problem.hidden = false;
      return;
    }
    onAdded();
  }

  /** `added` is called when a second drive is there. */
  function listen(added) {
    onAdded = added;
    const chooser = document.getElementById('other-drive');
    document.getElementById('compare').addEventListener('click', () => chooser.click());
    chooser.addEventListener('change', () => { take([...chooser.files]); chooser.value = ''; });
    document.addEventListener('dragover', (event) => {
      event.preventDefault();
      document.body.classList.add('dropping');
    });
    document.addEventListener('dragleave', (event) => { if (!event.relatedTarget) document.body.classList.remove('dropping'); });
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      document.body.classList.remove('dropping');
      take([...event.dataTransfer.files]);
    });
  }

  slalom.compare = { show, listen };
})(window.slalom = window.slalom || {});
