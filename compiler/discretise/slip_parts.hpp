// All parts of a law behind slips: components with one slip each, in groups; trees of coupled slips; networks of slips
// that meet in no tree; and the brake's command for slips that are solved together.
#pragma once

#include <memory>
#include <vector>

#include "discretise/coupled_slips.hpp"
#include "discretise/networked_slips.hpp"
#include "discretise/slip_brake.hpp"
#include "discretise/slip_group.hpp"

namespace dashpot::compiler {

class SlipParts {
 public:
  // All must outlive this object. Behind a contact all slips are solved together.
  SlipParts(LawWriter& writer, const Network& network, const Real& sample_period, const NormalForm& form,
            const SlipDecomposition& settings);

  bool empty() const { return groups_.empty() && trees_.empty() && networks_.empty(); }
  double smallest_loss() const;  // min (1 − a) over all modes; 1 without
  void declare();                // to be called when the law's mode form is settled

  // `sum` and the parts' force, from the tool's displacement in this sample.
  ExpressionId write_output(ExpressionId sum, VariableId change, VariableId position);
  // The whole force behind a contact: `approach` is what the surface's change would be if it stuck to the tool.
  ExpressionId write_push(VariableId approach, VariableId surface_change, const BesideSlips& beside);
  void write_update(VariableId change);
  ExpressionId energy(ExpressionId sum);

  const std::vector<std::unique_ptr<SlipGroup>>& groups() const { return groups_; }

  // Slips that are solved together and their share in the brake. Exactly one of the two solvers, which know the signs,
  // is there.
  struct Braked {
    std::unique_ptr<SlipBrake> brake;
    CoupledSlips* tree;
    NetworkedSlips* network;
    std::vector<VariableId> signs;  // none if nothing changes
  };
  const std::vector<Braked>& braked() const { return braked_; }

 private:
  void add(const NormalTree& component, const ComponentSplit* split);
  void add(const std::vector<std::size_t>& elements, bool is_pushed);
  void add_behind_contact(const NormalForm& form);
  void add_brake(const ComponentSplit& split, CoupledSlips* tree);
  void declare(Braked& part);

  LawWriter& writer_;
  const Network& network_;
  Real sample_period_;
  const SlipDecomposition& settings_;
  std::vector<std::unique_ptr<SlipGroup>> groups_;
  std::vector<std::unique_ptr<CoupledSlips>> trees_;
  std::vector<std::unique_ptr<NetworkedSlips>> networks_;
  std::vector<Braked> braked_;
  NormalTree whole_{};  // behind a contact
};

}  // namespace dashpot::compiler
