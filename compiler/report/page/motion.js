// Motions: {position: Float64Array, velocity: Float64Array or null, time: Float64Array or null, values: for each sample those
// of the tunables, or null}. Without velocities they are the slope since the sample before; without times those are counted
// from 0.

// A recorded motion as `dashpot simulate` reads it, or, where a device is led along it, at any uniform rate as `dashpot run
// --motion` does. Throws what is wrong with it.
function motion_of_csv(text, live) {
  const table = table_of(text, live), width = table.columns.length;
  if (table.rows.length === 0) throw new Error('no rows; a header and at least one row are expected');
  const columns = { time: named_column(table, 'time', live, true), position: named_column(table, 'position', live, true),
                    velocity: named_column(table, 'velocity', live, false) };
  const bad = table.rows.findIndex((row) => row.length !== width);
  if (bad >= 0) throw new Error(`row ${table.lines[bad]} has ${table.rows[bad].length} fields; the header has ${width}`);
  const values = (place, name) => Float64Array.from(table.rows, (row, i) => number(row[place], name, table.lines[i], table.dialect));
  const in_si = (role) => values(columns[role].place, role).map((value, i) => {
    if (!isFinite(value * columns[role].factor)) throw new Error(`row ${table.lines[i]}: ${role} is too large`);
    return value * columns[role].factor;
  });
  const time = in_si('time'), position = in_si('position'), velocity = columns.velocity ? in_si('velocity') : null;
  const recorded = { time, position, velocity, values: recorded_values(table, values, live.tunables, live.units) };
  if (time.length < 2) return recorded;
  const uniform = uniform_period(time, table.rows.map((row) => row[columns.time.place]), columns.time.factor, table.lines);
  return is_at_rate(uniform, live) ? recorded : resampled(recorded, live.period);
}

const likely_unit = { time: 's', position: 'mm', velocity: 'm/s' };

// Where a column stands, and what 1 in it is in SI.
function named_column(table, role, live, is_needed) {
  const places = columns_for(table.columns, role, live.columns);
  if (places.length > 1) throw new Error(`column '${role}' is there twice`);
  const misfit = places.length === 0 ? misfit_unit(table.columns, role, live.columns) : undefined;
  if (misfit) throw new Error(`column '${misfit.title}' in '${parts_of(misfit).unit}'; a ${role} is expected in a unit such as '${likely_unit[role]}'`);
  if (places.length === 0 && is_needed) {
    const others = live.columns[role].filter((name) => name !== role).map((name) => `'${name}'`), last = others.pop();
    throw new Error(`no column '${role}'; its name may also be ${others.join(', ')} or ${last}`);
  }
  if (places.length === 0) return null;
  const { unit } = table.columns[places[0]], turns = live.position_unit === 'rad';
  if (unit && role !== 'time' && (unit.dimension[4] !== 0) !== turns)
    throw new Error(`the motion is in ${turns ? 'metres' : 'radians'}; the network's tool moves in ${turns ? 'radians' : 'metres'}`);
  return { place: places[0], factor: unit ? unit.factor : 1 };
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
function recorded_values(table, values, tunables, known) {
  const is_called = (column, name) => column.title === name || parts_of(column).name === name;
  const places = tunables.map(({ name }) => {
    const found = table.columns.map((column, i) => i).filter((i) => is_called(table.columns[i], name));
    if (found.length > 1) throw new Error(`column '${name}' is there twice`);
    return found[0] ?? -1;
  });
  if (places.every((place) => place < 0)) return null;
  // What 1 in a column stands for in the tunable's unit; a column without a unit is in that.
  const factor_of = (column, { name, unit }) => {
    const written = parts_of(column).unit, own = unit_of(unit, known);
    if (written === null || (column.title === name && !column.unit)) return 1;
    if (column.unit && own && own.dimension.every((power, i) => power === column.unit.dimension[i])) return column.unit.factor / own.factor;
    throw new Error(`column '${column.title}' in '${written}'; a value of '${name}' is expected in a unit such as '${unit}'`);
  };
  const columns = places.map((place, i) => {
    if (place < 0) return null;
    const factor = factor_of(table.columns[place], tunables[i]);
    return values(place, tunables[i].name).map((value) => value * factor);
  });
  return table.rows.map((_, row) => tunables.map((tunable, i) => (columns[i] ? columns[i][row] : tunable.value)));
}

function number(field, name, line, dialect) {
  const value = number_of(field, dialect);
  if (value === null) throw new Error(`row ${line}: ${name} is '${field}'; a finite number is expected`);
  return value;
}

// Of depth 1, over times from 0 to 1.
const shapes = {
  press: (t) => Math.min(1, 4 * t),
  sine: (t) => Math.sin(8 * Math.PI * t),
  triangle: (t) => 1 - Math.abs(((6 * t + 3) % 4) - 2),
  steps: (t) => Math.min(3, Math.floor(4 * t)) / 3,
};

// From the surface on, where there is a contact.
function motion_of_shape(shape, depth, duration, live) {
  const count = Math.round(duration / live.period), surface = live.surface ?? 0;
  const position = Float64Array.from({ length: count + 1 }, (_, k) => surface + depth * shape(k / count));
  return { time: null, position, velocity: null, values: null };
}
