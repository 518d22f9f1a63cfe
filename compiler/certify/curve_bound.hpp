// The damping that a law behind a static curve's map w needs to be passive at the tool (theory, section 11).
//
// Behind the map the law needs S = b T for a motion of w. A held force acts during the displacement that follows, while
// w′ changes: with n samples of delay
//
//     V_{k+1} − V_k ≤ f_k Δu + [S w′²/T + (½ + n) |M| |w″|] Δu²
//
// w′ and w″ being the largest within the reach r = (1 + n) v T of the tool, M the largest force of the motor behind the
// map. So at every place
//
//     b_tool + share b_w w′²(least within r) ≥ S w′² + (½ + n) T |M| |w″|
//
// where b_tool is the damping that does not depend on the brake's command. The brake's coil lags: of its command it
// makes (1 − e^{−m})² of the least within m time constants more. The force of a motor that lags is off by no more than
// ‖e‖ ≤ (β w′²_most + ½ |M w″|_most) L ‖v‖, with L as in motor_limits.hpp; what it makes of the estimate, κ w′² v̂,
// costs κ γ T/h w′²_most as long as ‖v̂‖ ≤ γ ‖Δu/h‖.
//
// |M| ≤ k0 w + Σ c_i Δ + Σ Y, with Δ the way in w from anywhere within the tool's travel, behind a contact from the
// surface. In a prompt loop without slips, or behind a contact without dampers at the tool, a mode's share of the bend,
// ½ |w″| c Δ, is at most, its decay being a,
//
//     ½ |w″| r c (w′ + ½ |w″| r / 2(1 − a)) / (1 + a)
//
// since far from rest its stored energy falls by more than the curvature of w can give.
//
// Where parameters change b_w is the least and S the largest over their ranges, and |M| is what springs and slips hold
// at most, whatever is set and whenever (box_hold.hpp). A static spring that does not pull costs nothing where the
// curve softens.
#pragma once

#include <vector>

#include "certify/certificate.hpp"
#include "decompose/port_device.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

// A stretch of the map; the bounds hold for it and for all places that the tool may reach from it within a hold.
struct CurveStretch {
  double from, to;               // the stretch itself [m]
  double steepest;               // the largest w′ [1]
  double largest_curvature;      // of |w″| [1/m]
  std::vector<double> flattest;  // the least w′ where the tool may have been, for each time of a coil [1]
};

// All that the tool reaches of a map on a device.
std::vector<CurveStretch> curve_stretches(const MotionMap& map, const SampledLoop& tool, double coil_lag);

// The bound of what such a motor needs at the tool, with a brake that is told b w′², b being `damping`: what lacks at
// the worst place, plus what the brake assures where the map is flattest. `behind` is the loop behind the map.
PassivityBound bound_behind_curve(MotorConstants motor, double damping, const Network& network,
                                  const std::optional<SlipMotor>& slips, const PortDevice& at_tool,
                                  const std::vector<CurveStretch>& stretches, SampledLoop behind);

// By how much the bound exceeds the damping that is there, over the largest w′², as a brake behind the map sees it at
// the steepest place; negative if there is more [N·s/m].
double lacking_behind_curve(const PassivityBound& bound, double damping, const MotionMap& map, const SampledLoop& tool);

// In: a law of w before its map, what its motor makes behind slips, the device as the law sees it behind the map.
// Out: its certificate at the tool, and of a law with tunables its least and largest b_w. `added_damping` is what the
// brake is to be told besides b_w w′², wherever the tool is.
Certificate certify_behind_curve(UpdateLaw& law, const Network& network, const std::optional<SlipMotor>& slips,
                                 const PortDevice& behind, double sample_period);

}  // namespace dashpot::compiler
