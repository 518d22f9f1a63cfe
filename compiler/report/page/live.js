// The response to a motion, by the emitted code.
const most_samples = 2e6;

// At rest at `start`, then every sample in order, as `dashpot simulate` does from 0.
function response_of(law, motion, live, tunables, start = 0) {
  const count = motion.position.length, round = live.scalar === 'float' ? Math.fround : (v) => v;
  const r = { time: motion.time ?? Float64Array.from({ length: count }, (_, k) => k * live.period),
              position: motion.position.map(round), changed_at: tunables ? tunables.change_in(motion, live.period) : null,
              values: tunables ? tunables.values_over(motion, live.period) : null };
  for (const name of ['velocity', 'force', 'damping', 'motor', 'brake']) r[name] = new Float64Array(count);
  law.renew();
  law.reset(start);
  let last = 0, present = null;
  for (let k = 0; k < count; ++k) {
    if (r.values && r.values(k) !== present) tunables.set(law, (present = r.values(k)));
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

// What `dashpot simulate` writes, and the tunables, so that it can be simulated again.
function csv_of_response(r, tunables) {
  const names = tunables ? tunables.list.map((tunable) => tunable.name) : [];
  const rows = [['time', 'position', 'velocity', 'force', 'damping', 'motor_force', ...names].join(',')];
  r.time.forEach((t, k) => rows.push([t, r.position[k], r.velocity[k], r.force[k], r.damping[k], r.motor[k],
                                      ...(r.values ? r.values(k) : [])].join(',')));
  return rows.join('\n') + '\n';
}

function hand_out(text, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'text/csv' }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function press(button) {
  for (const other of document.querySelectorAll('#motions button[data-motion]'))
    other.setAttribute('aria-pressed', String(other === button));
}

async function set_up_live(live) {
  const bytes = Uint8Array.from(atob(live.module), (c) => c.charCodeAt(0));
  const law = (await WebAssembly.instantiate(bytes)).instance.exports;
  const pad = element('pad'), holder = element('forces'), status = element('status');
  let motion = null, response = null, felt = null, chart = null, drawn = null;
  const tunables = live.tunables.length > 0 ? set_up_tunables(live.tunables, () => motion && take(motion)) : null;

  function say(words, kind) {
    status.className = kind;
    status.textContent = words;
  }
  const refuse = (reason) => say(reason, 'note wrong');

  function take(next) {
    const count = next.position.length;
    if (count > most_samples) return refuse(`${count} samples are more than the ${most_samples} that a page works on`);
    motion = next;
    response = response_of(law, motion, live, tunables);
    felt = live.device ? felt_of(law, motion, response, live, tunables) : null;
    const peak = response.force.reduce((most, f) => Math.max(most, Math.abs(f)), 0);
    say(`${count} sample${count === 1 ? '' : 's'} at ${rounded(live.rate)} Hz; largest force ${rounded(peak)} ${live.force_unit}` +
        (felt ? `; ${felt_text(felt, live)}` : ''), 'note');
    draw();
  }

  const depth = () => Number(element('depth').value), duration = () => Number(element('duration').value);
  const sane = () => isFinite(depth()) && depth() !== 0 && isFinite(duration()) && duration() >= 2 * live.period;
  function take_shape() {
    const pressed = document.querySelector('#motions [aria-pressed="true"]');
    if (!sane()) return refuse('a depth other than 0 and a duration of at least two periods are expected');
    const shape = pressed ? shapes[pressed.dataset.motion] : drawn;
    if (shape) take(motion_of_shape(shape, depth(), duration(), live));
  }

  function draw() {
    if (!response) return;
    draw_pad(pad, motion, live);
    chart?.destroy();
    chart = forces_chart(holder, response, felt, live);
  }

  // While it is drawn only the motion is shown; the response follows when the pointer is lifted.
  function take_drawn(shape) {
    drawn = shape;
    if (!sane()) return;
    motion = motion_of_shape(drawn, depth(), duration(), live);
    draw_pad(pad, motion, live);
  }

  async function take_file(file) {
    try {
      take(motion_of_csv(await file.text(), live));
      drawn = null;
      press(null);
    } catch (error) {
      refuse(`${file.name}: ${error.message}`);
    }
  }

  element('motions').addEventListener('click', (event) => {
    const button = event.target.closest('button[data-motion]');
    if (!button) return;
    press(button);
    take_shape();
  });
  for (const id of ['depth', 'duration']) element(id).addEventListener('change', take_shape);
  element('upload').addEventListener('change', (event) => {
    const file = event.target.files[0];
    event.target.value = '';
    if (file) take_file(file);
  });
  element('download').addEventListener('click', () => hand_out(csv_of_response(response, tunables), `${data.name}_response.csv`));
  if (live.device) element('download-felt').addEventListener('click', () => hand_out(csv_of_felt(felt), `${data.name}_run.csv`));
  listen_to_pad(pad, { started: () => press(null), drawn: take_drawn, finished: take_shape });
  drawings.push(draw);
  press(document.querySelector('#motions button[data-motion]'));
  take_shape();
}
