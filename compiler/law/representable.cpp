#include "law/representable.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace dashpot::compiler {
namespace {

// Visits all numbers of a law, each with its name and unit.
template <class Visit>
void each_number(const UpdateLaw& law, motion port_motion, Visit visit) {
  const bool turns = port_motion == motion::rotation;
  const auto all_of = [&](const std::vector<double>& values, std::string_view name, std::string_view unit) {
    for (const double value : values) visit(value, name, unit);
  };
  visit(law.damping, "damping", turns ? "N·m·s/rad" : "N·s/m");
  for (const Coefficient& coefficient : law.coefficients)
    all_of(coefficient.values, coefficient.name, coefficient.unit);
  for (const Variable& variable : law.variables) visit(variable.rest_value, variable.name, variable.unit);
  const std::string_view force = turns ? "N·m" : "N", stiffness = turns ? "N·m/rad" : "N/m";
  for (const Coupling& coupling : law.couplings)
    for (const slip_node<double>& node : coupling.nodes) {
      visit(node.yield, coupling.name, force);
      visit(node.stiffness, coupling.name, stiffness);
      visit(node.compliance, coupling.name, turns ? "rad/(N·m)" : "m/N");
    }
  for (const SlipNetwork& slips : law.networks) {
    for (const slip_link<double>& link : slips.links) all_of({link.lowest, link.highest}, slips.name, force);
    for (const std::vector<double>* all : {&slips.between, &slips.to_tool, &slips.to_ground})
      all_of(*all, slips.name, stiffness);
  }
  if (law.tunable)
    for (const TunableNumber& number : law.tunable->numbers) {
      visit(number.base, "numbers", "SI");
      for (const TunableTerm& term : number.terms) visit(term.share, "numbers", "SI");
    }
  for (const Tunable& t : law.parameters()) all_of({t.range.value, t.range.min, t.range.max}, t.name, t.unit);
}

}  // namespace

bool has_finite_numbers(const UpdateLaw& law) {
  bool all = true;
  each_number(law, motion::translation,
              [&](double value, std::string_view, std::string_view) { all &= std::isfinite(value); });
  return all;
}

bool is_representable(const UpdateLaw& law, const Network& network, Diagnostics& diagnostics) {
  std::string last;
  each_number(law, network.port_motion, [&](double value, std::string_view name, std::string_view unit) {
    if (std::isfinite(value) || name == last) return;
    diagnostics.report<DiagnosticCode::constant_overflows>(network.name_span, name, unit, network.name,
                                                           name_of(law.scalar));
    last = name;
  });
  return last.empty();
}

}  // namespace dashpot::compiler
