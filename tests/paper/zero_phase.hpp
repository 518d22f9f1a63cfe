// Filters that look into the future, for what is computed offline (paper, 6.2 and 6.4).
#pragma once

#include <dashpot/estimators/low_pass.hpp>

#include <algorithm>
#include <vector>

namespace dashpot::paper {

// Mean over `window` samples around each; fewer at the ends.
inline std::vector<double> centred_average(const std::vector<double>& values, std::size_t window) {
  std::vector<double> average(values.size());
  const std::size_t half = window / 2;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t first = k < half ? 0 : k - half, last = std::min(k + half, values.size() - 1);
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += values[i];
    average[k] = sum / static_cast<double>(last - first + 1);
  }
  return average;
}

// The Butterworth filter, of `order` 2 or 4, of a signal that is at rest before its first sample. The runtime's
// estimator filters the difference of positions: it is given the signal's sum.
inline std::vector<double> butterworth(const std::vector<double>& values, unsigned order, double cutoff,
                                       double period) {
  low_pass<double> filter(order, cutoff, period);
  filter.reset(0);
  double sum = 0;
  std::vector<double> filtered;
  for (const double value : values)
    filtered.push_back(filter.update(sum += (value - values.front()) * period) + values.front());
  return filtered;
}

// Forwards, then backwards: no delay (filtfilt).
inline std::vector<double> both_ways(std::vector<double> values, unsigned order, double cutoff, double period) {
  values = butterworth(values, order, cutoff, period);
  std::reverse(values.begin(), values.end());
  values = butterworth(values, order, cutoff, period);
  std::reverse(values.begin(), values.end());
  return values;
}

}  // namespace dashpot::paper
