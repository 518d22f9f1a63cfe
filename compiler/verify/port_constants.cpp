#include "verify/port_constants.hpp"

#include <algorithm>

namespace dashpot::compiler {

std::optional<std::size_t> port_of(const std::string& constant, const std::vector<VerifiedPort>& ports) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < ports.size(); ++i)
    if (constant.starts_with(ports[i].name + "_") && (!best || ports[i].name.size() > ports[*best].name.size()))
      best = i;
  return best;
}

void give(const HeaderConstant& constant, VerifiedPort& port) {
  HeaderConstant own = constant;
  own.name = constant.name.substr(port.name.size() + 1);
  const std::size_t end = own.name.find_last_not_of("0123456789");
  const auto is_one = [&](const std::string& told) {
    return std::any_of(port.law->coefficients.begin(), port.law->coefficients.end(), [&](const Coefficient& c) {
      const std::vector<std::string>& names = c.element_names;
      return c.name == told || std::find(names.begin(), names.end(), told) != names.end();
    });
  };
  const bool is_numbered = end != own.name.npos && end + 1 < own.name.size() && own.name[end] == '_';
  if (!is_one(own.name) && is_numbered && is_one(own.name.substr(0, end))) own.name.resize(end);
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
  for (std::size_t i = 0; i < literals.values.size(); ++i)
    if (std::none_of(law.variables.begin(), law.variables.end(),
                     [&](const Variable& variable) { return variable.rest_value == literals.values[i]; }))
      diagnostics.report<DiagnosticCode::constant_of_nothing>({}, literals.name, i + 1, literals.values[i]);
}

void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics) {
  const bool is_one = std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    return c.name == constant.name && c.values == constant.values;
  });
  if (!is_one) diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.name);
}

}  // namespace dashpot::compiler
