// A law's commands along a motion, as one number that shows any bit that differs. Sums and products alone, so that
// every machine moves the tool in the same way.
#pragma once

#include <cstdint>
#include <cstring>

namespace dashpot::micro {

template <class Scalar>
void mix(std::uint64_t& hash, Scalar value) noexcept {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  hash = (hash ^ bits) * 0x100000001b3;  // FNV-1a, a number at a time
}

// Swings of 2.5 mm about a start 2.5 mm deep: (u, v) turns by a small angle each sample.
template <class Law>
std::uint64_t trace_of(Law law) noexcept {
  using scalar = typename Law::scalar;
  constexpr scalar angle = scalar(0.0078125), depth = scalar(0.0025);
  scalar swing = 0, speed = depth;
  std::uint64_t hash = 0xcbf29ce484222325;
  law.reset(depth);
  for (int n = 0; n < 4096; ++n) {
    swing += angle * speed;
    speed -= angle * swing;
    const auto now = law.step(depth + swing, speed * (angle / Law::sample_period));
    mix(hash, now.damping);
    mix(hash, now.force);
  }
  return hash;
}

}  // namespace dashpot::micro
