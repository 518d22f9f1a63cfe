// The pad on which a motion is shown and drawn: times from 0 to the motion's end, and twice its depth; with a contact around
// its surface.
function draw_pad(pad, motion, live) {
  const scale = devicePixelRatio, width = pad.clientWidth, height = pad.clientHeight, ctx = pad.getContext('2d');
  pad.width = width * scale;
  pad.height = height * scale;
  ctx.scale(scale, scale);
  const middle = live.surface ?? 0;  // what is drawn is how far from there
  const most = motion.position.reduce((m, u) => Math.max(m, Math.abs(u - middle)), Number.MIN_VALUE);
  const y = (u) => height / 2 - (u / most) * (height / 2 - 16);
  ctx.strokeStyle = colour('--rule');
  ctx.strokeRect(-1, y(0), width + 2, 0);
  ctx.fillStyle = colour('--muted');
  ctx.font = `11px ${sans()}`;
  ctx.fillText(`${rounded(middle + most)} ${live.position_unit}`, 8, 14);
  ctx.fillText(live.surface === null ? '0' : `${rounded(middle)} ${live.position_unit}: surface`, 8, y(0) + 14);
  ctx.textAlign = 'right';
  ctx.fillText(`motion over ${rounded((motion.position.length - 1) * live.period)} s: draw here`, width - 8, height - 7);
  ctx.strokeStyle = colour('--ink');
  ctx.lineWidth = 1.6;
  ctx.beginPath();
  const count = motion.position.length, stride = Math.max(1, Math.floor(count / (4 * width)));
  for (let k = 0; k < count; k += stride) ctx.lineTo((k / Math.max(1, count - 1)) * width, y(motion.position[k] - middle));
  ctx.stroke();
}

const pad_columns = 400;  // what is drawn is kept as depths at so many places and one more

// The depth over times from 0 to 1.
function shape_of_columns(columns) {
  return (t) => {
    const place = Math.min(pad_columns - 1, Math.floor(t * pad_columns)), part = t * pad_columns - place;
    return columns[place] + (columns[place + 1] - columns[place]) * part;
  };
}

// Calls started(), then drawn(shape) while the pointer draws, then finished().
function listen_to_pad(pad, { started, drawn, finished }) {
  let columns = null, last = null;
  const place_of = (event) => {
    const box = pad.getBoundingClientRect();
    const x = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    return [Math.round(x * pad_columns),
            Math.min(1, Math.max(-1, (box.top + box.height / 2 - event.clientY) / (box.height / 2 - 16)))];
  };
  const extend = (event) => {
    if (!columns) return;
    const [x, u] = place_of(event), from = last ?? [x, u];
    for (let i = Math.min(from[0], x); i <= Math.max(from[0], x); ++i)
      columns[i] = from[0] === x ? u : from[1] + ((u - from[1]) * (i - from[0])) / (x - from[0]);
    last = [x, u];
    drawn(shape_of_columns(columns.slice()));
  };
  pad.addEventListener('pointerdown', (event) => {
    pad.setPointerCapture(event.pointerId);
    columns = new Float64Array(pad_columns + 1);
    last = null;
    started();
    extend(event);
  });
  pad.addEventListener('pointermove', extend);
  pad.addEventListener('pointerup', () => { columns = null; finished(); });
  pad.addEventListener('pointercancel', () => { columns = null; });
}
