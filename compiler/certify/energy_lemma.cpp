#include "certify/energy_lemma.hpp"

#include "certify/hold_bound.hpp"

namespace dashpot::compiler {
namespace {

// How large a mode needs the coefficient of Δu² to be with the weight w: w d² + (1 − 2wad)²/(4w(1 − a²)). Empty if no
// coefficient is large enough.
std::optional<Rational> demand(const Rational& a, const Rational& d, const Rational& w) {
  const Rational skew = 1 - 2 * w * a * d, damped = w * (1 - a * a);
  if (skew == 0) return w * d * d;
  if (damped <= 0) return std::nullopt;
  return w * d * d + skew * skew / (4 * damped);
}

}  // namespace

EnergyLemma check_energy_lemma(const MotorConstants& motor) {
  EnergyLemma lemma;
  lemma.applies = !motor.estimate_drives_modes();
  if (!lemma.applies) return lemma;
  const Rational static_excess = Rational(motor.static_stiffness) - 2 * Rational(motor.half_static_stiffness);
  Rational left = Rational(motor.half_static_stiffness) + Rational(motor.step_stiffness);
  boost::multiprecision::cpp_int asked =
      0;  // sum over all modes, in steps of a grid: fractions in lowest terms are slow
  for (const MotorMode& mode : motor.modes) {
    const Rational a = exact_decay(motor, mode), d = mode.position_drive;
    if (d == 0) continue;
    // c/2 is the least that any weight needs; if the emitted weight needs more than c, that is more than rounding.
    const std::optional<Rational> emitted = demand(a, d, mode.energy_weight);
    if (emitted && *emitted * a <= d) {
      asked += grid_steps_up(*emitted);
      continue;
    }
    ++lemma.reweighted_modes;
    asked += grid_steps_up(a == 0 ? d : Rational(d / (2 * a)));
  }
  left -= of_grid_steps(asked);
  lemma.storage = lemma.reweighted_modes == 0 ? EnergyStorage::emitted : EnergyStorage::weighted;
  lemma.holds = left >= 0 && static_excess == 0;
  if (left < 0) lemma.shortfall = ceiling(-left);
  lemma.rounding_share = motor.error_bound + motor.unit_roundoff * double(8 + motor.modes.size());
  return lemma;
}

EnergyLemma check_energy_lemma_with_slips(const MotorConstants& linear, const std::vector<MotorConstants>& parts) {
  EnergyLemma lemma;
  lemma.applies = !linear.estimate_drives_modes();
  lemma.with_slips = true;
  lemma.storage = EnergyStorage::weighted;
  lemma.holds = lemma.applies && linear.static_stiffness >= 0;
  const auto look_at = [&](const MotorConstants& part) {
    for (const MotorMode& mode : part.modes) {
      const Rational a = exact_decay(part, mode);
      lemma.holds = lemma.holds && a >= 0 && a <= 1 && mode.position_drive >= 0;
      ++lemma.reweighted_modes;
    }
  };
  look_at(linear);
  for (const MotorConstants& part : parts) look_at(part);
  return lemma;
}

}  // namespace dashpot::compiler
