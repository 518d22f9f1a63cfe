// The brake's command, and the force that is left to the motor: sums over all parts with slips.
#pragma once

#include "discretise/contact_surface.hpp"
#include "discretise/slip_parts.hpp"

namespace dashpot::compiler {

class LawBrake {
 public:
  // All must outlive this object. `linear_damping`: b of the part that reaches ground without a slip [N·s/m].
  LawBrake(LawWriter& writer, const SlipDecomposition& settings, const SlipParts& parts, double linear_damping,
           const Real& sample_period)
      : writer_(writer),
        settings_(settings),
        parts_(parts),
        linear_damping_(linear_damping),
        sample_period_(sample_period) {}

  // f′ = f − Σ x Δu/h, where x is the damping that the brake makes of a part now
  ExpressionId without_feedthrough(ExpressionId force, VariableId position, VariableId change);
  // m = f′ − β v̂, plus the damping force that a lagging coil does not make yet
  ExpressionId left_to_motor(ExpressionId force);
  // Writes b for a tool that is always in touch.
  void write_command();
  BrakeBehindSlips behind_contact() const;
  // `released`: with a contact, above 0 where the tool is free; else no variable.
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
