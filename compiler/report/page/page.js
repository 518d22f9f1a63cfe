'use strict';
// What all charts of the page share: the data, the page's colours, and when to draw again.
const data = JSON.parse(document.getElementById('data').textContent);
document.documentElement.classList.remove('static');

const element = (id) => document.getElementById(id);
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const sans = () => colour('--sans');
// Four digits; far from 1 as 2.5×10⁻⁷.
function rounded(value) {
  if (value === 0 || !isFinite(value)) return value === 0 ? '0' : String(value);
  const size = Math.abs(value), sign = value < 0 ? '−' : '';
  const exponent = Number(size.toExponential(3).split('e')[1]);
  if (exponent >= -3 && exponent <= 5) return sign + Number(size.toPrecision(4)).toString();
  const mantissa = Number((size / 10 ** exponent).toPrecision(4));
  const power = '10' + [...String(exponent)].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c])).join('');
  return sign + (mantissa === 1 ? power : `${mantissa}×${power}`);
}

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

// Where something is wider than the page, its cut edge fades, on the side where more is to be had.
function set_up_scroll_cues() {
  const show = (part) => {
    part.classList.toggle('more-right', part.scrollLeft + part.clientWidth < part.scrollWidth - 1);
    part.classList.toggle('more-left', part.scrollLeft > 1);
  };
  const parts = [...document.querySelectorAll('.wide')];
  const show_all = () => parts.forEach(show);
  for (const part of parts) {
    part.addEventListener('scroll', () => show(part), { passive: true });
    if (part.scrollWidth > part.clientWidth + 1) part.tabIndex = 0;  // keys scroll it too
  }
  drawings.push(show_all);
  document.fonts?.ready.then(show_all);
  show_all();
}

// As wide as the widest of the numbers that stand at it, its ticks and its title.
function room_for(values, canvas) {
  const ctx = canvas.getContext('2d');
  ctx.save();
  ctx.font = `11px ${sans()}`;
  const widest = Math.max(0, ...(values ?? []).map((text) => ctx.measureText(text).width));
  ctx.restore();
  return Math.ceil(widest) + 28;
}
const numbers_wide = { size: (chart, values) => room_for(values, chart.ctx.canvas) };

// A legend is a key of colours; the values join it only while the pointer says of where.
const quiet_legend = {
  init: [(chart) => chart.root.classList.add('idle')],
  setCursor: [(chart) => chart.root.classList.toggle('idle', chart.cursor.idx === null || chart.cursor.idx === undefined)],
};

function axis(label, more) {
  return { label, space: 64, labelFont: `12px ${sans()}`, font: `11px ${sans()}`, stroke: colour('--muted'), labelSize: 20,
           grid: { stroke: colour('--rule'), width: 1 }, ticks: { stroke: colour('--rule'), width: 1 },
           values: (chart, splits) => splits.map((v) => (v === null ? '' : rounded(v))), ...more };
}
