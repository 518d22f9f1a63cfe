// The regimes of a network with slips (theory, section 5): for each pattern of stuck and sliding slips the linear
// network that is left, and what the brake may take over from it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linear/linear_form.hpp"
#include "linear/normal_form.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// The elements that act as one slip: they hold together and give way together. Indices into Network::elements.
using SlipElements = std::vector<std::size_t>;

struct Regime {
  std::vector<bool> slides;  // one entry a slip
  LinearForm form;           // at the tool, stuck slips rigid, sliding ones absent: their force is constant
  Real damping;              // b of the observer (section 4), at least b∞ [N·s/m]
  std::string reason;        // for the observer

  const Real& feedthrough() const { return form.feedthrough_damping; }  // b∞ [N·s/m]
};

struct RegimeList {
  std::vector<SlipElements> slips;
  std::vector<Regime>
      regimes;       // one a pattern: bit i of the index tells whether slip i slides; empty beyond most_listed_slips
  double count = 1;  // 2ⁿ, listed or not
};

inline constexpr std::size_t most_listed_slips = 6;

// In: a network, those of its elements that are behind the slips given, and the frequency at which shares of
// dissipation are compared [rad/s] (section 4). Ensures: 0 ≤ b∞ ≤ Z_d(0) in every regime. Works for trees and for
// others.
RegimeList regimes_of(const Network& network, const std::vector<std::size_t>& elements, std::vector<SlipElements> slips,
                      double reference_frequency);

// The same for a component of the normal form. Slips come in the order of slips_of().
RegimeList regimes_of(const Network& network, const NormalTree& component, double reference_frequency);

// The same for a part that is no tree. Slips come in the order of slips_between().
RegimeList regimes_of(const Network& network, const std::vector<std::size_t>& elements, double reference_frequency);

// The linear network of one pattern.
Network network_in_regime(const Network& network, const std::vector<std::size_t>& elements,
                          const std::vector<SlipElements>& slips, const std::vector<bool>& slides);

}  // namespace dashpot::compiler
