// What a figure looks like in print, at 8 cm or, if it is made for two columns, at its own width: its smallest letters, its thinnest line, words that run into each other.
const COLUMN_PT = 8 / 2.54 * 72;

/** Sizes in points at that width; `overlaps` and `outside` name the words concerned. */
export function legibility(page) {
  return page.evaluate((narrow) => {
    const svg = document.querySelector('svg');
    const own = parseFloat(svg.getAttribute('width'));
    const column = own > 1.01 * narrow ? own : narrow;
    const frame = svg.getBoundingClientRect();
    const scale = column / svg.viewBox.baseVal.width;  // points in print a unit of the picture
    const pixel = svg.viewBox.baseVal.width / frame.width;
    const texts = [...svg.querySelectorAll('text')].filter((t) => t.textContent.trim());
    const font = Math.min(...texts.map((t) => parseFloat(t.getAttribute('font-size')) * scale));
    const widths = [...svg.querySelectorAll('[stroke-width]')]
      .map((e) => parseFloat(e.getAttribute('stroke-width')) * scale).filter((w) => w > 0);
    // A text's box is its line's, with room above and below the letters; take that away.
    const boxes = texts.map((t) => {
      const size = parseFloat(t.getAttribute('font-size')) / pixel;
      const { left, right, top, bottom } = t.getBoundingClientRect();
      const turned = bottom - top > right - left && t.hasAttribute('transform');
      const slack = 0.18 * size;
      return turned ? { left: left + slack, right: right - slack, top, bottom, text: t.textContent }
        : { left, right, top: top + slack, bottom: bottom - slack, text: t.textContent };
    });
    const overlaps = [];
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => {
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (wide > 0.3 && high > 0.3) overlaps.push(`"${a.text}" and "${b.text}"`);
    }));
    const outside = boxes.filter((b) => b.left < frame.left - 0.5 || b.right > frame.right + 0.5
      || b.top < frame.top - 1 || b.bottom > frame.bottom + 1).map((b) => b.text);
    return { font, line: Math.min(...widths), words: texts.length, overlaps, outside };
  }, COLUMN_PT);
}
