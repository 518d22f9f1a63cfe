// Upper bounds of the forces that springs and slips of a network with tunable parameters hold behind a static curve's
// map w, whatever is set and whenever (theory, section 11). A change of parameters makes no force larger
// (energy_tank.hpp), so that
//
//     a relaxation      |F⁺| ≤ a |F| + k φ |Δw|,     φ/(1 − a) = b/kT:     |F| ≤ b_most |Δw|_most/T
//     and where its spring keeps its stiffness         |F| ≤ k Δ,          Δ the way in w from where the tool has been
//     the static spring lets go of what is beyond      |F| ≤ k0_most max(|w| + 2 |Δw|, 2d + |Δw|),     d: the law's
//     largest change
//
// and slips hold no more than their yield forces. What bends while a relaxation's force F acts costs at most
//
//     k ε [(1 − aφ)/(1 − a²) |Δw| + ε/2(1 − a²)],     ε = |Δw − w′Δu|,     for all F,
//
// beside the hold's own k ψ Δw², ψ = ½ + ½ (φ − a)²/(1 − a²), which rises with kT/b up to 1.65 and then falls.
#pragma once

#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct HeldRelaxation {
  double hold;       // largest k ψ [N/m]
  double turning;    // largest k (1 − aφ)/(1 − a²) [N/m]
  double turned;     // largest k/2(1 − a²); infinite if nothing relaxes within a sample [N/m]
  double stiffness;  // k; infinite if it can be tuned [N/m]
  double per_way;    // largest kφ/(1 − a): its largest force over the largest |Δw| of a sample [N/m]
};

struct BoxHold {
  double static_stiffness = 0;              // largest k0 [N/m]
  double static_slack = 0;                  // d, the law's largest change; 0 if its rest length never moves [m]
  std::vector<HeldRelaxation> relaxations;  // those between tool and ground without a slip
  double yield_forces = 0;                  // largest Σ Y [N]
  bool has_meshes = false;                  // nothing is known here of their inner springs
  bool can_soften = false;                  // some spring can become softer
};

// In: a law with tunables, before its map and its shedding are written; `sheds`: whether it will shed.
BoxHold box_hold(const UpdateLaw& law, bool sheds);

}  // namespace dashpot::compiler
