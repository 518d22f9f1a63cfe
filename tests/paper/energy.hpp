// The energy that flows into a tissue, sample by sample: (20), after Hannaford & Ryu 2002. As printed (20) has no sum
// and is what flows in one sample; the passivity observer that it cites is the running sum.
#pragma once

#include <algorithm>
#include <vector>

namespace dashpot::paper {

// E(k) = f(k) v(k) Δt, as printed [J]
inline std::vector<double> increments_of(const std::vector<double>& force, const std::vector<double>& velocity,
                                         double period) {
  std::vector<double> energy(force.size());
  for (std::size_t k = 0; k < force.size(); ++k) energy[k] = force[k] * velocity[k] * period;
  return energy;
}

// E(k) = E(k − 1) + f(k) v(k) Δt [J]
inline std::vector<double> energy_of(const std::vector<double>& force, const std::vector<double>& velocity,
                                     double period) {
  std::vector<double> energy(force.size());
  double sum = 0;
  for (std::size_t k = 0; k < force.size(); ++k) energy[k] = sum += force[k] * velocity[k] * period;
  return energy;
}

// What comes back within `samples` after sample `reversal` [J].
inline double returned_energy(const std::vector<double>& energy, std::size_t reversal, std::size_t samples) {
  const auto first = energy.begin() + static_cast<std::ptrdiff_t>(reversal);
  const auto last = energy.begin() + static_cast<std::ptrdiff_t>(std::min(reversal + samples + 1, energy.size()));
  return energy[reversal] - *std::min_element(first, last);
}

// How far a reading of (20) goes below zero after a reversal, and for how long it stays there.
struct Fall {
  double depth = 0;     // [J]
  double duration = 0;  // [s]

  bool exceeds(const Fall& other) const { return depth > other.depth && duration > other.duration; }
};

// Of `values` less `origin`, within `samples` after sample `reversal`.
inline Fall fall_of(const std::vector<double>& values, double origin, std::size_t reversal, std::size_t samples,
                    double period) {
  Fall fall;
  for (std::size_t k = reversal; k < std::min(reversal + samples + 1, values.size()); ++k) {
    fall.depth = std::max(fall.depth, origin - values[k]);
    fall.duration += values[k] < origin ? period : 0;
  }
  return fall;
}

// Both readings of (20).
struct Readings {
  Fall increment, sum;
};

inline Readings readings_of(const std::vector<double>& force, const std::vector<double>& velocity, double period,
                            std::size_t reversal, std::size_t samples) {
  const std::vector<double> sum = energy_of(force, velocity, period);
  return {fall_of(increments_of(force, velocity, period), 0, reversal, samples, period),
          fall_of(sum, sum[reversal], reversal, samples, period)};
}

}  // namespace dashpot::paper
