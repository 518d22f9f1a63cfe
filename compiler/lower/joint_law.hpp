// One law for all ports of a device with several joints (theory, section 12). From the joints' positions q and the
// estimates v of their velocities, with the tip at x(q), its Jacobian J, and the map w_i of each port,
//
//     w_i = w_i(x(q)),   g_i = J(q)ᵀ ∇w_i,   each port's own law of w_i and g_i·v gives its motor's part M_i and b_i,
//     B* = Σ b_i g_i g_iᵀ + Jᵀ A J,          the brakes make D = Σ d_j a_j a_jᵀ, chosen by a rule,
//     τ = Σ g_i M_i + (B* − D) v. A field A whose matrix is not symmetric adds its antisymmetric part, perhaps limited
//     by a gate.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "axes/brakes.hpp"
#include "axes/kinematics.hpp"
#include "axes/port_map.hpp"
#include "axes/viscous_field.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

struct PortLaw {
  std::string name;
  axes::PortMap map;
  UpdateLaw law;  // for one axis, unrolled and without tunables
};

struct JointPlan {
  axes::Arm arm;
  std::vector<axes::Brake> brakes;
  std::vector<double> added;  // to each brake's command, uncompensated [N·m·s/rad] or [N·s/m]
  axes::BrakeRule rule = axes::BrakeRule::diagonal;
  axes::ViscousField field = {};  // A [N·s/m]
  motion joint_motion = motion::rotation;
  std::optional<axes::CurlGate> gate = std::nullopt;  // only with two brakes and the rule `diagonal`
  axes::Pair<std::pair<double, double>> ranges = {};  // limits of the joints [rad] or [m]; low == high: unlimited
};

// Ensures: names begin with the port's name where they come from a port.
UpdateLaw joint_law(const std::vector<PortLaw>& ports, const JointPlan& plan);

}  // namespace dashpot::compiler
