// The two elementary functions that the runtime's core needs, without <cmath>, so that firmware needs no mathematics
// library and every target rounds alike. Both are constexpr; the root is rounded to nearest, as IEEE 754 asks, and the
// decay correct to a few units in the last place.
#pragma once

namespace dashpot {

namespace detail {

// 1/n at [n]. Outside of functions, so that no compiler copies it to the stack, by a memcpy that may not be there. The
// bound is written out, since without it clang does not treat the template's elements as constants.
template <class Scalar>
inline constexpr Scalar reciprocal_of[18] = {
    Scalar(0),      Scalar(1),      Scalar(1) / 2,  Scalar(1) / 3,  Scalar(1) / 4,  Scalar(1) / 5,
    Scalar(1) / 6,  Scalar(1) / 7,  Scalar(1) / 8,  Scalar(1) / 9,  Scalar(1) / 10, Scalar(1) / 11,
    Scalar(1) / 12, Scalar(1) / 13, Scalar(1) / 14, Scalar(1) / 15, Scalar(1) / 16, Scalar(1) / 17};

// Powers of two by which square_root() takes any number to between 1 and 4.
template <class Scalar>
inline constexpr Scalar halves[10] = {0x1p256, 0x1p256, 0x1p128, 0x1p64, 0x1p32, 0x1p16, 0x1p8, 0x1p4, 0x1p2, 0x1p1};
template <>
inline constexpr float halves<float>[7] = {0x1p32f, 0x1p32f, 0x1p16f, 0x1p8f, 0x1p4f, 0x1p2f, 0x1p1f};

// √x of x from 1 to 4, rounded to nearest.
template <class Scalar>
constexpr Scalar root_by_steps(Scalar x) noexcept {
  constexpr bool is_float = sizeof(Scalar) == sizeof(float);
  constexpr Scalar last_place = is_float ? Scalar(0x1p-23) : Scalar(0x1p-52);
  constexpr Scalar half_of_digits = is_float ? Scalar(0x1p12 + 1) : Scalar(0x1p27 + 1);
  // The chord through (1, 1) and (4, 2) is at most 6 % wrong; each of Newton's steps squares the relative error.
  Scalar root = (x + 2) / 3;
  for (int step = 0; step < 4; ++step) root = (root + x / root) / 2;
  // Off by a last place at most. x − root² is exact, from products of half of the digits (Dekker 1971), and a multiple
  // of last_place² as root · last_place is; half way between two roots there is none.
  const Scalar spread = half_of_digits * root, high = spread - (spread - root), low = root - high;
  const Scalar square = root * root;
  const Scalar rest = (x - square) - (((high * high - square) + 2 * high * low) + low * low);
  const Scalar nearest = root * last_place;
  return rest > nearest ? root + last_place : rest <= -nearest ? root - last_place : root;
}

// The processor's own instruction, which rounds to the same.
template <class Scalar>
struct root_instruction {
  static constexpr bool is_there = false;
  static Scalar root(Scalar) noexcept;
};
#if defined(__GNUC__) && defined(__SSE2__)
template <>
struct root_instruction<double> {
  static constexpr bool is_there = true;
  typedef double pair __attribute__((vector_size(16)));
  static double root(double x) noexcept { return __builtin_ia32_sqrtsd(pair{x, 0})[0]; }
};
template <>
struct root_instruction<float> {
  static constexpr bool is_there = true;
  typedef float four __attribute__((vector_size(16)));
  static float root(float x) noexcept { return __builtin_ia32_sqrtss(four{x, 0, 0, 0})[0]; }
};
#elif defined(__GNUC__) && defined(__ARM_FP) && !defined(__aarch64__)
#if __ARM_FP & 4
template <>
struct root_instruction<float> {
  static constexpr bool is_there = true;
  static float root(float x) noexcept {
    asm("vsqrt.f32 %0, %0" : "+t"(x));
    return x;
  }
};
#endif
#if __ARM_FP & 8
template <>
struct root_instruction<double> {
  static constexpr bool is_there = true;
  static double root(double x) noexcept {
    asm("vsqrt.f64 %P0, %P0" : "+w"(x));
    return x;
  }
};
#endif
#endif

}  // namespace detail

// √x, and 0 for x ≤ 0. Infinity stays infinity. By one instruction where the processor has it, else by the same steps
// for every x.
template <class Scalar>
constexpr Scalar square_root(Scalar x) noexcept {
  if (!(x > 0)) return 0;
  // With __builtin_is_constant_evaluated() g++ 12 would make global objects whose constructors take roots when the
  // program starts.
  if constexpr (detail::root_instruction<Scalar>::is_there)
    if (!__builtin_constant_p(x)) return detail::root_instruction<Scalar>::root(x);
  if (x - x != 0) return x;
  Scalar scale = 1;
  for (const Scalar half : detail::halves<Scalar>) {
    const bool is_large = x / half >= half, is_small = !is_large && x * half < 4 / half;
    if (is_large) x = x / half / half;
    if (is_small) x = x * half * half;
    scale = is_large ? scale * half : is_small ? scale / half : scale;
  }
  return scale * detail::root_by_steps(x);
}

// e^(−x) for x ≥ 0. Zero from x = 40 on, where 1 − e^(−x) rounds to 1.
template <class Scalar>
constexpr Scalar decay(Scalar x) noexcept {
  if (!(x < 40)) return 0;
  // ln 2 in two parts, the first with trailing zeros enough for halvings · ln 2 to be exact.
  constexpr Scalar ln2_high = Scalar(0.693359375);
  constexpr Scalar ln2_low = Scalar(-2.12194440054690583e-4);
  const int halvings = static_cast<int>(x * Scalar(1.4426950408889634) + Scalar(0.5));
  const Scalar rest = Scalar(halvings) * ln2_low - (x - Scalar(halvings) * ln2_high);
  // Taylor's series to rest¹³/13!, below the last place for |rest| ≤ ln 2/2.
  Scalar sum = 1;
  for (int n = 13; n > 0; --n) sum = 1 + rest * detail::reciprocal_of<Scalar>[n] * sum;
  const auto scale = static_cast<Scalar>(1ull << halvings);
  return sum / scale;
}

}  // namespace dashpot
