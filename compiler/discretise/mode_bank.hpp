// Maxwell elements in parallel that share one drive: their states, update and energy (theory, section 3).
//
// The state of a mode is its force decayed to the next sample, G = a F: the sum of the states is then all that the next
// command needs of them.
#pragma once

#include <string>
#include <vector>

#include "discretise/law_writer.hpp"
#include "discretise/mode_coefficients.hpp"

namespace dashpot::compiler {

class ModeBank {
 public:
  // `names`: one emitted name for each mode. `prefix` goes before the names of the bank's own variables; empty for the
  // modes at the port. `of`: the block or the part that the modes belong to; empty at the port.
  ModeBank(LawWriter& writer, const std::vector<Mode>& modes, StateInput input, const Real& sample_period, Names names,
           std::string prefix, std::vector<Subject> of = {});

  bool empty() const { return modes_.empty(); }
  bool follows_position() const;  // some mode is driven by displacement
  bool follows_velocity() const;
  Real step_stiffness() const;   // Σ c_i: force for a displacement within the sample [N/m]
  Real velocity_gain() const;    // h Σ c_i of the modes that the estimate drives [N·s/m]
  double smallest_loss() const;  // min (1 − a); 1 for an empty bank

  void declare();                                          // to be called when the law's mode form is settled
  VariableId decayed_sum() const { return decayed_sum_; }  // Σ G_i
  // Either drive may be `nothing` where no mode follows it.
  void write_update(VariableId position_change, VariableId velocity);
  ExpressionId energy();  // Σ F²/(2k); nothing for an empty bank

 private:
  ExpressionId drive(VariableId position_change, VariableId velocity);
  ExpressionId increment(ExpressionId drive);
  void write_compensated(ExpressionId drive);
  std::vector<std::vector<std::size_t>> origins() const;
  template <class ValueOf>
  ExpressionId per_mode(ConstantRole role, const char* name, const std::string& unit, const char* meaning,
                        ValueOf value_of);
  VariableId state(const char* name, const char* meaning, Role role = Role::state);
  // "mode", since "force" alone is a name of the law's own.
  std::string vector_name() const { return prefix_.empty() ? "mode" : prefix_; }

  LawWriter& writer_;
  std::vector<Mode> modes_;
  std::vector<ModeCoefficients> coefficients_;
  Names names_;
  std::string prefix_;
  std::vector<Subject> of_;
  std::size_t bank_;
  VariableId decayed_sum_ = nothing, forces_ = nothing, errors_ = nothing;
};

}  // namespace dashpot::compiler
