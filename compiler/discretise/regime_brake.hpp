// What slips that are solved together ask of the brake, by the pattern in which they give way (theory, section 5,
// "Regimes"): b of the regime, m = f′ = f − x Δu/h with x ≤ b∞ of what is computed, less β v̂ where the brake has earned
// it.
#pragma once

#include <string>
#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "discretise/law_writer.hpp"

namespace dashpot::compiler {

class RegimeBrake {
 public:
  // Both outlive this.
  RegimeBrake(LawWriter& writer, const ComponentSplit& split, const SlipDecomposition& settings)
      : writer_(writer), split_(split), settings_(settings) {}

  // True where it takes anything, and where what it takes changes, so that it must know which slips give way.
  bool takes_part() const { return largest_damping() > 0; }
  bool changes() const;
  const std::vector<SlipElements>& slips() const { return split_.regimes.slips; }

  void declare(const std::string& prefix, const Names& slip_names);
  // `signs`: not 0 where a slip gives way, in the order of slips(), none where nothing changes; `position`: of the
  // tool.
  void write_output(const std::vector<VariableId>& signs, VariableId position);
  // f′ from f: what is taken is x Δu/h.
  ExpressionId without_feedthrough(ExpressionId force, VariableId change, const Real& sample_period);
  // `released`: of a contact, above 0 where the tool is free, which ends what has been earned; else no variable.
  void write_update(VariableId released);

  ExpressionId compensation() const;      // β, whose β v̂ is to be taken from the force; nothing without
  ExpressionId changing_damping() const;  // nothing where it does not change
  ExpressionId shortfall() const;         // of b where the coil is on its way, nothing for none
  Real steady_damping() const { return changes() ? Real(0) : Real(split_.shares.front().damping); }
  Real damping_at_rest() const { return split_.shares.front().damping; }
  double least_damping() const;
  double largest_damping() const;

 private:
  struct Memory {
    VariableId slid,
        at;  // states: 1 where the command takes the slip for sliding; where the tool was when it last slid
    VariableId slides_now, at_now;
  };

  bool coil_lags() const { return settings_.coil_share < 1; }
  bool has_hysteresis() const { return settings_.hysteresis > 0; }
  void write_memory(std::size_t slip, VariableId sign, VariableId position);
  ExpressionId regime_of(const std::vector<VariableId>& slides);
  VariableId write_regime(const char* what, const std::vector<VariableId>& slides);
  bool compensates() const;
  void write_damping(VariableId regime);
  void write_compensation(VariableId regime);
  ExpressionId nearer(VariableId from, ExpressionId goal);
  template <class ValueOf>
  ExpressionId by_regime(VariableId regime, const char* name, const std::string& unit, const char* meaning,
                         ValueOf value_of);
  VariableId local(const std::string& what, const std::string& unit, const std::string& meaning);

  LawWriter& writer_;
  const ComponentSplit& split_;
  const SlipDecomposition& settings_;
  std::string prefix_;
  std::vector<Memory> memories_;
  VariableId regime_ = nothing, damping_ = nothing, shortfall_ = nothing, root_ = nothing, root_now_ = nothing;
  VariableId regime_before_ = nothing, samples_ = nothing, earned_way_ = nothing, earned_ = nothing;  // states
  VariableId commanded_ = nothing, samples_now_ = nothing, earned_way_now_ = nothing, earned_now_ = nothing,
             compensation_ = nothing;
};

}  // namespace dashpot::compiler
