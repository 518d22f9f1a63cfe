// The brake's damping b behind slips, which changes as they hold and give way, and the damping β that the motor takes
// back of it (theory, section 5, "Regimes"). A place is one slip of a group of alike slips, or all the slips that are
// solved together; the same rule holds for both.
//
//   The regime says which slips give way. The command sees it with a hysteresis of some encoder steps.
//   b = b_least + (b_most − b_least) way², where way is 0 in the regime with the least b and 1 in that with the most.
//   If the coil does not lag, the way is that of the regime at once. If it lags and the motor takes nothing back,
//   way ← way + κ (way_regime − way), where κ is the share of √b that the coil makes up in a sample; the motor may add
//   what is missing. In the ramped law way ← way + clamp(κ (way_regime − way), ±ρ), with κ = 1 if the coil does not
//   lag. The coil has surely reached: reached ← min(reached, way), then reached ← reached + κ (way − reached). If the
//   velocity estimate depends on N + n samples, the motor takes back
//       β = β_most ((reached − (N + n) ρ)⁺)².
//   In a sample `reached` rises by ρ at most. So in none of the samples in the estimate was it less than
//   reached − (N + n) ρ. Over several places the dampings add up, and so do their bounds (Minkowski's inequality).
#pragma once

#include <string>
#include <vector>

#include "decompose/slip_decomposition.hpp"
#include "discretise/law_writer.hpp"
#include "discretise/slide_memory.hpp"

namespace dashpot::compiler {

class SlipBrake {
 public:
  // `settings`: hysteresis, memory, ramp and coil; must outlive this object.
  SlipBrake(LawWriter& writer, const SlipDecomposition& settings) : writer_(writer), settings_(settings) {}

  // `split`: null if the part leaves nothing to the brake; must outlive this object.
  void add(const ComponentSplit* split);
  // Places of one shape share their code: in all of them the same quantities change.
  struct Shape {
    bool changes = false, is_ramped = false, begins_with_least = false;

    bool operator==(const Shape&) const = default;
  };
  static Shape shape(const ComponentSplit* split);

  bool takes_part() const;
  bool changes() const;  // whether b or x differs between regimes, so that it must know which slips give way
  const std::vector<SlipElements>& slips() const;

  // `slips`: one name for each place or, if there is only one place, for each of its slips.
  void declare(const std::string& prefix, const Names& places, const Names& slips);
  // `slides`: one for each slip, above zero where it gives way; `position`: that of the tool.
  void write_output(const std::vector<ExpressionId>& slides, VariableId position);
  // f′ = f − x Δu/h, for a single place.
  ExpressionId without_feedthrough(ExpressionId force, VariableId change, const Real& sample_period);
  // `released`: with a contact, above 0 while the tool is free, which resets the ramp; else no variable.
  void write_update(VariableId released);

  VariableId changing_damping() const { return damping_; }   // `nothing` if it does not change
  VariableId compensation() const { return compensation_; }  // β of a ramp, `nothing` if there is none
  VariableId shortfall() const { return shortfall_; }        // b that a lagging coil lacks, `nothing` if none
  Real steady_compensation() const;                          // β of places whose b does not change [N·s/m]
  Real steady_damping() const;                               // b of places where it does not change [N·s/m]
  Real least_damping() const;                                // sum over all places [N·s/m]
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
  std::vector<const ComponentSplit*> splits_;  // one for each place
  std::string prefix_;
  Names places_;
  std::vector<SlideMemory> memories_;             // one for each slip of a place
  VariableId way_ = nothing, reached_ = nothing;  // states
  VariableId damping_ = nothing, way_now_ = nothing, reached_now_ = nothing, compensation_ = nothing,
             shortfall_ = nothing;                             // locals
  ExpressionId regime_ = nothing, regime_of_force_ = nothing;  // an index into a table or, with one slip, a condition
};

}  // namespace dashpot::compiler
