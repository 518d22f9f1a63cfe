// The response to a displacement of the tool while every slip holds: the gain to the tool's force and to the force that
// each slip has to hold, for the encoder's step (quantisation.hpp).
//
// A mode F ← a F + c δ is, with s = (1 − z⁻¹)/h, the Maxwell element c/a of the rate (1 − a)/(a h) by backward Euler.
// So are all blocks together: with the slips' ends joined, one linear network whose transfers are k0 + b s + Σ k s/(s +
// λ), with terms of either sign for what a slip holds, and Σ|h_j| ≤ |k0| + 2 |b|/h + 2 Σ |k|/(1 + λ h).
#pragma once

#include <vector>

#include "certify/cut.hpp"

namespace dashpot::compiler {

struct HeldSlip {
  Real gain;         // Σ|h_j| of what it has to hold, not below it [N/m]
  Real yield_force;  // [N]
};

struct HeldSlips {
  Real gain;  // Σ|h_j| of the tool's force less x u̇, for the worst of the x given [N/m]
  Real
      series_yield;  // least yield force of a slip that holds all of the tool's force; negative where there is none [N]
  std::vector<HeldSlip> slips;
};

// `feedthroughs`: x, what of the dampers is the brake's in some regime [N·s/m].
HeldSlips held_slips(const NormalTree& component, const std::vector<Real>& feedthroughs, const CutSettings& settings);

// The same of a part that is no tree, by its elements.
HeldSlips held_slips(const Network& network, const std::vector<std::size_t>& elements,
                     const std::vector<Real>& feedthroughs, const CutSettings& settings);

}  // namespace dashpot::compiler
