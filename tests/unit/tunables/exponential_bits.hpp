// One number for all bits that mean_decay gives over every magnitude: equal numbers on two machines mean equal bits.
#pragma once

#include <dashpot/exponential.hpp>

namespace dashpot::testing {

// FNV-1a over results of arguments from below the smallest normal number to beyond the largest finite exponent, the
// arguments themselves made by exact operations.
template <class Scalar, class Bits>
Bits exponential_bits() {
  Bits hash = static_cast<Bits>(14695981039346656037ull);
  Scalar power = sizeof(Scalar) == 4 ? Scalar(0x1p-148f) : Scalar(0x1p-1000);
  const int powers = sizeof(Scalar) == 4 ? 270 : 1990;
  for (int i = 0; i < powers; ++i, power *= 2)
    for (int j = 0; j < 16; ++j) {
      const Scalar result = mean_decay(power * (1 + Scalar(j) / 16));
      unsigned char bytes[sizeof(Scalar)];
      __builtin_memcpy(bytes, &result, sizeof(Scalar));
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * static_cast<Bits>(1099511628211ull);
    }
  return hash;
}

}  // namespace dashpot::testing
