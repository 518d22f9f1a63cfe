// Magnitudes and signs of scalars.
#pragma once

namespace dashpot {

template <class Scalar>
constexpr Scalar magnitude(Scalar value) noexcept {
  return value < Scalar(0) ? -value : value;
}

// −1, 0 or 1.
template <class Scalar>
constexpr Scalar sign(Scalar value) noexcept {
  return static_cast<Scalar>(static_cast<int>(value > Scalar(0)) - static_cast<int>(value < Scalar(0)));
}

// The value, or ±limit where it lies beyond; `limit` ≥ 0.
template <class Scalar>
constexpr Scalar clamp_magnitude(Scalar value, Scalar limit) noexcept {
  return value > limit ? limit : value < -limit ? -limit : value;
}

}  // namespace dashpot
