#include "verify/recompiled.hpp"

namespace dashpot::compiler {

void expect_bound(const char* what, double stated, double found, Diagnostics& diagnostics) {
  if (stated != found) diagnostics.report<DiagnosticCode::bound_wrong>({}, what, stated, found);
}

void compare_with_recompiled(const CertificateFile& certificate, const Compilation& again,
                             const std::optional<ReferenceGain>& gain, ScalarType scalar, Diagnostics& diagnostics) {
  const Certificate& found = again.certificate;
  if (!agrees(certificate.quantisation_gain, found.quantisation_gain, gain, scalar))
    diagnostics.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed gain", "quantisation");
  expect_bound("needed damping", certificate.needed_damping, found.bound.needed, diagnostics);
  expect_bound("assured damping", certificate.assured_damping, found.assured, diagnostics);
  expect_bound("brake command", certificate.brake_command, again.law.damping, diagnostics);
  expect_bound("added damping", certificate.added_damping, found.added_damping, diagnostics);
  if (certificate.proof != name_of(found.bound.proof) || certificate.certified != found.certified)
    diagnostics.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed bound", "proof");
}

}  // namespace dashpot::compiler
