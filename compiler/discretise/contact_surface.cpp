#include "discretise/contact_surface.hpp"

namespace dashpot::compiler {

ContactSurface::ContactSurface(LawWriter& writer, double at, double encoder_step)
    : writer_(writer), at_(at), encoder_step_(encoder_step) {}

void ContactSurface::declare() {
  surface_ = writer_.scalar("surface", writer_.length(), "s, how far the surface is pushed in", Role::state);
  if (at_ != 0)
    depth_ = writer_.scalar("depth", writer_.length(), "how far the tool is beyond the unloaded surface", Role::local);
  approach_ =
      writer_.scalar("approach", writer_.length(), "Δ, the surface's change if it stuck to the tool", Role::local);
  change_ = writer_.scalar("surface_change", writer_.length(), "Δs since the sample before", Role::local);
  gap_ = writer_.scalar("gap", writer_.length(), "between tool and surface", Role::local);
  now_ = writer_.scalar("surface_now", writer_.length(), "s", Role::local);
  writer_.law().rest_position = surface_;
  writer_.law().surface_at = at_;
}

void ContactSurface::write_approach() {
  UpdateLaw& law = writer_.law();
  if (at_ == 0) depth_ = law.position;
  else writer_.assign(law.output, depth_, depth_now(), "");
  writer_.assign(law.output, approach_, writer_.subtract(writer_.read(depth_), writer_.read(surface_)), "Δ = u − s₋");
}

ExpressionId ContactSurface::depth_now() {
  const ExpressionId position = writer_.read(writer_.law().position);
  if (at_ == 0) return position;
  return writer_.subtract(position, writer_.constant("surface_at", writer_.length(), "where the unloaded surface lies",
                                                     Real(at_), ConstantRole::surface_place));
}

ExpressionId ContactSurface::none() {
  return writer_.constant("none", writer_.force(), "no force on a free tool", 0, ConstantRole::zero);
}

void ContactSurface::write_change(const Real& stiffness, VariableId held) {
  none();  // made first, so that the order of the constants is always the same
  write_change(writer_.constant("recovery_compliance", writer_.compliance(), "−1/g",
                                stiffness > 0 ? Real(-1 / stiffness) : Real(0), ConstantRole::recovery_compliance),
               held);
}

// With π the held force: f(Δ) = g Δ + π ≥ 0 where Δ ≥ −π/g
void ContactSurface::write_change(ExpressionId recovery_compliance, VariableId held) {
  std::vector<Statement>& output = writer_.law().output;
  const VariableId recovery =
      writer_.scalar("surface_recovery", writer_.length(), "the surface's change if nothing touched it", Role::local);
  writer_.assign(output, recovery,
                 writer_.multiply(recovery_compliance, held == no_variable ? none() : writer_.read(held)),
                 "Δs where f = 0: −held force/g");
  const ExpressionId ahead = writer_.subtract(writer_.read(recovery), writer_.read(approach_));
  writer_.assign(output, change_, writer_.where(ahead, writer_.read(recovery), writer_.read(approach_)),
                 "Δs = Δ, but no lower than where f = 0");
}

void ContactSurface::write_surface() {
  std::vector<Statement>& output = writer_.law().output;
  writer_.assign(output, gap_, writer_.subtract(writer_.read(change_), writer_.read(approach_)), "gap = s − u");
  const ExpressionId moved = writer_.flush(writer_.add(writer_.read(surface_), writer_.read(change_)));
  writer_.assign(output, now_, writer_.where(writer_.read(gap_), moved, writer_.read(depth_)), "s = s₋ + Δs");
  write_start();
}

// reset() finds the surface where a tool at rest has pushed it.
void ContactSurface::write_start() {
  UpdateLaw& law = writer_.law();
  law.started_at =
      writer_.scalar("pushed_in", writer_.length(), "s, how far the tool has the surface pushed in", Role::local);
  const ExpressionId depth = depth_now();
  writer_.assign(law.start, law.started_at, writer_.where(depth, depth, none()), "s = (u − u0)⁺");
}

void ContactSurface::write_command(VariableId opposing, const Real& feedthrough_damping,
                                   const BrakeBehindSlips& slips) {
  UpdateLaw& law = writer_.law();
  const double damping = law.damping;
  const Real left_to_motor =
      rounded(feedthrough_damping, law.scalar) == damping ? Real(0) : Real(feedthrough_damping - damping);
  ExpressionId felt = writer_.read(opposing), motor = felt;
  if (feedthrough_damping > 0) {
    const ExpressionId feedthrough =
        writer_.constant("feedthrough", writer_.damping(), "b∞", feedthrough_damping, ConstantRole::feedthrough);
    felt = writer_.add(felt, writer_.multiply(feedthrough, writer_.read(law.velocity)));
  }
  if (left_to_motor != 0) {
    const ExpressionId gain =
        writer_.constant("velocity_gain", writer_.damping(), "b∞ − b", left_to_motor, ConstantRole::velocity_gain);
    motor = writer_.add(motor, writer_.multiply(gain, writer_.read(law.velocity)));
  }
  if (slips.steady > 0)
    felt = writer_.add(felt, writer_.multiply(writer_.constant("slips_feedthrough", writer_.damping(),
                                                               "b∞ of the parts with slips", slips.steady),
                                              writer_.read(law.velocity)));
  if (slips.changing != nothing) felt = writer_.add(felt, writer_.multiply(slips.changing, writer_.read(law.velocity)));
  if (slips.compensation != nothing) {
    const ExpressionId taken_back = writer_.multiply(slips.compensation, writer_.read(law.velocity));
    felt = writer_.subtract(felt, taken_back);
    motor = writer_.subtract(motor, taken_back);
  }
  const Real steady = Real(damping) + slips.steady;
  write_command(opposing, {felt, motor, slips.changing, steady});
  if (law.brake == no_variable) return;
  law.damping = 0;
  law.largest_damping = rounded(Real(damping) + slips.largest, law.scalar);
}

void ContactSurface::write_command(VariableId opposing, const CommandInTouch& touching) {
  UpdateLaw& law = writer_.law();
  released_ = writer_.scalar("released", "1", "above 0 where the tool is free", Role::local);
  const ExpressionId none = this->none(), release = release_of(opposing, touching.felt, none);
  writer_.assign(law.output, released_, release, "above 0 where the tool is free");
  ExpressionId brake = touching.changing_brake;
  if (touching.steady_brake > 0)
    brake = writer_.plus(brake, writer_.constant("contact_damping", writer_.damping(), "b while the tool touches",
                                                 touching.steady_brake));
  if (brake != nothing) {
    law.brake = writer_.scalar("brake", writer_.damping(), "b", Role::local);
    writer_.assign(law.output, law.brake, writer_.where(writer_.read(released_), none, brake), "b = 0 of a free tool");
    law.last_brake = writer_.kept(law.brake);
  }
  writer_.assign(law.output, law.force, writer_.where(writer_.read(released_), none, touching.motor),
                 "m = f − b u̇ of a tool that touches");
}

// The surface leaves the tool where f would fall below 0. The command ends later: where f′ + b∞ v̂ < 0, where the gap is
// more than an encoder step, or where there is a gap and nothing pushes any more.
ExpressionId ContactSurface::release_of(VariableId opposing, ExpressionId felt, ExpressionId none) {
  const VariableId pull =
      writer_.scalar("pull", writer_.force(), "how hard the command would pull at the tool", Role::local);
  writer_.assign(writer_.law().output, pull, writer_.subtract(none, felt), "−(f′ + b∞ v̂)");
  ExpressionId opened = writer_.read(gap_);
  if (encoder_step_ > 0) {
    const ExpressionId step = writer_.constant("encoder_step", writer_.length(),
                                               "largest gap at which the command goes on", Real(encoder_step_));
    const ExpressionId pushed = writer_.where(writer_.read(opposing), none, writer_.read(gap_));
    opened = writer_.where(writer_.subtract(writer_.read(gap_), step), writer_.read(gap_), pushed);
  }
  return writer_.where(writer_.read(pull), writer_.read(pull), opened);
}

}  // namespace dashpot::compiler
