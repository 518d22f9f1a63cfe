// The damping that the held forces of ports need over a workspace (theory, section 12), by enclosures with outward
// rounding:
//
//     (1 − ε) D + D_device + x W ≥ T_max 𝓑,        𝓑 = Σ_i [ S_i g_i g_iᵀ + ½ M_i H_i ]
//
// for matrices over the joints, at all joints of the workspace, D at those of the sample and 𝓑 at all that can be
// reached until the next. g and H are gradient and Hessian of the port's map in the joints, M the motor's force along
// it. With n samples of delay
//
//     n |K| + n Σ_i [ 2 (S_i − ½ k0_i) g_i g_iᵀ + |M_i − k0_i w_i| |H_i| ],        K = Σ_i k0_i (g_i g_iᵀ + w_i H_i)
//
// is added, |N| with the |λ| of N v = λ W v. Springs k0 behind a contact or a clamp are counted as other forces are.
#pragma once

#include <functional>
#include <vector>

#include "axes/brakes.hpp"
#include "axes/port_map.hpp"
#include "axes/workspace.hpp"

namespace dashpot::compiler::axes {

// Bounds of the force that a port's network may ask of the motors, from the workspace alone.
struct PortLoad {
  PortMap map;
  double held = 0;       // S of a prompt loop: β, or the supremum of section 6b [N/m]
  double grounded = 0;   // k0: the force k0 w [N/m]
  double relaxing = 0;   // Σ c_i of the modes: within c_i (w − w⁺) … c_i (w − w⁻), over the workspace [N/m]
  double yields = 0;     // of the slips, ± [N]
  double estimated = 0;  // largest force that comes from an estimate, ± [N]
  double clamp = unlimited;  // what the port's force is clamped to, ± [N]
  bool unilateral = false;  // 0 ≤ M ≤ (k0 + Σ c_i) (w − surface) + yields + estimated, nothing where w < surface
  double surface = 0;       // of a unilateral port [m]
};

struct SampledLoop {
  double longest_period = 1e-3;  // T_max [s]
  int delay = 0;                 // n [samples]
  Pair<double> reach{0, 0};      // how far joints go while a force is held and, with delay, until it is [rad]
};

// (1 − ε) D + D_device over joint positions [N·m·s/rad].
using GivenDamping = std::function<Symmetric<Sloped>(const Pair<Sloped>& joints)>;

struct NeededDamping {
  double proved;        // x that suffices everywhere
  double attained;      // x without which some joint position, with its reach, is not covered
  Pair<double> joints;  // that position
  bool close;           // proved − attained is at most the tolerance, of what would be needed with nothing given
};

inline constexpr double bound_tolerance = 0.01;
inline constexpr int most_boxes = 8000;

// An enclosure of a port's map over a workspace [m], tight to 1e-3 of the width of its first enclosure.
Interval range_of(const PortMap& map, const Box& workspace);

// M over joints whose tip is in a box, w in [m] over the workspace.
Interval motor_force(const PortLoad& load, const Interval& depth, const Interval& over_workspace);

// In: an arm without singularities in the workspace and its reach, W = diag(weight) [1]. Parts of the workspace are
// halved, the worst first, until `close` or there are `boxes`. Where nothing is given, the tightest x with D = x W
// alone.
NeededDamping needed_damping(const Arm& arm, const Box& workspace, const std::vector<PortLoad>& loads,
                             const SampledLoop& loop, const Pair<double>& weight, const GivenDamping& given,
                             double tolerance = bound_tolerance, int boxes = most_boxes);

}  // namespace dashpot::compiler::axes
