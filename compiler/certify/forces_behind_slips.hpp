// What a part of a network with slips holds at most, wherever the tool has been. A slip is a force f within ± Y between
// the nodes that it joins; with such forces in the place of slips the rest is linear, and its answer at the tool is
//
//     F(s) = D(s) U(s) + Σ t_j(s) f_j(s),        |F| ≤ (k0 + Σ k_i) |way of the tool| + Σ Y_j ∫|t_j|,
//
// where D = k0 + Σ k_i s/(s + λ_i) is the stiffness of springs and dampers that reach ground round the slips, and t_j
// is the displacement across slip j for a unit of the tool's displacement, if no slip had friction (reciprocity). With
// springs alone t_j is a number between 0 and 1. The dampers' own force b∞ u̇ is not counted.
#pragma once

#include "network/network.hpp"

namespace dashpot::compiler {

struct ForcesBehindSlips {
  bool reach_round = false;  // whether springs or dampers, of whatever value, reach ground round the slips
  double stiffness = 0;      // k0 + Σ k_i of those that do; infinite where parameters change [N/m]
  double yields = 0;         // Σ Y_j ∫|t_j|; infinite where parameters change [N]
};

// Of all parts with slips. What the brake makes of dampers beside slips is not taken out, which would leave no more.
ForcesBehindSlips forces_behind_slips(const Network& network);

}  // namespace dashpot::compiler
