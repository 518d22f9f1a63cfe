'use strict';
// What all charts of the page share: the data, the page's colours, and when to draw again.
const data = JSON.parse(document.getElementById('data').textContent);
document.documentElement.classList.remove('static');

const element = (id) => document.getElementById(id);
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const sans = () => colour('--sans');
const rounded = (value) => (value === 0 ? '0' : Number(value.toPrecision(4)).toString().replace('-', '−'));

// Charts are canvases, which know nothing of the style sheet: they are drawn anew for another width, another colour
// scheme, and for paper, which is always light.
const drawings = [];
const draw_all = () => drawings.forEach((draw) => draw());
const widest = () => (document.documentElement.classList.contains('printing') ? 640 : 4000);
const width_of = (holder) => Math.max(240, Math.min(holder.clientWidth, widest()));

function set_up_redrawing() {
  let waiting = 0;
  let last_width = innerWidth;
  addEventListener('resize', () => {
    if (innerWidth === last_width) return;  // a phone's address bar comes and goes
    last_width = innerWidth;
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(draw_all);
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw_all);
  addEventListener('beforeprint', () => { document.documentElement.classList.add('printing'); draw_all(); });
  addEventListener('afterprint', () => { document.documentElement.classList.remove('printing'); draw_all(); });
}

function axis(label, more) {
  return { label, space: 64, labelFont: `12px ${sans()}`, font: `11px ${sans()}`, stroke: colour('--muted'), labelSize: 20,
           grid: { stroke: colour('--rule'), width: 1 }, ticks: { stroke: colour('--rule'), width: 1 },
           values: (chart, splits) => splits.map((v) => (v === null ? '' : rounded(v))), ...more };
}
