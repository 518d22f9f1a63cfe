// Whether rows follow each other at one period, as far as their times are written out: the rules of `dashpot simulate`.
const uniformity = 1e-6;      // largest relative departure of a step from the median
const coarsest_share = 0.1;   // of the period, of a last digit that is allowed for
const rounding_at = (time) => 4 * 2 ** -52 * Math.abs(time);

// What the digits of times tell of their rounding; `unit` is that of the numbers [s].
function digits_of(texts, unit) {
  let last_place = null, significant = 1;
  for (const text of texts) {
    const [mantissa, exponent] = text.replace(',', '.').split(/[eE]/), [whole, behind = ''] = mantissa.replace(/^[+-]/, '').split('.');
    const all = (whole + behind).replace(/^0+/, '').length;
    if (all === 0 && behind.length === 0) continue;  // a bare 0 says nothing of the digits of others
    const place = Number(exponent ?? 0) - behind.length;
    last_place = Math.min(last_place ?? place, place);
    significant = Math.max(significant, all);
  }
  const by_decimals = 10 ** (last_place ?? 0);
  return (time) => unit * (time === 0 ? by_decimals
                                      : Math.max(by_decimals, 10 ** (Math.floor(Math.log10(Math.abs(time / unit))) + 1 - significant)));
}

// In: two times or more. Out: {period, error}, what the rounding leaves of it. Throws what is not uniform.
function uniform_period(time, texts, unit, lines) {
  const unit_at = digits_of(texts, unit), last = time.length - 1;
  const coarsest = Math.max(unit_at(time[0]), unit_at(time[last]));
  const wrong = (row, words) => new Error(`row ${lines[row]} ${words}`);
  const steps = time.slice(1).map((t, i) => t - time[i]);
  const back = steps.findIndex((step) => !(step > 0));
  if (back >= 0)
    throw wrong(back + 1, `is at ${time[back + 1]} s, the one before at ${time[back]} s; times that rise are expected`);
  const median = steps.slice().sort()[steps.length >> 1], period = (time[last] - time[0]) / last;
  const off_step = (allowance) =>
    steps.findIndex((step, i) => !(Math.abs(step - median) <= uniformity * median + rounding_at(time[i + 1]) + allowance));
  const gap = (i) => wrong(i + 1, `follows after ${rounded(steps[i])} s; a uniform period of ${rounded(median)} s is expected`);
  const first = off_step(0);
  if (first < 0) return { period, error: 0 };
  if (coarsest > coarsest_share * median) throw gap(first);
  const drift = time.findIndex((t, i) =>
    i > 0 && Math.abs(t - (time[0] + i * period)) > (coarsest + unit_at(t)) / 2 + rounding_at(t));
  if (drift < 0) return { period, error: coarsest / last };
  const jump = off_step(coarsest);
  if (jump >= 0) throw gap(jump);
  throw wrong(drift, `is at ${time[drift]} s; rows at a uniform period of ${rounded(period)} s have it at ${rounded(time[0] + drift * period)} s`);
}

// The rate that a recording means: a whole number of hertz, or a period with few digits, rather than the rounding of times.
function rate_meant({ period, error }) {
  const rate = 1 / period, whole = Math.round(rate);
  if (whole > 0 && Math.abs(rate - whole) <= Math.max(1e-6, error / period) * rate) return whole;
  return 1 / Number(period.toPrecision(7));
}

// Whether it is the law's. Where it has to be, the advice is a command line that the compiler takes.
function is_at_rate(uniform, live) {
  if (Math.abs(live.rate * uniform.period - 1) <= Math.max(1e-6, uniform.error / uniform.period)) return true;
  const rate = rate_meant(uniform), [least, most] = live.rates;
  if (rate < least || rate > most) throw new Error(`rows come at ${rounded(rate)} Hz; from ${least} to ${most} Hz is expected`);
  if (live.device) return false;
  throw new Error(`rows come at ${rounded(rate)} Hz, the law of this page runs at ${rounded(live.rate)} Hz; write the page ` +
                  `again with --rate ${rate}`);
}
