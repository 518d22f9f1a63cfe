#include "axes/viscous_field.hpp"

#include <algorithm>

#include "axes/brakes.hpp"

namespace dashpot::compiler::axes {
namespace {

// What decimals leave of a value that is meant to be 0, as a share of the largest.
constexpr double rounding_slack = 1e-12;

double largest_of(const Matrix<double>& m) {
  return std::max({std::abs(m[0][0]), std::abs(m[0][1]), std::abs(m[1][0]), std::abs(m[1][1])});
}

}  // namespace

std::optional<Driving> driving(const Matrix<double>& viscous) {
  const Symmetric<double> heat{viscous[0][0], 0.5 * (viscous[0][1] + viscous[1][0]), viscous[1][1]};
  const double least = least_eigenvalue(heat);
  if (least >= -rounding_slack * largest_of(viscous)) return std::nullopt;
  // Both are multiples of the eigenvector; the longer one is far from 0.
  const Pair<double> one{heat.xy, least - heat.xx}, other{least - heat.yy, heat.xy};
  const Pair<double>& longer = length_squared(one) > length_squared(other) ? one : other;
  const double length = std::sqrt(length_squared(longer));
  if (length == 0) return Driving{{1, 0}, -least};
  return Driving{(1 / length) * longer, -least};
}

std::optional<double> curl_in_position(const Matrix<double>& stiffness) {
  const double curl = stiffness[1][0] - stiffness[0][1];
  if (std::abs(curl) <= rounding_slack * largest_of(stiffness)) return std::nullopt;
  return curl;
}

// ω² is the mean, in logarithms, of the least and the largest d_1/d_2: then neither side of the minimum is always the
// smaller one.
double gate_ratio(const std::vector<Pair<double>>& dampings) {
  std::optional<Pair<double>> range;
  for (const auto& [p, s] : dampings) {
    if (!(p > 0 && s > 0)) continue;
    const double ratio = std::log(p / s);
    if (!range) range = {ratio, ratio};
    range = {std::min((*range)[0], ratio), std::max((*range)[1], ratio)};
  }
  return range ? std::exp(0.25 * ((*range)[0] + (*range)[1])) : 1;
}

}  // namespace dashpot::compiler::axes
