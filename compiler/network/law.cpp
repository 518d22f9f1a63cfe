#include "network/law.hpp"

#include "network/match.hpp"

namespace dashpot::compiler {

Law make_law(ElementKind kind, double value) {
  switch (kind) {
    case ElementKind::spring: return Spring{value};
    case ElementKind::damper: return Damper{value};
    case ElementKind::slip: return Slip{value};
  }
  return Spring{value};
}

Law with_value(const Law& law, double value) {
  return match(
      law, [&](const Spring&) { return Law(Spring{value}); }, [&](const Damper&) { return Law(Damper{value}); },
      [&](const Slip&) { return Law(Slip{value}); });
}

double value_of(const Law& law) {
  return match(
      law, [](const Spring& spring) { return spring.stiffness; }, [](const Damper& damper) { return damper.damping; },
      [](const Slip& slip) { return slip.yield_force; });
}

Dimension dimension_of(const Law& law, motion port_motion) {
  const bool rotates = port_motion == motion::rotation;
  return match(
      law, [=](const Spring&) { return rotates ? dimensions::rotational_stiffness : dimensions::stiffness; },
      [=](const Damper&) { return rotates ? dimensions::rotational_damping : dimensions::damping; },
      [=](const Slip&) { return rotates ? dimensions::torque : dimensions::force; });
}

std::string_view kind_of(const Law& law) {
  return match(
      law, [](const Spring&) { return std::string_view("spring"); },
      [](const Damper&) { return std::string_view("damper"); }, [](const Slip&) { return std::string_view("slip"); });
}

bool is_spring(const Law& law) {
  return match(
      law, [](const Spring&) { return true; }, [](const Damper&) { return false; }, [](const Slip&) { return false; });
}

bool is_damper(const Law& law) {
  return match(
      law, [](const Spring&) { return false; }, [](const Damper&) { return true; }, [](const Slip&) { return false; });
}

bool is_slip(const Law& law) {
  return match(
      law, [](const Spring&) { return false; }, [](const Damper&) { return false; }, [](const Slip&) { return true; });
}

double stiffness_of(const Law& law) { return is_spring(law) ? value_of(law) : 0; }
double damping_of(const Law& law) { return is_damper(law) ? value_of(law) : 0; }
double yield_force_of(const Law& law) { return is_slip(law) ? value_of(law) : 0; }

}  // namespace dashpot::compiler
