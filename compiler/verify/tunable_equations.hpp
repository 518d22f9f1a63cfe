// What every constant of a law with tunable parameters must be, in 100 digits and from the network alone: each by its
// role's equation, for the part of the network that the law's tables say it is of.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "law/update_law.hpp"
#include "verify/reference_tunables.hpp"

namespace dashpot::compiler {

class TunableEquations {
 public:
  // All outlive this.
  TunableEquations(const ReferenceTunables& tunables, const TunableTables& tables, const Network& network,
                   const LawFacts& facts);

  // The value of a constant, if its role is no choice. Empty if the network has no such part as it is said to belong
  // to.
  std::optional<Reference> value(const Coefficient& constant) const;

  // The yield forces of slips that no parameter changes.
  std::vector<Reference> fixed_yields() const;

 private:
  const ReferenceBlock* block(const ElementList& elements) const;
  const ReferenceRelaxation* mode(const NumberSubject& of) const;
  std::optional<ReferenceSum> number(const NumberSubject& of) const;
  std::optional<Reference> element_value(const OfNumber& of) const;
  std::optional<Reference> least_yield(const ElementList& slip) const;
  Reference least_share() const;

  const ReferenceTunables& tunables_;
  const TunableTables& tables_;
  const Network& network_;
  const LawFacts& facts_;
  std::vector<const ReferenceBlock*> blocks_;
  std::vector<ReferenceSum> side_by_side_;  // springs, dampers or slips, each list by its elements
};

}  // namespace dashpot::compiler
