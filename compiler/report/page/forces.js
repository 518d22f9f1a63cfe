// The response as curves over time, with a device what is felt on it; where parameters change, a line.
function forces_chart(holder, response, felt, live) {
  const width = width_of(holder), count = response.time.length, stride = Math.max(1, Math.floor(count / 20000));
  const thinned = (values) => Array.from({ length: Math.ceil(count / stride) }, (_, i) => values[i * stride]);
  const value = (u, v) => (v === null || v === undefined ? '' : rounded(v));
  const curve = (label, stroke, thick) => ({ label, stroke: colour(stroke), width: thick, points: { show: false }, value });
  return new uPlot({
    width, height: Math.round(Math.min(340, 140 + width * 0.4)), padding: [12, 16, 0, 0], legend: { show: true, live: true },
    scales: { x: { time: false } }, axes: [axis('time [s]'), axis(`force [${live.force_unit}]`, { ...numbers_wide, space: 40 })],
    series: [{ label: 'time [s]', value }, curve('brake b·v̂', '--brake', 1.5), curve('motor m', '--motor', 1.5),
             curve('force', '--ink', 2),
             ...(felt ? [curve('felt on the device', '--closed', 1.5), ...(live.form ? [curve('network', '--muted', 1)] : [])] : [])],
    hooks: { ...quiet_legend, draw: [(u) => paint_change(u, response.changed_at)] },
  }, [response.time, response.brake, response.motor, response.force,
      ...(felt ? [felt.felt, ...(live.form ? [felt.closed] : [])] : [])].map(thinned), holder);
}

function paint_change(u, time) {
  if (time === null) return;
  const x = u.valToPos(time, 'x', true), scale = devicePixelRatio, ctx = u.ctx;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = colour('--muted');
  ctx.lineWidth = scale;
  ctx.setLineDash([3 * scale, 3 * scale]);
  ctx.beginPath();
  ctx.moveTo(x, u.bbox.top);
  ctx.lineTo(x, u.bbox.top + u.bbox.height);
  ctx.stroke();
  ctx.font = `${11 * scale}px ${sans()}`;
  ctx.fillText('set()', x + 4 * scale, u.bbox.top + 11 * scale);
  ctx.restore();
}
