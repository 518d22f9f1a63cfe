#include "network/port_units.hpp"

namespace dashpot::compiler {

PortUnits port_units(motion port_motion) {
  if (port_motion == motion::rotation)
    return {"rad", "rad/s", "N m", "N m/rad", "N m s/rad", "rad/(N m)", "rad/(N m s)"};
  return {"m", "m/s", "N", "N/m", "N s/m", "m/N", "m/(N s)"};
}

std::string dotted(std::string_view unit) {
  std::string text;
  for (const char c : unit) text += c == ' ' ? "·" : std::string(1, c);
  return text;
}

PortUnits dotted_units(motion port_motion) {
  PortUnits units = port_units(port_motion);
  for (std::string* unit : {&units.force, &units.stiffness, &units.damping, &units.compliance, &units.fluidity})
    *unit = dotted(*unit);
  return units;
}

}  // namespace dashpot::compiler
