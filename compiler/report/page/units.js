// Units as people write them, "mm", "N·s/m", "deg/s": what `network/unit.cpp` reads. `known` holds its symbols and prefixes.
// Out: {dimension: [kg, m, s, A, rad], factor}, or null.
function unit_of(text, known) {
  let at = 0;
  const total = { dimension: [0, 0, 0, 0, 0], ten: 0, sixty: 0, degree: 0 };
  const times = (unit, n) => {
    unit[0].forEach((d, i) => { total.dimension[i] += n * d; });
    total.ten += n * unit[1];
    total.sixty += n * unit[2];
    total.degree += n * unit[3];
  };
  const accept = (token) => text.startsWith(token, at) && ((at += token.length), true);
  const skip = () => { while (text[at] === ' ') ++at; };
  const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';
  const is_symbol = (c) => c !== undefined && (/[A-Za-z%]/.test(c) || (c > '\x7f' && !'·⋅⁻'.includes(c) && !superscripts.includes(c)));

  function symbol(name) {
    if (Object.hasOwn(known.symbols, name)) return known.symbols[name];
    for (const [prefix, power] of known.prefixes) {
      const rest = name.slice(prefix.length);
      if (!name.startsWith(prefix) || !Object.hasOwn(known.symbols, rest) || !known.symbols[rest][4]) continue;
      return [known.symbols[rest][0], known.symbols[rest][1] + power, known.symbols[rest][2], known.symbols[rest][3]];
    }
    throw null;
  }
  function exponent() {
    if (accept('^')) {
      const sign = accept('-') ? -1 : 1;
      if (!/[0-9]/.test(text[at] ?? '')) throw null;
      return sign * Number(text[at++]);
    }
    const sign = accept('⁻') ? -1 : 1, digit = superscripts.indexOf(text[at] ?? ' ');
    if (digit < 0 && sign < 0) throw null;
    return digit < 0 ? 1 : (++at, sign * digit);
  }
  function factor(n) {
    const begin = at;
    while (is_symbol(text[at])) ++at;
    if (at === begin) throw null;
    const unit = symbol(text.slice(begin, at));
    times(unit, n * exponent());
  }
  function separator() {  // true for a '/'
    skip();
    const divides = accept('/');
    if (!divides && !accept('*') && !accept('·')) accept('⋅');
    skip();
    return divides;
  }
  function divisor() {
    if (!accept('(')) return factor(-1);
    factor(-1);
    for (skip(); !accept(')'); skip()) {
      if (separator()) throw null;
      factor(-1);
    }
  }
  function quotient() {
    let divided = false;
    if (accept('1')) {
      skip();
      if (text[at] !== '/') throw null;
    } else factor(1);
    for (;;) {
      const before = at;
      skip();
      if (at === text.length) break;
      if (at === before && !'·⋅*/'.includes(text[at])) throw null;
      const divides = separator();
      if (divided && !divides) throw null;
      if (divides) divisor();
      else factor(1);
      divided ||= divides;
    }
  }

  if (text.includes('%') && text !== '%') return null;
  try {
    quotient();
  } catch (fault) {
    if (fault !== null) throw fault;
    return null;
  }
  return { dimension: total.dimension, factor: value_of(total, known.degree) };
}

// Rounded once where it is a quotient of whole numbers; degrees come as they are rounded in the compiler.
function value_of({ ten, sixty, degree }, one_degree) {
  const up = (ten > 0 ? 10 ** ten : 1) * (sixty > 0 ? 60 ** sixty : 1);
  const down = (ten < 0 ? 10 ** -ten : 1) * (sixty < 0 ? 60 ** -sixty : 1);
  return (up / down) * one_degree ** degree;
}
