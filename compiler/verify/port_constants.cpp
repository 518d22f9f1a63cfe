#include "verify/port_constants.hpp"

#include <algorithm>
#include <string_view>

#include "verify/law_constants.hpp"

namespace dashpot::compiler {

namespace {

// Tables of slips that are no tree are written as several constants, each with an end of its own behind their name.
std::optional<NameInPort> name_in_port(const std::string& written, const UpdateLaw& law) {
  if (const auto found = law.names_in_ports.find(written); found != law.names_in_ports.end()) return found->second;
  for (const std::string_view end : {"_links", "_between", "_to_tool", "_to_ground"}) {
    if (!written.ends_with(end)) continue;
    const auto found = law.names_in_ports.find(written.substr(0, written.size() - end.size()));
    if (found != law.names_in_ports.end()) return NameInPort{found->second.port, found->second.name + std::string(end)};
  }
  return std::nullopt;
}

}  // namespace

bool give_to_port(const HeaderConstant& constant, const UpdateLaw& law, std::vector<VerifiedPort>& ports) {
  const std::optional<NameInPort> own = name_in_port(constant.written, law);
  if (!own) return false;
  for (VerifiedPort& port : ports)
    if (port.name == own->port) port.constants.push_back({own->name, constant.values, constant.written});
  return true;
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
    if (!is_rest && !is_tie) diagnostics.report<DiagnosticCode::constant_of_nothing>({}, shown(literals, i), value);
  }
}

void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics) {
  const bool is_one = std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    return c.name == constant.name && c.values == constant.values;
  });
  if (!is_one) diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.written);
}

}  // namespace dashpot::compiler
