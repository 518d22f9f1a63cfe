#if ROOTS
// √x to the nearest number, and 0 for x ≤ 0. Infinity stays infinity. By one instruction where the processor has it, else
// by the same steps for every x.
static inline scalar law_square_root(scalar x) {
# if defined(__GNUC__) && defined(__SSE2__) && !defined(__AVX__) && !defined(__FRAMAC__)
  if (!(x > 0)) return 0;
  __asm__(ROOT_ON_X86);
  return x;
# elif defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__) && !defined(__FRAMAC__) && (__ARM_FP & ROOT_BIT)
  if (!(x > 0)) return 0;
  __asm__(ROOT_ON_ARM);
  return x;
# else
  // Powers of two that take any number to between 1 and 4.
  static const scalar halves[] = {HALVES};
  scalar scale = 1;
  if (!(x > 0)) return 0;
  if ((x - x) != 0) return x;
  for (int i = 0; i < (int)(sizeof halves / sizeof halves[0]); ++i) {
    const scalar half = halves[i];
    const int is_large = (x / half) >= half, is_small = !is_large && ((x * half) < (4 / half));
    if (is_large) x = x / half / half;
    if (is_small) x = x * half * half;
    scale = is_large ? scale * half : (is_small ? scale / half : scale);
  }
  // The chord through (1, 1) and (4, 2) is at most 6 % wrong; each of Newton's steps squares the relative error.
  scalar root = (x + 2) / 3;
  for (int step = 0; step < 4; ++step) root = (root + x / root) / 2;
  // Off by a last place at most. x − root² is exact, from products of half of the digits (Dekker 1971), and a multiple
  // of the last place squared, as root times the last place is; half way between two roots there is none.
  const scalar spread = HALF_OF_DIGITS * root, high = spread - (spread - root), low = root - high, square = root * root;
  const scalar rest = (x - square) - ((((high * high) - square) + (2 * high * low)) + (low * low));
  const scalar nearest = root * LAST_PLACE;
  if (rest > nearest) root = root + LAST_PLACE;
  else if (rest <= -nearest) root = root - LAST_PLACE;
  return scale * root;
# endif
}

#endif
#if DECAYS
// 1/n at [n]
static const scalar law_reciprocal[18] = {
    0,       1,        ONE / 2,  ONE / 3,  ONE / 4,  ONE / 5,  ONE / 6,  ONE / 7,  ONE / 8,
    ONE / 9, ONE / 10, ONE / 11, ONE / 12, ONE / 13, ONE / 14, ONE / 15, ONE / 16, ONE / 17};

// e^(−x) for x ≥ 0. Zero from x = 40 on, where 1 − e^(−x) rounds to 1.
static inline scalar law_decay(scalar x) {
  const scalar ln2_high = NUMBER(0.693359375), ln2_low = NUMBER(-2.12194440054690583e-4);
  if (!(x < 40)) return 0;
  const int halvings = (int)(x * NUMBER(1.4426950408889634) + NUMBER(0.5));
  const scalar rest = (scalar)halvings * ln2_low - (x - (scalar)halvings * ln2_high);
  // Taylor's series to rest¹³/13!, below the last place for |rest| ≤ ln 2/2.
  scalar sum = 1;
  for (int n = 13; n > 0; --n) sum = 1 + rest * law_reciprocal[n] * sum;
  return sum / (scalar)(1ull << halvings);
}

// φ(x) = (1 − e^(−x))/x: what is left in a spring behind a damper, at the end of a sample, of a displacement that grows
// evenly over it, x being the sample over the relaxation time.
static inline scalar law_mean_decay(scalar x) {
  if (x <= 0) return 1;
  if (x >= NUMBER(0.6875)) return (1 - law_decay(x)) / x;
  // φ = 1 − x/2 (1 − x/3 (1 − x/4 (…))) to x¹⁶/17!, below a tenth of the last place for x ≤ 11/16.
  scalar sum = 1;
  for (int n = 17; n > 1; --n) sum = 1 - x * law_reciprocal[n] * sum;
  return sum;
}

#endif
#if RANGES
typedef struct law_range_of_parameter {
  scalar min;
  scalar max;
} law_range_of_parameter;

// `value` becomes what is wanted of it, within its range; a NaN leaves it as it is. Returns 1 where
// that is not what was wanted, else 0.
static inline unsigned law_take_value(const law_range_of_parameter *range, scalar wanted, scalar *value) {
  if (wanted == wanted) *value = (wanted < range->min) ? range->min : ((wanted > range->max) ? range->max : wanted);
  return (*value == wanted) ? 0u : 1u;
}

#endif
