// What a hand that makes a motion feels on the described device, by the runtime's own encoder, estimator, delay, amplifier and
// coil, against the network itself: `dashpot run --motion` without jitter.

// Of a linear network, straight from sample to sample: k0 u + b∞ u̇ + Σ F, where F tends to B u̇.
function network_force(form, position, velocity, period) {
  const force = new Float64Array(position.length);
  const modes = form.modes.map(([rate, damping]) => ({ kept: Math.exp(-rate * period), gained: -Math.expm1(-rate * period) * damping, force: 0 }));
  for (let k = 0; k < position.length; ++k) {
    force[k] = form.static_stiffness * position[k] + form.feedthrough_damping * velocity[k];
    for (const mode of modes) {
      if (k > 0) mode.force = mode.kept * mode.force + mode.gained * velocity[k - 1];
      force[k] += mode.force;
    }
  }
  return force;
}

// At rest where the motion begins, as the device is. A network that is not linear is what the law makes of the exact motion.
function force_without_device(law, motion, live, tunables, velocity) {
  if (live.form) return network_force(live.form, motion.position, velocity, live.period);
  return response_of(law, { ...motion, velocity: null }, live, tunables, motion.position[0]).force;
}

function felt_of(law, motion, response, live, tunables) {
  const position = motion.position, count = position.length;
  const velocity = position.map((p, k) => (k + 1 < count ? (position[k + 1] - p) / live.period : 0));
  const f = { time: response.time, position, closed: force_without_device(law, motion, live, tunables, velocity) };
  for (const name of ['estimate', 'felt', 'damping', 'motor']) f[name] = new Float64Array(count);
  law.renew();
  law.lead_from(position[0]);
  for (let k = 0; k < live.device.lead_in; ++k) law.lead(position[0], 0);  // at rest, until motor and brake have settled
  let present = null, errors = 0, forces = 0, worst = 0, most = 0;
  for (let k = 0; k < count; ++k) {
    if (response.values && response.values(k) !== present) tunables.set(law, (present = response.values(k)));
    law.lead(position[k], velocity[k]);
    f.estimate[k] = law.estimate();
    f.felt[k] = law.felt_force();
    f.damping[k] = law.wanted_damping();
    f.motor[k] = law.wanted_force();
    const error = f.felt[k] - f.closed[k];
    errors += error * error;
    forces += f.closed[k] * f.closed[k];
    worst = Math.max(worst, Math.abs(error));
    most = Math.max(most, Math.abs(f.closed[k]));
  }
  return { ...f, rms: Math.sqrt(errors / count), peak: worst, rms_force: Math.sqrt(forces / count), peak_force: most };
}

const in_percent = (part, whole) => (whole > 0 ? ` (${rounded(100 * part / whole)} %)` : '');

function felt_text(f, live) {
  return `felt error on ${live.device.name}, against ${live.form ? 'the network' : 'the law alone'}: ` +
    `rms ${rounded(f.rms)} ${live.force_unit}${in_percent(f.rms, f.rms_force)}, ` +
    `peak ${rounded(f.peak)} ${live.force_unit}${in_percent(f.peak, f.peak_force)}`;
}

// The columns of `dashpot run --motion`.
function csv_of_felt(f) {
  const rows = ['time,position,estimate,felt_force,closed_form,damping,motor_force'];
  f.time.forEach((t, k) => rows.push([t, f.position[k], f.estimate[k], f.felt[k], f.closed[k], f.damping[k], f.motor[k]].join(',')));
  return rows.join('\n') + '\n';
}
