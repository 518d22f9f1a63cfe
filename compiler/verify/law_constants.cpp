#include "verify/law_constants.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dashpot::compiler {

std::optional<LawConstant> constant_called(const std::string& name, std::size_t values, const UpdateLaw& law) {
  for (const Coefficient& c : law.coefficients) {
    if (c.name == name && c.values.size() == values) return LawConstant{&c, 0};
    for (std::size_t i = 0; i < c.element_names.size(); ++i)
      if (c.element_names[i] == name && values == 1) return LawConstant{&c, i};
  }
  return std::nullopt;
}

bool is_table_of_map(const std::string& name, const UpdateLaw& law) {
  return std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    return c.name == name && c.role == ConstantRole::map && c.is_table();
  });
}

bool is_chosen(ConstantRole role) {
  switch (role) {
    case ConstantRole::none:
    case ConstantRole::steady_damping:
    case ConstantRole::map:
    case ConstantRole::motor_reach:
    case ConstantRole::brake_reach:
    case ConstantRole::brake_choice:
    case ConstantRole::plain_number: return true;
    case ConstantRole::static_stiffness:
    case ConstantRole::half_static_stiffness:
    case ConstantRole::step_stiffness:
    case ConstantRole::velocity_gain:
    case ConstantRole::decay:
    case ConstantRole::loss:
    case ConstantRole::gain:
    case ConstantRole::velocity_drive:
    case ConstantRole::energy_weight:
    case ConstantRole::spring_stiffness:
    case ConstantRole::spring_compliance:
    case ConstantRole::row:
    case ConstantRole::yield:
    case ConstantRole::mode_weight:
    case ConstantRole::feedthrough:
    case ConstantRole::feedthrough_stiffness:
    case ConstantRole::regime_feedthrough:
    case ConstantRole::recovery_compliance:
    case ConstantRole::surface_place:
    case ConstantRole::element_value:
    case ConstantRole::least_stiffness:
    case ConstantRole::least_yield:
    case ConstantRole::relaxation_share:
    case ConstantRole::relaxation_loss:
    case ConstantRole::sample_period:
    case ConstantRole::sample_rate:
    case ConstantRole::retention:
    case ConstantRole::zero: return false;
  }
  return false;
}

std::string shown(const HeaderConstant& constant, std::size_t place) {
  if (constant.written == literals_in_code) return "a number without a name in the code";
  return constant.values.size() == 1 ? fmt::format("'{}'", constant.written)
                                     : fmt::format("place {} of '{}'", place + 1, constant.written);
}

void compare(const HeaderConstant& constant, std::size_t place, const Reference& exact, ScalarType scalar,
             Diagnostics& diagnostics) {
  const double value = constant.values[place];
  if (is_correctly_rounded(value, exact, scalar)) return;
  diagnostics.report<DiagnosticCode::constant_wrong>({}, shown(constant, place), value, exact.str(20));
}

void compare(const HeaderConstant& constant, const std::vector<Reference>& exact, ScalarType scalar,
             Diagnostics& diagnostics) {
  if (constant.values.size() != exact.size())
    return diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.written);
  for (std::size_t i = 0; i < exact.size(); ++i)
    if (!is_correctly_rounded(constant.values[i], exact[i], scalar))
      return compare(constant, i, exact[i], scalar, diagnostics);
}

void compare_with_compiled(const HeaderConstant& constant, const LawConstant& compiled, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < constant.values.size(); ++i) {
    const double due = compiled.coefficient->values[compiled.first + i];
    if (constant.values[i] != due)
      return diagnostics.report<DiagnosticCode::constant_wrong>({}, shown(constant, i), constant.values[i],
                                                                fmt::format("{}", due));
  }
}

void look_at_literals(const HeaderConstant& literals, const UpdateLaw& law, const std::vector<Reference>& fixed_yields,
                      Diagnostics& diagnostics) {
  const auto holds = [](const auto& all, const auto& is) { return std::any_of(all.begin(), all.end(), is); };
  for (std::size_t i = 0; i < literals.values.size(); ++i) {
    const double value = literals.values[i];
    const bool is_known =
        holds(law.variables,
              [&](const Variable& v) { return v.is_kept() && (v.rest_value == value || v.rest_value == -value); }) ||
        holds(law.networks,
              [&](const SlipNetwork& network) {
                return network.through == value || (!network.links.empty() && network.links.back().lowest == 0 &&
                                                    network.links.back().highest == value);
              }) ||
        holds(fixed_yields, [&](const Reference& yield) {
          return is_correctly_rounded(value, yield, law.scalar) || is_correctly_rounded(-value, yield, law.scalar);
        });
    if (!is_known) diagnostics.report<DiagnosticCode::constant_of_nothing>({}, shown(literals, i), value);
  }
}

void compare_with_facts(const HeaderConstant& constant, const Compilation& compiled, const LawFacts& facts,
                        Diagnostics& diagnostics) {
  const double single = constant.values.front();
  if (constant.name == "damping" && !compiled.law.brake_changes() && single == compiled.law.damping) return;
  if (constant.name == "added_damping" && single == compiled.certificate.added_damping) return;
  const auto known = reference_constants({}, facts);
  const bool is_fact = constant.name == "sample_period" || constant.name == "threshold";
  if (!is_fact) return diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.written);
  compare(constant, known.at(constant.name), facts.scalar, diagnostics);
}

}  // namespace dashpot::compiler
