// A component in which several slips meet, written as one step of dashpot::slip_tree between scalars of the law
// (theory, section 5, "Coupled trees").
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"
#include "discretise/mode_bank.hpp"
#include "discretise/slip_table.hpp"

namespace dashpot::compiler {

class CoupledSlips {
 public:
  // The component must outlive this object.
  CoupledSlips(LawWriter& writer, const Network& network, const Real& sample_period, const NormalTree& component);

  // The states of this block of the component are written by somebody else. Its held force π is set before the output
  // is written; no variable for 0.
  void keep_elsewhere(const NormalTree& block);
  void set_held_elsewhere(VariableId held) { held_elsewhere_ = held; }

  // Lets the rest of the law know which slips give way.
  void follow_signs() { has_signs_ = true; }

  double smallest_loss() const;  // min (1 − a) over all modes; 1 without
  void declare();                // to be called when the law's mode form is settled

  // The component's force, from the tool's displacement in this sample. Where the tool pushes and cannot pull, `change`
  // is what the surface's change would be if it stuck to the tool, and `surface_change` gets the actual one.
  ExpressionId write_output(VariableId change, VariableId surface_change = nothing);
  void write_update();
  ExpressionId energy();  // nothing without springs

  // The sign of the slip with these elements, after declare(): 0 where it holds. Only with follow_signs().
  VariableId sign_of(const std::vector<std::size_t>& slip) const;

 private:
  struct Block {
    const NormalTree* part;
    std::string name;
    std::unique_ptr<ModeBank> modes;
    VariableId spring_force = nothing;  // F0, of the static stiffness
    VariableId elongation = nothing;    // δ

    bool is_elsewhere = false;

    const LinearForm& form() const { return part->form; }
    bool has_spring() const { return !is_elsewhere && part->form.static_stiffness > 0; }
  };

  Block block_of(const NormalTree& part, const Real& sample_period);
  VariableId write_held(const Block& block);
  ExpressionId spring_energy(const Block& block);
  std::vector<std::vector<std::size_t>> origins() const;

  LawWriter& writer_;
  const Network& network_;
  SlipTable table_;
  std::string name_;
  std::vector<Block> blocks_;
  VariableId held_elsewhere_ = no_variable;
  bool has_signs_ = false;
  std::vector<VariableId> signs_;  // in the order of the table
};

}  // namespace dashpot::compiler
