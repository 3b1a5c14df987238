// Which signals are shown: chosen in a menu, and kept in the page's address beside the time.
(function (slalom) {
  'use strict';

  const { charts, escape, signals } = slalom;
  const menu = document.getElementById('signals');
  let chosen = null;  // keys, or null for the usual ones

  const shown = () => signals.offered().filter((s) => (chosen ? chosen.has(s.key) : s.usual));

  /** What the page's address says after '#': t [s], and the keys of the signals shown. */
  const inAddress = () => new URLSearchParams(location.hash.slice(1));

  /** The time in the address [s], or null. */
  function timeInAddress() {
    const t = inAddress().get('t');
    return t !== null && /^-?\d+\.?\d*$/.test(t) ? Number(t) : null;
  }

  const inWords = () => (chosen ? `&show=${[...chosen].join(',')}` : '');
  const known = (key) => signals.offered().some((s) => s.key === key);

  function toAddress() {
    history.replaceState(null, '', `#t=${Number(slalom.now.toFixed(3))}${inWords()}`);
  }

  /** Takes the choice from the address, the usual signals where it has none; whether it is another than before. */
  function fromAddress() {
    const show = inAddress().get('show');
    const before = inWords();
    chosen = show === null ? null : new Set(show.split(',').filter((key) => known(key)));
    return inWords() !== before;
  }

  /** Draws menu and charts anew. */
  function refresh() {
    const now = new Set(shown().map((s) => s.key));
    const label = (s) => `<label><input type="checkbox" value="${s.key}"${now.has(s.key) ? ' checked' : ''}>
      ${escape(s.what)} <span class="unit">[${escape(s.unit)}]</span></label>`;
    const groups = [...new Set(signals.offered().map((s) => s.group))].map((group) => `<fieldset><legend>${escape(group)}</legend>
      ${signals.offered().filter((s) => s.group === group).map(label).join('')}</fieldset>`);
    menu.innerHTML = groups.join('') + '<button type="button">The usual ones</button>';
    charts.show(shown());
  }

  menu.addEventListener('change', () => {
    chosen = new Set([...menu.querySelectorAll('input:checked')].map((box) => box.value));
    charts.show(shown());
    toAddress();
  });
  menu.addEventListener('click', (event) => {
    if (event.target.tagName !== 'BUTTON') return;
    chosen = null;
    refresh();
    toAddress();
  });
  // A click beside an open menu closes it, as Escape does.
  const details = menu.closest('details');
  document.addEventListener('pointerdown', (event) => { if (!details.contains(event.target)) details.open = false; });
  document.addEventListener('keydown', (event) => { if (event.key === 'Escape') details.open = false; });

  slalom.choice = { timeInAddress, fromAddress, refresh };
})(window.slalom = window.slalom || {});
