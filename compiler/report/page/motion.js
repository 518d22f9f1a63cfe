// Motions: {position: Float64Array, velocity: Float64Array or null, time: Float64Array or null, values: for each sample those
// of the tunables, or null}. Without velocities they are the slope since the sample before; without times those are counted
// from 0.

// A recorded motion as `dashpot simulate` reads it, or, where a device is led along it, at any uniform rate as `dashpot run
// --motion` does. Throws what is wrong with it.
function motion_of_csv(text, period, tunables, any_rate) {
  const rows = text.replace(/^\uFEFF/, '').split('\n').map((line) => line.trim()).filter((line) => line !== '')
    .map((line) => line.split(',').map((cell) => cell.replace(/^[\s"]+|[\s"]+$/g, '')));
  if (rows.length < 2) throw new Error('no rows; a header and at least one row are expected');
  const column = (name) => {
    const places = rows[0].filter((title) => title === name);
    if (places.length > 1) throw new Error(`column '${name}' is there twice`);
    return rows[0].indexOf(name);
  };
  const places = { time: column('time'), position: column('position'), velocity: column('velocity') };
  for (const name of ['time', 'position'])
    if (places[name] < 0) throw new Error(`no column '${name}'; 'time' and 'position' are expected`);
  const values = (name) => Float64Array.from(rows.slice(1), (row, i) => number(row, places[name], rows[0].length, name, i + 2));
  const time = values('time'), position = values('position'), velocity = places.velocity < 0 ? null : values('velocity');
  const recorded = { time, position, velocity, values: recorded_values(rows, column, tunables) };
  return check_period(time, period, any_rate) ? recorded : resampled(recorded, period);
}

// Straight between the rows; tunables keep their values until the next.
function resampled(motion, period) {
  const start = motion.time[0], count = Math.floor((motion.time[motion.time.length - 1] - start) / period + 1e-9) + 1;
  const position = new Float64Array(count), time = new Float64Array(count), values = motion.values ? [] : null;
  for (let k = 0, row = 0; k < count; ++k) {
    time[k] = start + k * period;
    while (row + 2 < motion.time.length && motion.time[row + 1] <= time[k]) ++row;
    const share = (time[k] - motion.time[row]) / (motion.time[row + 1] - motion.time[row]);
    position[k] = motion.position[row] + share * (motion.position[row + 1] - motion.position[row]);
    if (values) values.push(motion.values[share < 1 ? row : row + 1]);
  }
  return { time, position, velocity: null, values };
}

// Of columns that are called like tunables; one that has none keeps its default.
function recorded_values(rows, column, tunables) {
  const places = tunables.map((tunable) => column(tunable.name));
  if (places.every((place) => place < 0)) return null;
  return rows.slice(1).map((row, i) => tunables.map((tunable, j) =>
    places[j] < 0 ? tunable.value : number(row, places[j], rows[0].length, tunable.name, i + 2)));
}

function number(row, place, count, name, line) {
  if (row.length !== count) throw new Error(`row ${line} has ${row.length} fields; the header has ${count}`);
  if (!/^-?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(row[place]) || !isFinite(Number(row[place])))
    throw new Error(`row ${line}: ${name} is '${row[place]}'; a finite number is expected`);
  return Number(row[place]);
}

// Decimal times are rounded; the median step tells the period. Whether it is the law's.
function check_period(time, period, any_rate) {
  if (time.length < 2) return true;
  const steps = time.slice(1).map((t, i) => t - time[i]);
  const median = steps.slice().sort()[steps.length >> 1];
  steps.forEach((step, i) => {
    if (!(Math.abs(step - median) <= 1e-6 * median + 2 ** -50 * Math.abs(time[i + 1])))
      throw new Error(`row ${i + 3} follows after ${step} s; a uniform period of ${median} s is expected`);
  });
  const is_the_same = Math.abs(median / period - 1) <= 1e-6;
  if (!is_the_same && !any_rate)
    throw new Error(`rows come at ${rounded(1 / median)} Hz, the law of this page runs at ${rounded(1 / period)} Hz; ` +
                    `write the report with --rate ${rounded(1 / median)}`);
  return is_the_same;
}

// Of depth 1, over times from 0 to 1.
const shapes = {
  press: (t) => Math.min(1, 4 * t),
  sine: (t) => Math.sin(8 * Math.PI * t),
  triangle: (t) => 1 - Math.abs(((6 * t + 3) % 4) - 2),
  steps: (t) => Math.min(3, Math.floor(4 * t)) / 3,
};

function motion_of_shape(shape, depth, duration, period) {
  const count = Math.round(duration / period);
  const position = Float64Array.from({ length: count + 1 }, (_, k) => depth * shape(k / count));
  return { time: null, position, velocity: null, values: null };
}
