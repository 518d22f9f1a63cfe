// A table of numbers as `dashpot simulate` and `dashpot fit` read it: commas, semicolons, bars, tabs or blanks between
// the fields, decimals behind a point or a comma, lines of other text before the header, units beside or below the
// names.
const table_dialects = [[',', false], [';', false], ['|', false], ['\t', false], [' ', false],
  [';', true], ['|', true], ['\t', true], [' ', true]]
  .map(([delimiter, decimal_comma]) => ({ delimiter, decimal_comma }));
const head_lines = 200;  // tell how the table is written

const free_of_blanks = (text) => text.replace(/^[ \t]+|[ \t]+$/g, '');
function free_field(text) {
  const inner = free_of_blanks(text);
  return inner.length >= 2 && inner.startsWith('"') && inner.endsWith('"') ? inner.slice(1, -1) : inner;
}

function fields_of(line, { delimiter }) {
  if (delimiter === ' ') return line.split(/[ \t]+/).filter((field) => field !== '');
  const fields = [];
  let begin = 0, is_quoted = false;
  for (let i = 0; i < line.length; ++i) {
    if (line[i] === '"') is_quoted = !is_quoted;
    if (line[i] !== delimiter || is_quoted) continue;
    fields.push(free_field(line.slice(begin, i)));
    begin = i + 1;
  }
  const last = free_field(line.slice(begin));
  if (last !== '' || fields.length === 0 || delimiter === '\t') fields.push(last);
  return fields;
}

// A finite decimal number within what a double holds, and nothing else; else null.
function number_of(field, { decimal_comma }) {
  if (decimal_comma && (field.includes('.') || field.endsWith(','))) return null;
  const text = decimal_comma ? field.replace(',', '.') : field;
  if (!/^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/.test(text)) return null;
  const value = Number(text);
  return isFinite(value) && (value !== 0 || !/[1-9]/.test(text.split(/[eE]/)[0])) ? value : null;
}

const is_gap = (field) => ['', 'nan', 'na', 'n/a', 'inf', '-inf', 'null', '-nan', '+inf'].includes(field.toLowerCase());

// Numbers, but for columns of text beside them: a row, whatever is wrong with single cells.
function is_row(fields, dialect) {
  const numbers = fields.filter((field) => number_of(field, dialect) !== null).length;
  const gaps = fields.filter((field) => number_of(field, dialect) === null && is_gap(field)).length;
  return fields.length >= 2 && numbers >= 1 && 2 * (numbers + gaps) >= fields.length && 2 * numbers + gaps >= 2;
}

// How many lines of the commonest width are rows; whole ones count double.
function score_of(dialect, lines) {
  const scores = new Map();
  for (const line of lines) {
    const fields = fields_of(line, dialect);
    if (!is_row(fields, dialect)) continue;
    const is_whole = fields.every((field) => number_of(field, dialect) !== null);
    scores.set(fields.length, (scores.get(fields.length) ?? 0) + (is_whole ? 2 : 1));
  }
  return Math.max(0, ...scores.values());
}

function dialect_of(lines) {
  let best = 0, found = table_dialects[0];
  for (const dialect of table_dialects) {
    const score = score_of(dialect, lines.slice(0, head_lines));
    if (score > best) [best, found] = [score, dialect];
  }
  return found;
}

// "(mm)" and "[mm]" below a name are "mm", "sec" is "s".
function unit_text(field) {
  const inner = field.match(/^\(([^)]+)\)$|^\[([^\]]+)\]$/), text = inner ? free_of_blanks(inner[1] ?? inner[2]) : field;
  return text === 'sec' ? 's' : text;
}

function table_unit(field, known) {
  const text = unit_text(field);
  return text === '-' || text === '1' ? { dimension: [0, 0, 0, 0, 0], factor: 1 } : unit_of(text, known);
}

// "Load (N)", "time [s]", "force_N", "t/s": a name, and what is its unit.
function column_of(title, known) {
  for (const [open, close] of ['()', '[]', '{}']) {
    const begin = title.lastIndexOf(open);
    if (begin <= 0 || !title.endsWith(close)) continue;
    const text = title.slice(begin + 1, -1), unit = table_unit(text, known);
    if (unit) return { title, name: title.slice(0, begin).replace(/ +$/, ''), unit: { text, ...unit } };
  }
  for (const sign of ['_', '/', ' ']) {
    const at = title.lastIndexOf(sign);
    if (at <= 0 || !/^[^0-9]/.test(title.slice(at + 1))) continue;
    const text = title.slice(at + 1), unit = table_unit(text, known);
    if (unit) return { title, name: title.slice(0, at), unit: { text, ...unit } };
  }
  return { title, name: title, unit: null };
}

const letters_of = (text) => [...text].filter((c) => /[0-9A-Za-z]/.test(c) || c > '\x7f').join('').replace(/[A-Z]/g, (c) => c.toLowerCase());

const column_dimensions = { time: [[0, 0, 1, 0, 0]], position: [[0, 1, 0, 0, 0], [0, 0, 0, 0, 1]],
                            velocity: [[0, 1, -1, 0, 0], [0, 0, -1, 0, 1]] };
const takes_unit = (role, unit) => column_dimensions[role].some((d) => d.every((power, i) => power === unit.dimension[i]));

// Places of the columns that are called like the role; alone of that which has its own word for a name.
function columns_for(columns, role, names) {
  const called = columns.map((column, i) => [letters_of(column.name), i])
    .filter(([letters, i]) => names[role].includes(letters) && (!columns[i].unit || takes_unit(role, columns[i].unit)));
  const by_word = called.filter(([letters]) => letters === role);
  return (by_word.length > 0 ? by_word : called).map(([, i]) => i);
}

// A title in two, "position [in]", whether the unit is known or not.
function parts_of({ title, name, unit }) {
  if (unit) return { name, unit: unit.text };
  const parts = title.match(/^(.+?) *(?:\(([^()]+)\)|\[([^[\]]+)\]|\{([^{}]+)\})$/);
  return parts ? { name: parts[1], unit: parts[2] ?? parts[3] ?? parts[4] } : { name: title, unit: null };
}

// The first column that is called like the role and whose unit is none of it: "position [in]", "velocity [m]".
const misfit_unit = (columns, role, names) => columns.find((column) => {
  const parts = parts_of(column);
  return names[role].includes(letters_of(parts.name)) && parts.unit !== null && !(column.unit && takes_unit(role, column.unit));
});

const is_unit_field = (field, known) =>
  ['', '-', '1', '%', '°C', 'C', 'K'].includes(unit_text(field)) || table_unit(field, known) !== null;

// In: the text of a file; `live` knows units and the names of columns. Out: {columns, rows, lines, dialect}, rows as fields,
// lines as their numbers in the file. Throws what is wrong.
function table_of(text, live) {
  if (text.slice(0, 4096).includes('\0')) throw new Error('no text in UTF-8; save the table as comma-separated values in UTF-8');
  const lines = text.replace(/^\uFEFF/, '').split(/\r\n|\n|\r/).map((line) => line.replace(/^[ \t\r]+|[ \t\r]+$/g, ''));
  const filled = lines.map((line, i) => i).filter((i) => lines[i] !== '');
  if (filled.length === 0) throw new Error('no rows; a header and at least one row are expected');
  const dialect = dialect_of(filled.map((i) => lines[i]));
  const names_in = (i) => fields_of(lines[i].replace(/^[#%]+/, ''), dialect);
  const columns_in = (i) => names_in(i).map((title) => column_of(title, live.units));
  const is_header = (i) => ['time', 'position'].every((role) =>
    columns_for(columns_in(i), role, live.columns).length > 0 || misfit_unit(columns_in(i), role, live.columns));
  const found = filled.slice(0, head_lines).findIndex(is_header), place = Math.max(0, found);
  const columns = columns_in(filled[place]);
  let first = place + 1;
  const below = first < filled.length ? names_in(filled[first]) : [];
  if (below.length === columns.length && below.every((field) => is_unit_field(field, live.units))) {
    below.forEach((field, i) => {
      if (field !== '') columns[i] = { title: columns[i].title, name: columns[i].title, unit: { text: field, ...(table_unit(field, live.units) ?? { dimension: [], factor: 1 }) } };
    });
    ++first;
  }
  const at = filled.slice(first);
  // A delimiter at the end of a line ends its last field, or stands before one that is empty where one is missing.
  const row_of = (line) => {
    const fields = fields_of(line, dialect);
    const ends_open = dialect.delimiter !== ' ' && line.endsWith(dialect.delimiter);
    return ends_open && fields.length + 1 === columns.length ? [...fields, ''] : fields;
  };
  return { columns, rows: at.map((i) => row_of(lines[i])), lines: at.map((i) => i + 1), dialect };
}
