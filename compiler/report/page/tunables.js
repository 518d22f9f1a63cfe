// A slider for each parameter that may change while the law runs. What they ask for is set() at one instant of the motion;
// until then the parameters have their defaults.
function set_up_tunables(tunables, changed) {
  const sliders = tunables.map((tunable) => add_slider(element('tunables'), tunable, changed));
  const defaults = tunables.map((tunable) => tunable.value);
  const wanted = () => sliders.map(({ slider }) => Number(slider.value));
  const first_changed = (period) => Math.ceil(Number(element('change-at').value) / period - 1e-9);
  element('change-at').addEventListener('change', changed);
  element('defaults').addEventListener('click', () => {
    sliders.forEach(({ move }, i) => move(defaults[i]));
    changed();
  });
  return {
    list: tunables,
    // From a sample to the parameters' values: those of a recording, else as the sliders say.
    values_over(motion, period) {
      if (motion.values) return (k) => motion.values[k];
      const first = first_changed(period), all = wanted();
      return (k) => (k < first ? defaults : all);
    },
    // When the sliders change something [s].
    change_in(motion, period) {
      const first = first_changed(period);
      const is_within = !motion.values && first > 0 && first < motion.position.length;
      return is_within && wanted().some((value, i) => value !== defaults[i]) ? first * period : null;
    },
    set(law, values) {
      tunables.forEach((tunable, i) => law[`want_${tunable.name}`](values[i]));
      law.set();
    },
  };
}

function add_slider(holder, tunable, changed) {
  const row = document.createElement('label'), name = document.createElement('span'), shown = document.createElement('output');
  const slider = document.createElement('input');
  Object.assign(slider, { type: 'range', id: `tunable-${tunable.name}`, min: tunable.min, max: tunable.max, step: 'any' });
  const show = () => { shown.textContent = `${rounded(Number(slider.value))} ${tunable.unit}`; };
  const move = (value) => { slider.value = value; show(); };
  name.textContent = tunable.name;
  move(tunable.value);
  slider.addEventListener('input', () => { show(); changed(); });
  row.append(name, slider, shown);
  holder.append(row);
  return { slider, move };
}
