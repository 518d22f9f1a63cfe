#include "verify/port_constants.hpp"

#include <algorithm>

#include "verify/law_constants.hpp"

namespace dashpot::compiler {

bool give_to_port(const HeaderConstant& constant, const UpdateLaw& law, std::vector<VerifiedPort>& ports) {
  const auto own = law.names_in_ports.find(constant.written);
  if (own == law.names_in_ports.end()) return false;
  for (VerifiedPort& port : ports)
    if (port.name == own->second.port) port.constants.push_back({own->second.name, constant.values, constant.written});
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
  if (!compiled.beyond_linear())
    verify_linear_constants(certificate, compiled.network, compiled.port, header, diagnostics);
  else verify_constants(certificate, compiled.port, header, compiled, diagnostics);
}

void compare_with_written(const HeaderConstant& constant, const UpdateLaw& law, Diagnostics& diagnostics) {
  const bool is_one = std::any_of(law.coefficients.begin(), law.coefficients.end(), [&](const Coefficient& c) {
    return c.name == constant.name && c.values == constant.values;
  });
  if (!is_one) diagnostics.report<DiagnosticCode::unknown_constant>({}, constant.written);
}

}  // namespace dashpot::compiler
