// The brake's command, and what it leaves to the motor: the sums over all parts with slips.
#pragma once

#include "discretise/contact_surface.hpp"
#include "discretise/slip_parts.hpp"

namespace dashpot::compiler {

class LawBrake {
 public:
  // All outlive this. `linear_damping`: b of what reaches ground without a slip [N·s/m].
  LawBrake(LawWriter& writer, const SlipDecomposition& settings, const SlipParts& parts, double linear_damping,
           const Real& sample_period)
      : writer_(writer),
        settings_(settings),
        parts_(parts),
        linear_damping_(linear_damping),
        sample_period_(sample_period) {}

  // f′ = f − Σ x Δu/h, x of every part's regime
  ExpressionId without_feedthrough(ExpressionId force, VariableId position, VariableId change);
  // m = f′ − β v̂, and what a coil on its way lacks
  ExpressionId left_to_motor(ExpressionId force);
  // b of a tool that is always in touch.
  void write_command();
  BrakeBehindSlips behind_contact() const;
  // `released`: of a contact, above 0 where the tool is free; else no variable.
  void write_update(VariableId released);

 private:
  template <class ValueOf>
  Real sum(ValueOf value_of) const;
  ExpressionId compensated(ExpressionId sum, ExpressionId compensation);
  ExpressionId made_up(ExpressionId sum);

  LawWriter& writer_;
  const SlipDecomposition& settings_;
  const SlipParts& parts_;
  double linear_damping_;
  Real sample_period_;
};

}  // namespace dashpot::compiler
