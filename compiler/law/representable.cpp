#include "law/representable.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace dashpot::compiler {
namespace {

bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

bool is_representable(const UpdateLaw& law, const Network& network, Diagnostics& diagnostics) {
  bool all = true;
  const auto require = [&](const std::vector<double>& values, const std::string& name, const std::string& unit) {
    if (are_finite(values)) return;
    diagnostics.report<DiagnosticCode::constant_overflows>(network.name_span, name, unit, network.name,
                                                           name_of(law.scalar));
    all = false;
  };
  require({law.damping}, "damping", network.port_motion == motion::rotation ? "N·m·s/rad" : "N·s/m");
  for (const Coefficient& coefficient : law.coefficients)
    require(coefficient.values, coefficient.name, coefficient.unit);
  for (const Tunable& t : law.parameters()) require({t.range.value, t.range.min, t.range.max}, t.name, t.unit);
  return all;
}

}  // namespace dashpot::compiler
