// Constants and bounds of a law with tunable parameters, against those recomputed in 100 digits.
#pragma once

#include "verify/certificate_file.hpp"
#include "verify/header_constants.hpp"
#include "verify/reference_box.hpp"
#include "verify/tunable_equations.hpp"

namespace dashpot::compiler {

class TunableVerification {
 public:
  TunableVerification(const CertificateFile& certificate, const HeaderConstants& header, const Compilation& compiled,
                      Diagnostics& diagnostics);

  // Both report every disagreement.
  void recompute_constants();
  void recompute_bounds();

 private:
  void look_at(const HeaderConstant& constant);
  std::vector<Reference> ranges() const;
  bool covers(double stated, const ReferenceBox& box, const Reference& share) const;

  const CertificateFile& certificate_;
  const HeaderConstants& header_;
  const Compilation& compiled_;
  Diagnostics& diagnostics_;
  LawFacts facts_;
  ReferenceTunables tunables_;
  TunableEquations equations_;
};

}  // namespace dashpot::compiler
