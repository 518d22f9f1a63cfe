// Slips that meet in a part of a network that is no tree, written as one step of dashpot::slip_network between scalars
// of the law (theory, section 5, "Not a tree").
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discretise/law_writer.hpp"
#include "discretise/mode_bank.hpp"
#include "linear/multiport_form.hpp"

namespace dashpot::compiler {

// The linear part between the surface of a contact and the ground, beside the slips. Its states are written elsewhere.
struct BesideSlips {
  Real stiffness;                 // g [N/m]
  VariableId held = no_variable;  // π [N]
};

class NetworkedSlips {
 public:
  // `elements`: those of the part. With a contact the tool pushes the node at which they end and cannot pull it.
  NetworkedSlips(LawWriter& writer, const Network& network, const Real& sample_period,
                 std::vector<std::size_t> elements, bool is_pushed);

  double smallest_loss() const;  // min (1 − a) over all modes; 1 without
  void declare();                // to be called when the law's mode form is settled

  // The part's force, from the tool's displacement in this sample.
  ExpressionId write_output(VariableId change);
  // The same behind a contact: `change` is the surface's change if it stuck to the tool, `surface_change` is set to the
  // actual one.
  ExpressionId write_push(VariableId change, VariableId surface_change, const BesideSlips& beside);
  void write_update();
  ExpressionId energy();  // nothing without springs

  // The sign of the slip with these elements, after declare(): 0 where it holds.
  VariableId sign_of(const std::vector<std::size_t>& slip) const;

 private:
  struct SpringTie {
    Tie tie;
    std::string name;
    VariableId force = nothing;
  };
  struct NetworkMode {
    MultiportMode mode;
    std::string name;
    std::unique_ptr<ModeBank> bank;
  };

  NodeIndex node_of(std::size_t terminal) const;
  Subject subject_of(const Tie& tie) const;
  OfPartMode subject_of(std::size_t mode) const;
  Derivation weight_of(const NetworkMode& mode, std::size_t terminal) const;
  void number_ends();
  void add_links();
  void add_modes();
  void add_stiffness(std::size_t a, std::size_t b, const Real& stiffness);
  void round_stiffness();
  int end_of(std::size_t terminal) const;
  ExpressionId held_at(std::size_t terminal);
  VariableId write_held(std::size_t terminal, VariableId beside);
  ExpressionId write_step(VariableId change);
  // How far a terminal moves in this sample; nothing for the ground.
  ExpressionId movement(std::size_t terminal);
  ExpressionId elongation(const Tie& tie);
  ExpressionId drive(const NetworkMode& mode);

  LawWriter& writer_;
  const Network& network_;
  Real sample_period_;
  std::vector<std::size_t> elements_;
  bool is_pushed_;
  MultiportForm form_;
  std::string name_;
  SlipNetwork step_;
  std::vector<Real> between_, to_tool_, to_ground_;
  Real through_ = 0;
  std::vector<std::string> end_names_;  // of the inner ends
  std::vector<SpringTie> springs_;
  std::vector<NetworkMode> modes_;
  VariableId change_ = nothing;
};

}  // namespace dashpot::compiler
