#include "discretise/law_brake.hpp"

namespace dashpot::compiler {

ExpressionId LawBrake::without_feedthrough(ExpressionId force, VariableId position, VariableId change) {
  for (const SlipParts::Braked& part : parts_.braked()) part.brake->write_output(part.signs, position);
  for (const SlipParts::Braked& part : parts_.braked())
    force = part.brake->without_feedthrough(force, change, sample_period_);
  return force;
}

ExpressionId LawBrake::left_to_motor(ExpressionId force) {
  for (const auto& group : parts_.groups()) force = compensated(force, group->compensation());
  for (const SlipParts::Braked& part : parts_.braked()) force = compensated(force, part.brake->compensation());
  return made_up(force);
}

ExpressionId LawBrake::compensated(ExpressionId sum, ExpressionId compensation) {
  if (compensation == nothing) return sum;
  return writer_.subtract(sum, writer_.multiply(compensation, writer_.read(writer_.law().velocity)));
}

// While the coil is on its way the motor makes up (b_regime − b) v̂, within what a brake that is always there covers.
ExpressionId LawBrake::made_up(ExpressionId sum) {
  ExpressionId shortfall = nothing;
  for (const auto& group : parts_.groups()) shortfall = writer_.plus(shortfall, group->shortfall());
  for (const SlipParts::Braked& part : parts_.braked()) shortfall = writer_.plus(shortfall, part.brake->shortfall());
  if (shortfall == nothing) return sum;
  const ExpressionId most =
      writer_.constant("steady_make_up", writer_.damping(), "what the motor makes up at most", settings_.make_up);
  return writer_.plus(sum, writer_.multiply(writer_.clamp(shortfall, most), writer_.read(writer_.law().velocity)));
}

// b = b of what reaches ground without a slip + Σ b of every component's regime
void LawBrake::write_command() {
  UpdateLaw& law = writer_.law();
  Real steady = linear_damping_, least = linear_damping_, largest = linear_damping_, at_rest = linear_damping_;
  ExpressionId changing = nothing;
  for (const auto& group : parts_.groups()) {
    changing = writer_.plus(changing, group->changing_damping());
    steady += group->brake().steady_damping();
    least += group->brake().least_damping();
    largest += group->brake().largest_damping();
    at_rest += group->brake().damping_at_rest();
  }
  for (const SlipParts::Braked& part : parts_.braked()) {
    changing = writer_.plus(changing, part.brake->changing_damping());
    steady += part.brake->steady_damping();
    least += part.brake->least_damping();
    largest += part.brake->largest_damping();
    at_rest += part.brake->damping_at_rest();
  }
  law.damping = rounded(least, law.scalar);
  law.largest_damping = rounded(largest, law.scalar);
  if (changing == nothing) return;
  if (steady > 0)
    changing = writer_.plus(changing, writer_.constant("steady_damping", writer_.damping(), "of what no slip changes",
                                                       steady, ConstantRole::steady_damping));
  law.brake = writer_.scalar("damping", writer_.damping(), "b, the brake's part", Role::local);
  writer_.assign(law.output, law.brake, changing, "b of the regime");
  law.last_brake = writer_.scalar("last_damping", writer_.damping(), "b of the sample before", Role::state);
  law.variables[law.last_brake].rest_value = rounded(at_rest, law.scalar);
  writer_.assign(law.keep, law.last_brake, writer_.read(law.brake), "");
}

BrakeBehindSlips LawBrake::behind_contact() const {
  BrakeBehindSlips all;
  for (const SlipParts::Braked& part : parts_.braked()) {
    all.changing = writer_.plus(all.changing, part.brake->changing_damping());
    all.compensation = writer_.plus(all.compensation, part.brake->compensation());
    all.steady += part.brake->steady_damping();
    all.largest += part.brake->largest_damping();
  }
  return all;
}

void LawBrake::write_update(VariableId released) {
  for (const SlipParts::Braked& part : parts_.braked()) part.brake->write_update(released);
}

}  // namespace dashpot::compiler
