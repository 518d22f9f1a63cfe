#include "discretise/law_brake.hpp"

namespace dashpot::compiler {

namespace {

ExpressionId reading(LawWriter& writer, VariableId variable) {
  return variable == nothing ? nothing : writer.read(variable);
}

}  // namespace

template <class ValueOf>
Real LawBrake::sum(ValueOf value_of) const {
  Real total = 0;
  for (const auto& group : parts_.groups()) total += value_of(group->brake());
  for (const SlipParts::Braked& part : parts_.braked()) total += value_of(*part.brake);
  return total;
}

ExpressionId LawBrake::without_feedthrough(ExpressionId force, VariableId position, VariableId change) {
  for (const SlipParts::Braked& part : parts_.braked()) {
    std::vector<ExpressionId> slides;
    for (const VariableId sign : part.signs) slides.push_back(writer_.multiply(writer_.read(sign), writer_.read(sign)));
    part.brake->write_output(slides, position);
  }
  for (const SlipParts::Braked& part : parts_.braked())
    force = part.brake->without_feedthrough(force, change, sample_period_);
  return force;
}

ExpressionId LawBrake::left_to_motor(ExpressionId force) {
  for (const auto& group : parts_.groups()) force = compensated(force, group->compensation());
  for (const SlipParts::Braked& part : parts_.braked())
    force = compensated(force, reading(writer_, part.brake->compensation()));
  const Real steady = sum([](const SlipBrake& brake) { return brake.steady_compensation(); });
  if (rounded(steady, writer_.law().scalar) > 0)
    force = compensated(force, writer_.constant("slips_compensation", writer_.damping(),
                                                "β, damping of the brake that the motor takes back", steady));
  return made_up(force);
}

ExpressionId LawBrake::compensated(ExpressionId sum, ExpressionId compensation) {
  if (compensation == nothing) return sum;
  return writer_.subtract(sum, writer_.multiply(compensation, writer_.read(writer_.law().velocity)));
}

// While the coil lags behind its command the motor adds (b_regime − b) v̂, but no more than settings_.make_up allows.
ExpressionId LawBrake::made_up(ExpressionId sum) {
  ExpressionId shortfall = nothing;
  for (const auto& group : parts_.groups()) shortfall = writer_.plus(shortfall, group->shortfall());
  for (const SlipParts::Braked& part : parts_.braked())
    shortfall = writer_.plus(shortfall, reading(writer_, part.brake->shortfall()));
  if (shortfall == nothing) return sum;
  const ExpressionId most =
      writer_.constant("steady_make_up", writer_.damping(), "largest damping that the motor adds while the coil lags",
                       settings_.make_up);
  return writer_.plus(sum, writer_.multiply(writer_.clamp(shortfall, most), writer_.read(writer_.law().velocity)));
}

// b = b of what reaches ground without a slip + Σ b of every component's regime
void LawBrake::write_command() {
  UpdateLaw& law = writer_.law();
  const auto with_linear = [this](const Real& behind_slips) { return Real(linear_damping_) + behind_slips; };
  ExpressionId changing = nothing;
  for (const auto& group : parts_.groups()) changing = writer_.plus(changing, group->changing_damping());
  for (const SlipParts::Braked& part : parts_.braked())
    changing = writer_.plus(changing, reading(writer_, part.brake->changing_damping()));
  law.damping = rounded(with_linear(sum([](const SlipBrake& b) { return b.least_damping(); })), law.scalar);
  law.largest_damping = rounded(with_linear(sum([](const SlipBrake& b) { return b.largest_damping(); })), law.scalar);
  if (changing == nothing) return;
  const Real steady = with_linear(sum([](const SlipBrake& b) { return b.steady_damping(); }));
  if (steady > 0)
    changing = writer_.plus(
        changing, writer_.constant("steady_damping", writer_.damping(), "b of the parts that no slip changes", steady,
                                   ConstantRole::steady_damping));
  law.brake = writer_.scalar("damping", writer_.damping(), "b, the brake's part", Role::local);
  writer_.assign(law.output, law.brake, changing, "b of the regime");
  law.last_brake = writer_.scalar("last_damping", writer_.damping(), "b of the sample before", Role::state);
  law.variables[law.last_brake].rest_value =
      rounded(with_linear(sum([](const SlipBrake& b) { return b.damping_at_rest(); })), law.scalar);
  writer_.assign(law.keep, law.last_brake, writer_.read(law.brake), "");
}

BrakeBehindSlips LawBrake::behind_contact() const {
  BrakeBehindSlips all;
  for (const SlipParts::Braked& part : parts_.braked()) {
    all.changing = writer_.plus(all.changing, reading(writer_, part.brake->changing_damping()));
    all.compensation = writer_.plus(all.compensation, reading(writer_, part.brake->compensation()));
    all.steady += part.brake->steady_damping();
    all.largest += part.brake->largest_damping();
  }
  return all;
}

void LawBrake::write_update(VariableId released) {
  for (const SlipParts::Braked& part : parts_.braked()) part.brake->write_update(released);
}

}  // namespace dashpot::compiler
