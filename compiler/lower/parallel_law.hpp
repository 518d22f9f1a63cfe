// One law for several ports on one axis. Each port has its own law, with its own static curve, contact and limits;
// motor forces, brake dampings and stored energies add up (theory, section 11):
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
  std::optional<double> clamps_at = {};  // its share of the motor's force, if the law itself keeps no limit [N]
};

// `added_damping` is added to the brake's command [N·s/m]. Ensures: names begin with the port's name where they
// come from a port.
UpdateLaw parallel_law(const std::vector<ParallelPort>& ports, double added_damping, motion port_motion);

}  // namespace dashpot::compiler
