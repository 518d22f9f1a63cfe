// What slips ask of the brake as they hold and give way, and what the motor takes back of it (theory, section 5,
// "Regimes"). One rule for all: a place is one slip of a group of alike, or all the slips that are solved together.
//
//   Which slips give way is a regime, for the command with a hysteresis over the encoder.
//   b = b_least + (b_most − b_least) w². Without a coil that lags w is that of the regime at once. Of a law that
//   compensates nothing it follows as the coil can, w ← w + κ (w_regime − w), and the motor may make up the rest.
//   Of the ramped law it goes by small steps, w ← w + clamp(κ (w_regime − w), ±ρ), κ = 1 of a coil without a lag.
//   What the coil has reached for certain, q, is behind: q ← min(q, w), then q ← q + κ (w − q), of any coil that makes
//   up a share κ of √b in a sample or more. With an estimate that reaches N + n samples back the motor takes back
//       β = β_most ((q − (N + n) ρ)⁺)²,
//   for q rises by no more than ρ a sample, so that in none of the samples that the estimate knows of it was less than
//   q − (N + n) ρ. Over several places excesses add up, and √b of the sum is reached as that of each (Minkowski).
#pragma once

#include <string>
#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/slide_memory.hpp"

namespace dashpot::compiler {

class SlipBrake {
 public:
  // `settings`: hysteresis, memory, ramp and coil. Outlives this.
  SlipBrake(LawWriter& writer, const SlipDecomposition& settings) : writer_(writer), settings_(settings) {}

  // `split`: nothing for the brake where it is none. Outlives this.
  void add(const ComponentSplit* split);
  // Places of one shape share their code: the same of their shares change.
  struct Shape {
    bool changes = false, is_ramped = false, begins_with_least = false;

    bool operator==(const Shape&) const = default;
  };
  static Shape shape(const ComponentSplit* split);

  bool takes_part() const;
  bool changes() const;  // b or x with the regime, so that it must know which slips give way
  const std::vector<SlipElements>& slips() const;

  // One name a place, or where there is one place a name for each of its slips.
  void declare(const std::string& prefix, const Names& places, const Names& slips);
  // `slides`: above zero where a slip gives way, one a slip; `position`: of the tool.
  void write_output(const std::vector<ExpressionId>& slides, VariableId position);
  // f′ from f, of a single place: what is taken is x Δu/h.
  ExpressionId without_feedthrough(ExpressionId force, VariableId change, const Real& sample_period);
  // `released`: of a contact, above 0 while the tool is free, which resets the ramp; else no variable.
  void write_update(VariableId released);

  VariableId changing_damping() const { return damping_; }   // `nothing` where it does not change
  VariableId compensation() const { return compensation_; }  // β of a ramp, `nothing` for none
  VariableId shortfall() const { return shortfall_; }        // of b where the coil is on its way, `nothing` for none
  Real steady_compensation() const;                          // β of places where nothing switches [N·s/m]
  Real steady_damping() const;                               // of the places where it does not change [N·s/m]
  Real least_damping() const;                                // of all
  Real largest_damping() const;
  Real damping_at_rest() const;

 private:
  bool coil_lags() const { return settings_.coil_share < 1; }
  bool damping_changes() const;
  bool is_ramped() const;
  bool has_way() const { return is_ramped() || coil_lags(); }
  VariableId write_regime(const char* what, const std::vector<ExpressionId>& slides);
  void write_damping();
  void write_way();
  void write_compensation();
  Subject of_regime(std::optional<std::size_t> regime) const;
  template <class ValueOf>
  ExpressionId by_regime(const char* name, const std::string& unit, const char* meaning, ValueOf value_of,
                         ConstantRole role = ConstantRole::brake_choice);
  template <class ValueOf>
  ExpressionId per_place(const char* name, const std::string& unit, const char* meaning, ValueOf value_of,
                         Derivation from = ConstantRole::brake_choice);
  ExpressionId one() { return slid(writer_); }
  ExpressionId none() { return held(writer_); }
  VariableId variable(const std::string& what, const std::string& unit, const std::string& meaning, Role role);

  LawWriter& writer_;
  const SlipDecomposition& settings_;
  std::vector<const ComponentSplit*> splits_;  // one a place
  std::string prefix_;
  Names places_;
  std::vector<SlideMemory> memories_;             // one a slip of a place
  VariableId way_ = nothing, reached_ = nothing;  // states
  VariableId damping_ = nothing, way_now_ = nothing, reached_now_ = nothing, compensation_ = nothing,
             shortfall_ = nothing;                             // locals
  ExpressionId regime_ = nothing, regime_of_force_ = nothing;  // the place of a table, or a condition of one slip
};

}  // namespace dashpot::compiler
