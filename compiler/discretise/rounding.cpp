#include "discretise/rounding.hpp"

#include <cmath>
#include <limits>

namespace dashpot::compiler {

double unit_roundoff(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-53 : 0x1p-24; }

double largest_finite(ScalarType scalar) {
  return scalar == ScalarType::float64 ? std::numeric_limits<double>::max() : double(std::numeric_limits<float>::max());
}

// An error of one sample decays by the share α a sample, so that equal errors add up to 1/α of them. Product form: the
// errors of aF, of the sum and of `a` itself are each relative to F. Delta form: only the sum's error is; those of αF,
// α, the gain and its product are relative to the increment. Compensated form: the sum's error is carried along, so
// that only its square is left.
double error_bound(ModeForm form, double loss, double roundoff) {
  switch (form) {
    case ModeForm::product: return 3 * roundoff / loss + 2 * roundoff;
    case ModeForm::delta: return roundoff / loss + 4 * roundoff;
    case ModeForm::compensated: return 6 * roundoff + 2 * roundoff * roundoff / loss;
  }
  return 0;
}

ModeForm cheapest_form(double smallest_loss, ScalarType scalar) {
  const double tolerated = scalar == ScalarType::float64 ? 1e-12 : 1e-3;
  const auto is_tolerable = [&](ModeForm form) {
    return error_bound(form, smallest_loss, unit_roundoff(scalar)) <= tolerated;
  };
  if (scalar == ScalarType::float64 && is_tolerable(ModeForm::product)) return ModeForm::product;
  return is_tolerable(ModeForm::delta) ? ModeForm::delta : ModeForm::compensated;
}

double flush_threshold(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-200 : 0x1p-60; }

std::size_t samples_without_guard(double decay, ScalarType scalar) {
  if (scalar == ScalarType::float32 || decay <= 0) return 0;
  const double samples = decay < 1 ? std::floor(200 / -std::log2(decay)) : std::numeric_limits<double>::infinity();
  return samples < 1e6 ? std::size_t(samples) : 1000000;
}

double smallest_constant(ScalarType scalar) {
  const double smallest_normal = scalar == ScalarType::float64 ? 0x1p-1022 : 0x1p-126;
  return smallest_normal / flush_threshold(scalar);
}

}  // namespace dashpot::compiler
