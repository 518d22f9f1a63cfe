// Constants and bounds of a law with slips or a contact, against those recomputed in 100 digits.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "verify/certificate_file.hpp"
#include "verify/law_constants.hpp"
#include "verify/slip_equations.hpp"

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
  void look_at(const HeaderConstant& written, std::size_t number, const Coefficient& constant, std::size_t place);
  void look_at_through(const SlipNetwork& table);
  std::optional<SlipEquations::Values> table_called(const std::string& name) const;
  Reference signed_weight(double written, const Coefficient& constant, const Reference& exact);

  const CertificateFile& certificate_;
  const HeaderConstants& header_;
  const Compilation& compiled_;
  Diagnostics& diagnostics_;
  LawFacts facts_;
  ReferenceTree tree_;
  ReferenceForm linear_;  // with the states that the law has
  SlipEquations equations_;
  std::map<std::pair<ElementList, std::size_t>, int> signs_;  // of the modes of parts that are no tree
};

}  // namespace dashpot::compiler
