// A click on a trial's mark tells its figures and opens its drive: the one kept beside the page, or,
// where `slalom study-report --serve` shows the page, one driven again.
(function () {
  'use strict';

  const { trials, kept } = JSON.parse(document.getElementById('sweep-data').textContent);
  const dialog = document.getElementById('trial');
  const served = location.protocol.startsWith('http');
  const there = new Set(kept);

  function element(name, text, attributes = {}) {
    const made = document.createElement(name);
    made.textContent = text;
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  }

  function facts(number) {
    const list = element('dl', '', { class: 'trial-facts' });
    for (const [name, value] of trials[number] || []) {
      if (name !== '') list.append(element('dt', name), element('dd', value));
      else list.append(element('dd', value, { class: 'said' }));
    }
    return list;
  }

  function way(number) {
    const folder = `drives/${number.padStart(6, '0')}`;
    if (served || there.has(Number(number))) {
      return element('a', 'Open the drive', { href: `${folder}/report.html`, class: 'open', target: '_blank' });
    }
    const text = element('p', 'This drive was not kept. To see it, drive it again:');
    text.append(element('code', `slalom study-report DIR --trial ${number}`));
    text.append(document.createTextNode('or have it driven at a click:'));
    text.append(element('code', 'slalom study-report DIR --serve'));
    return text;
  }

  function show(numbers) {
    const parts = dialog.querySelector('div');
    parts.replaceChildren();
    for (const number of numbers) {
      parts.append(element('h3', `Trial ${number}`), facts(number), way(number));
    }
    dialog.showModal();
  }

  for (const mark of document.querySelectorAll('[data-mark]')) {
    const numbers = mark.dataset.mark.split(' ');
    mark.setAttribute('tabindex', '0');
    mark.setAttribute('role', 'button');
    mark.setAttribute('aria-label', `trial ${numbers.join(', ')}`);
    mark.addEventListener('click', () => show(numbers));
    mark.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' || event.key === ' ') {
        event.preventDefault();
        show(numbers);
      }
    });
  }
  dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
})();
