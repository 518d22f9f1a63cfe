// How large the motors' part is over a workspace: sizes ‖N‖ = max |λ| with N v = λ W v of matrices N over the joints,
// where W = diag(weight), by enclosures with outward rounding. A certificate uses them for bounds that do not depend on
// where the joints were before (theory, section 12).
#pragma once

#include <vector>

#include "axes/brakes.hpp"
#include "axes/viscous_field.hpp"
#include "axes/workspace_bound.hpp"

namespace dashpot::compiler::axes {

// A size over a workspace.
struct Size {
  double most;      // upper bound everywhere
  double attained;  // reached at some place
};

// A port with damping.
struct PortDamping {
  PortMap map;
  double damping = 0;   // b [N·s/m]
  bool is_off = false;  // it may be off at times, behind a contact
};

// All look at up to `parts` of the workspace. ‖R‖, R = B* − D of what ports and field want and what the brakes make of
// it by a rule, whichever ports are off [N·s/m for a weight in m²]. By `non_injecting` 0 ≤ R ≤ B*, and ‖B*‖ is taken.
Size largest_remainder(const Arm& arm, const Box& workspace, const std::vector<PortDamping>& ports,
                       const ViscousField& field, const std::vector<Brake>& brakes, BrakeRule rule,
                       const Pair<double>& weight, int parts = most_boxes);

// The same for two brakes by `diagonal`, without their coupling.
Size largest_uncoupled_remainder(const Arm& arm, const Box& workspace, const std::vector<PortDamping>& ports,
                                 const ViscousField& field, const Pair<Brake>& brakes, const Pair<double>& weight,
                                 int parts = most_boxes);

// ‖[[0, σ], [−σ, 0]]‖ of a field's antisymmetric part.
Size largest_curl(const Arm& arm, const Box& workspace, const ViscousField& field, const Pair<double>& weight,
                  int parts = most_boxes);

// ‖g gᵀ‖ of a port's gradient g.
Size largest_gradient(const Arm& arm, const Box& workspace, const PortMap& map, const Pair<double>& weight,
                      int parts = most_boxes);

// |M| ‖H‖ of a port's force and its map's Hessian H: how much a motion of the joints turns the torque.
Size largest_turning(const Arm& arm, const Box& workspace, const PortLoad& load, const Pair<double>& weight,
                     int parts = most_boxes);

}  // namespace dashpot::compiler::axes
