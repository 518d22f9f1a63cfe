// The two figures whose plane separates the candidates most: in which the most pairs of them can be told apart, and of equals the
// one with the greatest sum of distances; each figure as a share of its largest value, as the axes show it. A candidate without
// a figure does not count there.
const apart = 0.05;  // of the axes: a point's own size
function most_telling_pair(candidates, count) {
  const largest = Array.from({ length: count }, (_, i) => Math.max(...candidates.map((c) => Math.abs(c.values[i] ?? 0))) || 1);
  let best = [0, Math.min(1, count - 1)], most = [-1, 0];
  for (let x = 0; x < count; ++x)
    for (let y = x + 1; y < count; ++y) {
      const points = candidates.filter((c) => c.values[x] !== null && c.values[y] !== null)
        .map((c) => [c.values[x] / largest[x], c.values[y] / largest[y]]);
      const distances = points.flatMap((p, i) => points.slice(0, i).map((q) => Math.hypot(p[0] - q[0], p[1] - q[1])));
      const told = distances.filter((distance) => distance >= apart).length, sum = distances.reduce((a, b) => a + b, 0);
      if (told > most[0] || (told === most[0] && sum > most[1] * (1 + 1e-9))) [best, most] = [[x, y], [told, sum]];
    }
  return best;
}

// The candidates by two figures of merit of the reader's choice.
function set_up_pareto(figures, candidates) {
  const holder = element('pareto');
  const menus = [element('pareto-x'), element('pareto-y')];
  const first = most_telling_pair(candidates, figures.length);
  menus.forEach((menu, place) => {
    figures.forEach((figure, i) => menu.add(new Option(`${figure.label} [${figure.unit}]`, i)));
    menu.value = first[place];
    menu.addEventListener('change', () => draw());
  });
  let chart = null;

  // Candidates that agree in both figures are one point.
  function points_of(x, y) {
    const points = [];
    for (const candidate of candidates) {
      const at = [candidate.values[x], candidate.values[y]];
      if (at.includes(null)) continue;
      const same = points.find((p) => p.x === at[0] && p.y === at[1]);
      if (same) { same.names.push(candidate.name); same.chosen ||= candidate.chosen; }
      else points.push({ x: at[0], y: at[1], names: [candidate.name], chosen: candidate.chosen });
    }
    for (const p of points)
      p.beaten = points.some((q) => q !== p && q.x <= p.x && q.y <= p.y);
    return points.sort((p, q) => p.x - q.x || p.y - q.y);
  }

  const range = (chart, low, high) => {
    const top = high > 0 ? high : 1;
    return [-0.05 * top, 1.15 * top];
  };

  function draw() {
    const [x, y] = menus.map((menu) => Number(menu.value));
    const points = points_of(x, y);
    const titles = [x, y].map((i) => `${figures[i].label} [${figures[i].unit}]`);
    chart?.destroy();
    holder.replaceChildren();
    const tip = document.createElement('div');
    tip.className = 'tip';
    tip.hidden = true;
    const width = width_of(holder);
    chart = new uPlot({
      width, height: Math.round(Math.min(360, 120 + width * 0.5)), legend: { show: false }, padding: [12, 30, 0, 0],
      scales: { x: { time: false, range }, y: { range } },
      axes: [axis(titles[0]), axis(titles[1], { ...numbers_wide, space: 40 })],
      series: [{}, { paths: () => null, points: { show: false } }],
      cursor: { drag: { x: false, y: false }, points: { show: false } },
      hooks: { draw: [(u) => paint(u, points)] },
    }, points.length ? [points.map((p) => p.x), points.map((p) => p.y)] : [[0], [null]], holder);
    holder.append(tip);
    chart.over.addEventListener('pointermove', (event) => show_nearest(event, points, titles, tip));
    chart.over.addEventListener('pointerleave', () => { tip.hidden = true; });
  }

  function paint(u, points) {
    const ctx = u.ctx, scale = devicePixelRatio;
    const place = (p) => [u.valToPos(p.x, 'x', true), u.valToPos(p.y, 'y', true)];
    ctx.save();
    ctx.lineWidth = 1.5 * scale;
    ctx.strokeStyle = colour('--muted');
    ctx.setLineDash([4 * scale, 3 * scale]);
    ctx.beginPath();
    points.filter((p) => !p.beaten).map(place).forEach(([px, py], i, all) => {
      if (i > 0) ctx.lineTo(px, all[i - 1][1]);
      ctx.lineTo(px, py);
    });
    ctx.stroke();
    ctx.setLineDash([]);
    ctx.font = `${11.5 * scale}px ${sans()}`;
    for (const p of points) paint_point(ctx, p, place(p), scale);
    paint_names(u, ctx, points.map((p) => [p, place(p)]), scale);
    ctx.restore();
  }

  function paint_point(ctx, p, [px, py], scale) {
    ctx.beginPath();
    ctx.arc(px, py, (p.chosen ? 6 : 4.5) * scale, 0, 2 * Math.PI);
    ctx.fillStyle = p.chosen ? colour('--brake') : colour('--paper');
    ctx.strokeStyle = p.chosen ? colour('--brake') : colour(p.beaten ? '--muted' : '--ink');
    ctx.fill();
    ctx.stroke();
  }

  // Beside its point, where no other name is, with a line to it from further away: the chosen one first. A name that
  // finds no room is told by pointing at its point.
  function paint_names(u, ctx, placed, scale) {
    const reach = 5 * scale;
    const taken = placed.map(([, [px, py]]) => ({ left: px - reach, right: px + reach, top: py - reach, bottom: py + reach }));
    ctx.textAlign = 'left';
    const is_free = (box) => box.left > 0 && box.right < u.bbox.left + u.bbox.width + 12 * scale && box.top > 0 &&
      taken.every((t) => box.right < t.left || box.left > t.right || box.bottom < t.top || box.top > t.bottom);
    for (const [p, [px, py]] of placed.slice().sort((a, b) => b[0].chosen - a[0].chosen)) {
      const name = p.names.length > 2 ? `${p.names[0]} and ${p.names.length - 1} more` : p.names.join(', ');
      const width = ctx.measureText(name).width, height = 12 * scale;
      const boxes = [];
      for (const down of [0, -15, 15, -30, 30, -45, 45, -60, 60, -75, 75])
        for (const left of [px + 9 * scale, px - width - 9 * scale, px - width / 2])
          boxes.push({
            left, right: left + width, top: py + down * scale - height / 2, bottom: py + down * scale + height / 2,
          });
      const box = boxes.find(is_free);
      if (!box) continue;
      taken.push(box);
      ctx.fillStyle = ctx.strokeStyle = colour(p.beaten && !p.chosen ? '--muted' : '--ink');
      ctx.fillText(name, box.left, box.bottom - 2 * scale);
      if (box.top <= py + height && box.bottom >= py - height) continue;
      ctx.lineWidth = scale / 2;
      ctx.beginPath();
      ctx.moveTo(px, py);
      ctx.lineTo(Math.min(Math.max(px, box.left), box.right), box.bottom < py ? box.bottom : box.top);
      ctx.stroke();
    }
  }

  function show_nearest(event, points, titles, tip) {
    const box = chart.over.getBoundingClientRect(), outer = holder.getBoundingClientRect();
    const across = event.clientX - box.left, down = event.clientY - box.top;
    const from = (p) => Math.hypot(chart.valToPos(p.x, 'x') - across, chart.valToPos(p.y, 'y') - down);
    const nearest = points.reduce((best, p) => (best && from(best) <= from(p) ? best : p), null);
    tip.hidden = !nearest || from(nearest) > 40;
    if (tip.hidden) return;
    tip.textContent = `${nearest.names.join('\n')}\n${titles[0]}: ${rounded(nearest.x)}\n${titles[1]}: ${rounded(nearest.y)}`;
    const left = box.left - outer.left + chart.valToPos(nearest.x, 'x') + 14;
    tip.style.left = `${Math.min(left, outer.width - tip.offsetWidth)}px`;
    tip.style.top = `${Math.max(0, box.top - outer.top + chart.valToPos(nearest.y, 'y') - tip.offsetHeight - 12)}px`;
  }

  drawings.push(draw);
  draw();
}
