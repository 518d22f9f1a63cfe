// How much of a wanted damping the brakes make over a workspace, uniform in area.
#pragma once

#include <functional>

#include "axes/brakes.hpp"
#include "axes/workspace.hpp"

namespace dashpot::compiler::axes {

// The brakes' share of the heat that a wanted damping makes: in a motion of the tip that is alike in all directions,
// tr(C D)/tr(C B*), and in the direction where it is smallest. Above 1 if the brakes make more heat than wanted and the
// motors push against them.
struct Share {
  double alike, worst_direction;
  bool delay_proof;
};

// Over places, each with its area.
struct ShareMap {
  double mean, median, worst;                            // of `alike`
  double worst_direction_median, worst_direction_worst;  // of `worst_direction`
  double delay_proof;                                    // part of the area where the choice is delay-proof
  Pair<double> worst_at;                                 // tip where `alike` is least [m]
};

// The wanted damping at a tip position, over the plane [N·s/m]; positive definite.
using TipDamping = std::function<Symmetric<double>(const Pair<double>& tip)>;

Share share_at(const Arm& arm, const Pair<double>& joints, const std::vector<Brake>& brakes, BrakeRule rule,
               const TipDamping& wanted);
ShareMap share_map(const Arm& arm, const std::vector<Place>& places, const std::vector<Brake>& brakes, BrakeRule rule,
                   const TipDamping& wanted);

}  // namespace dashpot::compiler::axes
