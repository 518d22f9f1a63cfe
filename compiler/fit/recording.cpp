#include "fit/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dashpot::compiler::fitting {

std::vector<double> steps_of(const std::vector<double>& time) {
  std::vector<double> steps(time.size(), 0.0);
  if (time.size() < 2) return steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps[i] = time[i] - time[i - 1];
  const double usual = usual_step(steps);
  for (std::size_t i = 1; i < time.size(); ++i) {
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * std::abs(time[i]);
    if (std::abs(steps[i] - usual) <= rounding) steps[i] = usual;
  }
  return steps;
}

double usual_step(const std::vector<double>& steps) {
  std::vector<double> sorted(steps.begin() + 1, steps.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

std::size_t Recording::free_rows() const {
  std::size_t count = 0;
  for (std::size_t row = 0; row < surface.size(); ++row) count += is_free(row) ? 1 : 0;
  return count;
}

}  // namespace dashpot::compiler::fitting
