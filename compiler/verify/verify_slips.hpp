// Constants and bounds of a law with slips or a contact, against those recomputed in 100 digits.
#pragma once

#include "verify/certificate_file.hpp"
#include "verify/header_constants.hpp"
#include "verify/reference_slips.hpp"

namespace dashpot::compiler {

class SlipVerification {
 public:
  SlipVerification(const CertificateFile& certificate, const HeaderConstants& header, const PortDevice& device,
                   const Compilation& compiled, Diagnostics& diagnostics);

  // Both report every disagreement.
  void recompute_constants();
  void recompute_bounds();

 private:
  void look_at(const HeaderConstant& constant);
  bool is_in_pool(std::string_view kind, double constant) const;
  void compare_with_choice(const HeaderConstant& constant);

  const CertificateFile& certificate_;
  const HeaderConstants& header_;
  const Compilation& compiled_;
  Diagnostics& diagnostics_;
  LawFacts facts_;
  ReferenceTree tree_;
  ReferenceForm linear_;  // with the states that the law has
  Pool pool_;
};

}  // namespace dashpot::compiler
