// Numbers and units for readers.
#pragma once

#include <string>

#include "network/network.hpp"

namespace dashpot::compiler {

// At most `digits` significant digits, without trailing zeros; outside 10⁻³ … 10⁵ as 1.5×10⁻⁷. The minus sign is U+2212.
std::string number_text(double value, int digits = 4);

// The same as MathML.
std::string number_mathml(double value, int digits = 4);

// "10⁻³"
std::string power_text(int exponent);

// Units at a port that moves so, with U+00B7 between factors.
struct PortUnits {
  std::string position;    // m | rad
  std::string velocity;    // m/s | rad/s
  std::string force;       // N | N·m
  std::string stiffness;   // N/m | N·m/rad
  std::string damping;     // N·s/m | N·m·s/rad
  std::string compliance;  // m/N | rad/(N·m)
};
PortUnits port_units(motion port_motion);

// "12 N/m": an element's value.
std::string value_text(const Element& element, motion port_motion);

}  // namespace dashpot::compiler
