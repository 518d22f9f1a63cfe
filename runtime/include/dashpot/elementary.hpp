// The two elementary functions that the runtime's core needs, without <cmath>, so that firmware needs no mathematics
// library and every target rounds alike. Both are constexpr and correct to a few units in the last place.
#pragma once

namespace dashpot {

namespace detail {

// 1/n at [n]. Outside of functions, so that no compiler copies it to the stack, by a memcpy that may not be there. With
// its bound: without, clang takes no element of a template for a constant.
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

}  // namespace detail

// √x, and 0 for x ≤ 0. Infinity stays infinity. The same steps for every x.
template <class Scalar>
constexpr Scalar square_root(Scalar x) noexcept {
  if (!(x > 0)) return 0;
  if (x - x != 0) return x;
  Scalar scale = 1;
  for (const Scalar half : detail::halves<Scalar>) {
    const bool is_large = x / half >= half, is_small = !is_large && x * half < 4 / half;
    if (is_large) x = x / half / half;
    if (is_small) x = x * half * half;
    scale = is_large ? scale * half : is_small ? scale / half : scale;
  }
  // The chord through (1, 1) and (4, 2) is at most 6 % wrong; each of Newton's steps squares the relative error.
  Scalar root = (x + 2) / 3;
  for (int step = 0; step < 4; ++step) root = (root + x / root) / 2;
  return scale * root;
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
