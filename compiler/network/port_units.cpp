#include "network/port_units.hpp"

namespace dashpot::compiler {

PortUnits port_units(motion port_motion) {
  if (port_motion == motion::rotation)
    return {"rad", "rad/s", "N m", "N m/rad", "N m s/rad", "rad/(N m)", "rad/(N m s)"};
  return {"m", "m/s", "N", "N/m", "N s/m", "m/N", "m/(N s)"};
}

}  // namespace dashpot::compiler
