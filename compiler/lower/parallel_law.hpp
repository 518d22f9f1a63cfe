// One law for several ports on one axis: each has its own law of the tool's position and of the estimate of its
// velocity, behind its own static curve, contact and limits, and what they make adds up (theory, section 11):
//
//     m = Σ m_i,   b = Σ b_i,   V = Σ V_i
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct ParallelPort {
  std::string name;
  UpdateLaw law;                         // without tunables
  std::optional<double> clamps_at = {};  // its share of the motor's force, where the law itself keeps no limit [N]
};

// `added_damping` is what the brake is to be told besides [N·s/m]. Ensures: names begin with the port's name where they
// come from a port.
UpdateLaw parallel_law(const std::vector<ParallelPort>& ports, double added_damping, motion port_motion);

}  // namespace dashpot::compiler
