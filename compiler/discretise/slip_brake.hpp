// What a group of components with one slip each asks of the brake, and what the motor takes back of it (theory, section
// 5, "Regimes"): vectors with one place a component.
#pragma once

#include <string>
#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

// A component's shares with its slip stuck and sliding.
struct BrakePair {
  BrakeShare stuck, sliding;

  bool changes() const { return stuck.damping != sliding.damping; }
  bool compensates() const { return sliding.compensation > 0; }
};

// The pair of a component; nothing for the brake where its regimes are not listed.
BrakePair brake_pair(const ComponentSplit& split);

class SlipBrake {
 public:
  // `settings`: hysteresis, hold and coil. Outlives this.
  SlipBrake(LawWriter& writer, const SlipDecomposition& settings) : writer_(writer), settings_(settings) {}

  void add(const BrakePair& pair, const Real& yield_force, const Real& trial_by_change);
  const BrakePair& pair(std::size_t place) const { return pairs_[place]; }
  // Components go together where the same of their shares change.
  std::string shape(const BrakePair& pair) const;

  void declare(const std::string& prefix, const Names& names);
  // `sliding`: above zero where the slip gives way, `excess` then and only then not zero.
  void write_output(ExpressionId sliding, VariableId trial, VariableId slip, VariableId excess);
  void write_update();

  VariableId changing_damping() const { return damping_; }  // a vector, `nothing` where no place changes
  Real steady_damping() const;                              // of the places where it does not change [N·s/m]
  Real least_damping() const;                               // of all
  Real largest_damping() const;
  Real damping_at_rest() const;
  VariableId compensation() const { return compensation_; }  // β of each place, `nothing` for none
  VariableId shortfall() const { return shortfall_; }        // of b where the coil is on its way, `nothing` for none

 private:
  bool coil_lags() const { return settings_.coil_share < 1; }
  bool has_hysteresis() const { return settings_.hysteresis > 0; }
  bool changes() const { return !pairs_.empty() && pairs_.front().changes(); }
  bool compensates() const { return !pairs_.empty() && pairs_.front().compensates(); }
  ExpressionId keep_sliding(ExpressionId sliding, VariableId trial, VariableId slip, VariableId excess);
  void write_damping(ExpressionId commanded);
  ExpressionId nearer(VariableId from, ExpressionId goal);
  void write_limited_damping(ExpressionId wanted);
  void write_compensation(ExpressionId commanded);
  VariableId local(const std::string& what, const std::string& unit, const std::string& meaning);
  VariableId state(const std::string& what, const std::string& unit, const std::string& meaning);
  template <class ValueOf>
  ExpressionId per_place(const char* name, const std::string& unit, const char* meaning, ValueOf value_of);

  LawWriter& writer_;
  const SlipDecomposition& settings_;
  std::string prefix_;
  Names names_;
  std::vector<BrakePair> pairs_;
  std::vector<Real> leave_;  // Y (Y − hysteresis·∂t/∂u) [N²]
  ExpressionId share_ = nothing;
  VariableId slid_ = nothing, samples_ = nothing, way_ = nothing, earned_way_ = nothing, earned_ = nothing;  // states
  VariableId damping_ = nothing, slide_ = nothing, samples_now_ = nothing, way_now_ = nothing,
             earned_way_now_ = nothing, earned_now_ = nothing, shortfall_ = nothing, compensation_ = nothing;  // locals
};

}  // namespace dashpot::compiler
