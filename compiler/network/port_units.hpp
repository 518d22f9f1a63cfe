// Units at a port, as the compiler's text spells them.
#pragma once

#include <dashpot/servo/unit_names.hpp>

#include <string>
#include <string_view>

namespace dashpot::compiler {

struct PortUnits {
  std::string position;    // m | rad
  std::string velocity;    // m/s | rad/s
  std::string force;       // N | N m
  std::string stiffness;   // N/m | N m/rad
  std::string damping;     // N s/m | N m s/rad
  std::string compliance;  // m/N | rad/(N m)
  std::string fluidity;    // m/(N s) | rad/(N m s)
};
PortUnits port_units(motion port_motion);

// "N m s/rad" → "N·m·s/rad"
std::string dotted(std::string_view unit);

// The units at a port, dotted.
PortUnits dotted_units(motion port_motion);

}  // namespace dashpot::compiler
