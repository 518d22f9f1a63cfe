#include "network/law.hpp"

namespace dashpot::compiler {
namespace {

struct ValueOf {
  double operator()(const Spring& spring) const { return spring.stiffness; }
  double operator()(const Damper& damper) const { return damper.damping; }
  double operator()(const Slip& slip) const { return slip.yield_force; }
};

struct DimensionOf {
  bool rotates;

  Dimension operator()(const Spring&) const {
    return rotates ? dimensions::rotational_stiffness : dimensions::stiffness;
  }
  Dimension operator()(const Damper&) const { return rotates ? dimensions::rotational_damping : dimensions::damping; }
  Dimension operator()(const Slip&) const { return rotates ? dimensions::torque : dimensions::force; }
};

struct KindOf {
  std::string_view operator()(const Spring&) const { return "spring"; }
  std::string_view operator()(const Damper&) const { return "damper"; }
  std::string_view operator()(const Slip&) const { return "slip"; }
};

}  // namespace

Law make_law(ElementKind kind, double value) {
  switch (kind) {
    case ElementKind::spring: return Spring{value};
    case ElementKind::damper: return Damper{value};
    case ElementKind::slip: return Slip{value};
  }
  return Spring{value};
}

double value_of(const Law& law) { return std::visit(ValueOf{}, law); }

Dimension dimension_of(const Law& law, motion port_motion) {
  return std::visit(DimensionOf{port_motion == motion::rotation}, law);
}

std::string_view kind_of(const Law& law) { return std::visit(KindOf{}, law); }

}  // namespace dashpot::compiler
