#include "verify/port_constants.hpp"

#include <algorithm>

namespace dashpot::compiler {

namespace {

// What a name is without the port's; empty where it is not the port's.
std::string without_port(const std::string& constant, const VerifiedPort& port) {
  return constant.starts_with(port.name + "_") ? constant.substr(port.name.size() + 1) : "";
}

bool is_of_law(const std::string& name, const UpdateLaw& law) {
  return std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    const std::vector<std::string>& names = c.element_names;
    return c.name == name || std::find(names.begin(), names.end(), name) != names.end();
  });
}

// The same without what keeps apart what would be called alike, where the port's law has such a constant.
std::string own_name(const std::string& name, const VerifiedPort& port) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const bool is_numbered = end != name.npos && end + 1 < name.size() && name[end] == '_';
  if (!is_of_law(name, *port.law) && is_numbered && is_of_law(name.substr(0, end), *port.law))
    return name.substr(0, end);
  return name;
}

}  // namespace

std::optional<std::size_t> port_of(const std::string& constant, const std::vector<VerifiedPort>& ports) {
  std::optional<std::size_t> best;
  bool is_known = false;
  for (std::size_t i = 0; i < ports.size(); ++i) {
    const std::string own = without_port(constant, ports[i]);
    if (own.empty()) continue;
    const bool is_own = is_of_law(own_name(own, ports[i]), *ports[i].law);
    const bool is_longer = !best || ports[i].name.size() > ports[*best].name.size();
    if (is_own > is_known || (is_own == is_known && is_longer)) best = i, is_known = is_own;
  }
  return best;
}

void give(const HeaderConstant& constant, VerifiedPort& port) {
  HeaderConstant own = constant;
  own.name = own_name(without_port(constant.name, port), port);
  port.constants.push_back(std::move(own));
}

void recompute_port(const VerifiedPort& port, ScalarType scalar, Diagnostics& diagnostics) {
  Compilation compiled = *port.compiled;
  compiled.law = *port.law;
  CertificateFile certificate;
  certificate.choices = port.choices;
  certificate.damping = compiled.decomposition.choice().damping;
  const HeaderConstants header{scalar, port.constants};
  for (const HeaderConstant& constant : header.all) certificate.constants[constant.name] = constant.values;
  if (is_plainly_linear(compiled.network))
    verify_linear_constants(certificate, compiled.network, compiled.port, header, diagnostics);
  else verify_constants(certificate, compiled.port, header, compiled, diagnostics);
}

void look_at_literals(const HeaderConstant& literals, const UpdateLaw& law, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < literals.values.size(); ++i) {
    const double value = literals.values[i];
    const bool is_rest = std::any_of(law.variables.begin(), law.variables.end(),
                                     [&](const Variable& variable) { return variable.rest_value == value; });
    const bool is_tie = std::any_of(law.networks.begin(), law.networks.end(),
                                    [&](const SlipNetwork& network) { return network.through == value; });
    if (!is_rest && !is_tie) diagnostics.report<DiagnosticCode::constant_of_nothing>({}, literals.name, i + 1, value);
  }
}

void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics) {
  const bool is_one = std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    return c.name == constant.name && c.values == constant.values;
  });
  if (!is_one) diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.name);
}

}  // namespace dashpot::compiler
