// Computes again what a law with tunable parameters needs over its declared box (certify/box_motor.hpp), from the
// network's own parts and in 100 digits.
#pragma once

#include <algorithm>
#include <optional>

#include "verify/reference_gain.hpp"

namespace dashpot::compiler {

struct ReferenceBox {
  Reference lacking;  // what is needed less the assured share of b, at most [N·s/m]
  Reference least_brake, largest_brake;

  // In all, where `share` of the brake's command is assured.
  Reference needed(const Reference& share) const {
    return std::max(Reference(0), Reference(share * least_brake + lacking));
  }
  std::optional<ReferenceGain> gain;  // K, that no slip gives way within a step not looked at [N/m]
};

// `hold`: T_max/h; `gain`: γ of the estimate, if there is one; `share`: of the brake's command that is assured.
struct ReferenceLoop {
  Reference hold, lateness, share;
  std::optional<Reference> gain;
  std::optional<ReferenceGain> pulse;  // Σ|h_j| of the estimate [1/s]
  bool out_of_step;                    // then only the least b over the box is assured
};

// `tables`: what the brake's rule is, and what it reaches; choices. Empty where nothing is proved.
std::optional<ReferenceBox> reference_box(const ReferenceTunables& tunables, const TunableTables& tables,
                                          const ReferenceLoop& loop, const LawFacts& facts);

}  // namespace dashpot::compiler
