// The range of a parameter that changes while a law runs.
#pragma once

namespace dashpot {

template <class Scalar>
struct tunable_range {
  Scalar value;  // the initial one
  Scalar min;
  Scalar max;
};

// `value` becomes what is wanted, clamped to its range; a NaN leaves it as it is. Returns 1 if `value` is then not what
// was wanted, else 0.
template <class Scalar>
constexpr unsigned take_value(const tunable_range<Scalar>& range, Scalar wanted, Scalar& value) noexcept {
  if (wanted == wanted) value = wanted < range.min ? range.min : wanted > range.max ? range.max : wanted;
  return value == wanted ? 0u : 1u;
}

}  // namespace dashpot
