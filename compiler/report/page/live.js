// The response to a motion, by the emitted code.
async function set_up_live(live) {
  const bytes = Uint8Array.from(atob(live.module), (c) => c.charCodeAt(0));
  const law = (await WebAssembly.instantiate(bytes)).instance.exports;
  const round = live.scalar === 'float' ? Math.fround : (v) => v;
  const most_samples = 2e6;
  const pad = element('pad'), holder = element('forces'), status = element('status');
  let motion = null, response = null, chart = null, drawn = null;

  // reset(0), then every sample in order, as `dashpot simulate` does.
  function respond(motion) {
    const count = motion.position.length;
    const r = { time: motion.time ?? Float64Array.from({ length: count }, (_, k) => k * live.period), position: motion.position };
    for (const name of ['velocity', 'force', 'damping', 'motor', 'brake']) r[name] = new Float64Array(count);
    law.reset(0);
    let last = 0;
    for (let k = 0; k < count; ++k) {
      const slope = k === 0 ? 0 : (motion.position[k] - last) * live.rate;
      last = motion.position[k];
      const velocity = round(motion.velocity ? motion.velocity[k] : slope);
      law.step(motion.position[k], velocity);
      r.velocity[k] = velocity;
      r.force[k] = law.force(velocity);
      r.damping[k] = law.damping();
      r.motor[k] = law.motor_force();
      r.brake[k] = r.damping[k] * velocity;
    }
    return r;
  }

  function csv(r) {
    const rows = ['time,position,velocity,force,damping,motor_force'];
    r.time.forEach((t, k) => rows.push([t, round(r.position[k]), r.velocity[k], r.force[k], r.damping[k], r.motor[k]].join(',')));
    return rows.join('\n') + '\n';
  }

  function take(next) {
    if (next.position.length > most_samples) return refuse(`${next.position.length} samples are more than the ${most_samples} that a page works on`);
    motion = next;
    response = respond(motion);
    const peak = response.force.reduce((most, f) => Math.max(most, Math.abs(f)), 0);
    status.className = 'note';
    status.textContent = `${motion.position.length} samples at ${rounded(live.rate)} Hz; largest force ${rounded(peak)} ${live.force_unit}`;
    draw();
  }

  function refuse(reason) {
    status.className = 'note wrong';
    status.textContent = reason;
  }

  const depth = () => Number(element('depth').value), duration = () => Number(element('duration').value);
  const sane = () => isFinite(depth()) && depth() !== 0 && isFinite(duration()) && duration() >= 2 * live.period;
  function press(button) {
    for (const other of document.querySelectorAll('#motions button[data-motion]'))
      other.setAttribute('aria-pressed', String(other === button));
  }

  function take_shape() {
    const pressed = document.querySelector('#motions [aria-pressed="true"]');
    if (!sane()) return refuse('a depth other than 0 and a duration of at least two periods are expected');
    if (pressed) take(motion_of_shape(shapes[pressed.dataset.motion], depth(), duration(), live.period));
    else if (drawn) take(motion_of_shape(drawn, depth(), duration(), live.period));
  }

  // The pad shows times from 0 to the motion's end, and twice the depth; what is drawn is kept as depths at its columns.
  function draw_pad() {
    const scale = devicePixelRatio, width = pad.clientWidth, height = pad.clientHeight, ctx = pad.getContext('2d');
    pad.width = width * scale;
    pad.height = height * scale;
    ctx.scale(scale, scale);
    const most = motion.position.reduce((m, u) => Math.max(m, Math.abs(u)), Number.MIN_VALUE);
    const y = (u) => height / 2 - (u / most) * (height / 2 - 16);
    ctx.strokeStyle = colour('--rule');
    ctx.strokeRect(-1, y(0), width + 2, 0);
    ctx.fillStyle = colour('--muted');
    ctx.font = `11px ${sans()}`;
    ctx.fillText(`${rounded(most)} ${live.position_unit}`, 8, 14);
    ctx.fillText('0', 8, y(0) - 4);
    ctx.textAlign = 'right';
    ctx.fillText(`motion over ${rounded((motion.position.length - 1) * live.period)} s: draw here`, width - 8, height - 7);
    ctx.strokeStyle = colour('--ink');
    ctx.lineWidth = 1.6;
    ctx.beginPath();
    const count = motion.position.length, stride = Math.max(1, Math.floor(count / (4 * width)));
    for (let k = 0; k < count; k += stride) ctx.lineTo((k / Math.max(1, count - 1)) * width, y(motion.position[k]));
    ctx.stroke();
  }

  function draw_forces() {
    chart?.destroy();
    const width = width_of(holder), count = response.time.length, stride = Math.max(1, Math.floor(count / 20000));
    const thinned = (values) => Array.from({ length: Math.ceil(count / stride) }, (_, i) => values[i * stride]);
    const curve = (name, stroke, thick) => ({ label: name, stroke: colour(stroke), width: thick, points: { show: false },
                                              value: (u, v) => (v === null || v === undefined ? '' : rounded(v)) });
    chart = new uPlot({
      width, height: Math.round(Math.min(340, 140 + width * 0.4)), padding: [12, 16, 0, 0], legend: { show: true, live: true },
      scales: { x: { time: false } }, axes: [axis('time [s]'), axis(`force [${live.force_unit}]`, { size: 68, space: 40 })],
      series: [{ label: 'time [s]', value: (u, v) => (v === null || v === undefined ? '' : rounded(v)) }, curve('brake b·v̂', '--brake', 1.5), curve('motor m', '--motor', 1.5), curve('force', '--ink', 2)],
    }, [response.time, response.brake, response.motor, response.force].map(thinned), holder);
  }

  function draw() {
    if (!response) return;
    draw_pad();
    draw_forces();
  }

  function set_up_pad() {
    let columns = null;
    const column = (event) => {
      const box = pad.getBoundingClientRect();
      const x = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      return [Math.round(x * 400), Math.min(1, Math.max(-1, (box.top + box.height / 2 - event.clientY) / (box.height / 2 - 16)))];
    };
    let last = null;
    const extend = (event) => {
      if (!columns) return;
      const [x, u] = column(event);
      const from = last ?? [x, u];
      for (let i = Math.min(from[0], x); i <= Math.max(from[0], x); ++i)
        columns[i] = from[0] === x ? u : from[1] + ((u - from[1]) * (i - from[0])) / (x - from[0]);
      last = [x, u];
      take_drawn(columns);
    };
    pad.addEventListener('pointerdown', (event) => {
      pad.setPointerCapture(event.pointerId);
      columns = new Float64Array(401);
      last = null;
      press(null);
      extend(event);
    });
    pad.addEventListener('pointermove', extend);
    pad.addEventListener('pointerup', () => { columns = null; take_shape(); });
    pad.addEventListener('pointercancel', () => { columns = null; });
  }

  // While it is drawn only the motion is shown; the response follows when the pointer is lifted.
  function take_drawn(columns) {
    const kept = columns.slice();
    drawn = (t) => {
      const place = Math.min(399, Math.floor(t * 400)), part = t * 400 - place;
      return kept[place] + (kept[place + 1] - kept[place]) * part;
    };
    if (!sane()) return;
    motion = motion_of_shape(drawn, depth(), duration(), live.period);
    draw_pad();
  }

  element('motions').addEventListener('click', (event) => {
    const button = event.target.closest('button[data-motion]');
    if (!button) return;
    press(button);
    take_shape();
  });
  for (const id of ['depth', 'duration']) element(id).addEventListener('change', take_shape);
  element('upload').addEventListener('change', async (event) => {
    const file = event.target.files[0];
    event.target.value = '';
    if (!file) return;
    try {
      take(motion_of_csv(await file.text(), live.period));
      drawn = null;
      press(null);
    } catch (error) {
      refuse(`${file.name}: ${error.message}`);
    }
  });
  element('download').addEventListener('click', () => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([csv(response)], { type: 'text/csv' }));
    link.download = `${data.name}_response.csv`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
  set_up_pad();
  drawings.push(draw);
  press(document.querySelector('#motions button[data-motion]'));
  take_shape();
}
