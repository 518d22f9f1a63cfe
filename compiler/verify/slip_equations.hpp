// What every constant of a law with slips or a contact must be, in 100 digits and from the network alone: each by its
// role's equation, for the part of the network that it is said to be of.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "law/update_law.hpp"
#include "verify/reference_network.hpp"
#include "verify/reference_slips.hpp"
#include "verify/slip_rows.hpp"

namespace dashpot::compiler {

class SlipEquations {
 public:
  // `tree`: a rendered one. `linear`: what reaches ground without a slip, with the states that the law has. `slips`:
  // what the brake was given in every regime; a choice. All but `linear` outlive this.
  SlipEquations(const ReferenceTree& tree, ReferenceForm linear, const Network& network, const SlipDecomposition& slips,
                const LawFacts& facts);

  // One of a constant's values, if its role is no choice. Empty if the network has no such part as the constant is said
  // to belong to.
  std::optional<Reference> value(const Coefficient& constant, std::size_t place) const;

  // The numbers of a table in the order of the emitted text; empty likewise. Of a tree stiffness, compliance and yield
  // force of each node.
  using Values = std::vector<Reference>;
  std::optional<Values> nodes(const Coupling& coupling) const;
  std::optional<Values> links(const SlipNetwork& table) const;  // lowest and highest force of each slip
  std::optional<Values> between(const SlipNetwork& table) const;
  std::optional<Values> to_tool(const SlipNetwork& table) const;
  std::optional<Values> to_ground(const SlipNetwork& table) const;
  std::optional<Reference> through(const SlipNetwork& table) const;

  // False if in some regime the brake was given more damping than that regime has.
  bool are_shares_within_regimes() const;

 private:
  struct KnownNetwork {
    ElementList elements;
    ReferenceNetwork form;
  };
  struct KnownRows {
    ElementList slip;
    std::vector<ElementList> blocks;
    std::vector<const ReferencePart*> parts;
    SlipRows rows;
    const std::vector<BrakeShare>* shares;  // nothing where the brake has none
  };

  ElementList index(const ReferencePart& part);
  void add_rows(const ReferencePart& component, const std::vector<BrakeShare>* shares);
  const ReferencePart* part(const ElementList& elements) const;
  const ReferenceNetwork* network(const ElementList& elements) const;
  const ReferenceNetworkMode* mode(const OfPartMode& of) const;
  Reference stiffness(const ReferencePart& part) const;

  std::optional<Reference> of_whole(const Coefficient& constant, std::size_t place) const;
  std::optional<Reference> of_mode(ConstantRole role, const Subject& subject, std::size_t place) const;
  std::optional<Reference> spring(const Subject& subject) const;
  std::optional<Reference> row(const OfRow& row) const;
  std::optional<Reference> regime_feedthrough(const OfRegime& of) const;
  std::optional<Reference> feedthrough_of(const OfRegime& of, std::size_t regime) const;
  std::optional<Reference> tie(const ElementList& elements, NodeIndex first, NodeIndex second) const;
  std::optional<Values> ties(const SlipNetwork& table, NodeIndex other) const;

  const ReferenceTree& tree_;
  ReferenceForm linear_;
  const Network& network_;
  const SlipDecomposition& slips_;
  const LawFacts& facts_;
  std::map<std::string, std::vector<Reference>> whole_;  // of what reaches ground without a slip, by kind
  ReferencePart behind_surface_;                         // all that is behind a contact, where that is a tree
  std::map<ElementList, const ReferencePart*> parts_;
  std::vector<KnownNetwork> networks_;
  std::vector<KnownRows> rows_;
};

}  // namespace dashpot::compiler
