// The energy that flows into a tissue, sample by sample: (20), after Hannaford & Ryu 2002.
#pragma once

#include <algorithm>
#include <vector>

namespace dashpot::paper {

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

}  // namespace dashpot::paper
