#include "certify/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/estimator_names.hpp>
#include <limits>

#include "certify/adaptive_window.hpp"
#include "certify/box_motor.hpp"
#include "certify/hold_bound.hpp"
#include "certify/proved_bound.hpp"
#include "certify/unproved.hpp"
#include "certify/quantisation.hpp"
#include "discretise/rounding.hpp"
#include "discretise/tunable_programs.hpp"
#include "law/add_damping.hpp"
#include "law/cost.hpp"
#include "law/representable.hpp"
#include "lower/drop_unread.hpp"

namespace dashpot::compiler {
namespace {

// Why the hold certificate does not cover the motor; empty where it does.
std::string hindrance_to_hold(const MotorConstants& motor, const SampledLoop& loop) {
  if (motor.estimate_drives_modes()) return "the velocity estimate drives the states";
  if (motor.follows_estimate()) return "the motor follows the velocity estimate";
  if (loop.amplifier_lag > 0) return "the amplifier lags";
  return "";
}

// T_max, and T_max/h
Rational longest_hold(const SampledLoop& loop) {
  return Rational(loop.sample_period) + Rational(loop.jitter) +
         (Rational(loop.write_latest) - Rational(loop.write_earliest));
}
Rational longest_hold_share(const SampledLoop& loop) { return longest_hold(loop) / Rational(loop.sample_period); }

// time_of_write()/T_max, not below it.
Rational late_share_counted(const SampledLoop& loop) {
  return Rational(time_of_write(loop) / loop.longest_hold()) * (1 + Rational(1e-15));
}

PassivityBound within_range(PassivityBound bound) {
  return std::isfinite(bound.needed) ? bound : not_proved("the damping that it needs is beyond what a double can hold");
}

// The bounds of two parts of a motor add up. The law counts in samples, and so does the estimate, which divides by the
// nominal period: the work m Δu of a hold does not depend on how long the hold lasts, and a damper takes b Δu²/T_max or
// more. So without lag the bound is that of the longest hold: T_max/h times that of a punctual loop.
PassivityBound sampled_statement(const MotorConstants& motor, const SampledLoop& loop,
                                 const EstimatorFactors& estimator, double besides, std::size_t terms) {
  const SampledBound found = sampled_bound(NeededDamping(motor, loop, estimator), loop.sample_period, terms);
  PassivityBound bound;
  bound.proof = Proof::sampled;
  bound.needed = besides > 0 ? std::nextafter(found.needed + besides, HUGE_VAL) : found.needed;
  bound.frequency = found.frequency;
  bound.reason = hindrance_to_hold(motor, loop);
  bound.constant_period_only = loop.amplifier_lag > 0;
  if (!std::isfinite(bound.needed)) return within_range(bound);
  if (bound.needed > 0 && !loop.is_punctual() && !bound.constant_period_only)
    bound.needed = ceiling(Rational(bound.needed) * longest_hold_share(loop));
  return within_range(bound);
}

// β (1 + 2n) T_max: late by n samples the force is off by no more than 2 n β ‖Δu‖, for |1 − wⁿ| |H| ≤ 2 n β. With a
// command that acts later still, time_of_write() more.
PassivityBound hold_statement(const MotorConstants& motor, const SampledLoop& loop) {
  PassivityBound bound;
  bound.proof = Proof::hold;
  bound.needed = ceiling(hold_stiffness(motor) * (1 + 2 * Rational(loop.delay_samples) + late_share_counted(loop)) *
                         longest_hold(loop));
  return within_range(bound);
}

// A motor that slews fast enough costs damping as an amplifier's lag does; if it is too slow, nothing is proved.
PassivityBound with_slew(PassivityBound bound, const MotorConstants& motor, const SampledLoop& loop) {
  if (loop.motor_slew == 0 || bound.proof == Proof::none || motor.is_idle()) return bound;
  if (loop.amplifier_lag > 0) return not_proved("the amplifier lags, and its slew is limited");
  const std::optional<double> used = slew_needed(motor, loop);
  if (!used)
    return not_proved(motor.follows_estimate()
                          ? "how fast the motor's force has to change is not bounded, because it follows the velocity "
                            "estimate"
                          : "how fast the motor's force has to change is not bounded, because the encoder's range or "
                            "largest speed is not stated");
  if (*used > loop.motor_slew)
    return not_proved(fmt::format("the motor's force may have to change {:.6g} times as fast as its slew lets it",
                                  *used / loop.motor_slew));
  const std::optional<double> besides = damping_for_slew(motor, *used, loop);
  if (!besides) return not_proved(not_proved_for(loop));
  bound.needed = (bound.needed + *besides) * (1 + 1e-15);
  return within_range(bound);
}

constexpr double hardly_less = 1 - 1e-8;  // not enough less to replace a bound that is checked in rational numbers

double nearest(double value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? value : static_cast<double>(static_cast<float>(value));
}

// The least number of the scalar's type that is not below the sum; infinite where none is.
double sum_above(double x, double y, ScalarType scalar) {
  if (!(x + y <= largest_finite(scalar))) return std::numeric_limits<double>::infinity();
  const Rational exact = Rational(x) + Rational(y);
  if (scalar == ScalarType::float64) return ceiling(exact);
  float nearest = static_cast<float>(x + y);
  while (Rational(nearest) < exact) nearest = std::nextafter(nearest, std::numeric_limits<float>::infinity());
  return static_cast<double>(nearest);
}

// The bound for a motor that makes its command at once.
PassivityBound prompt_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop, std::size_t terms) {
  PassivityBound bound;
  if (!motor) {
    bound.reason = "the law is not one linear law";
    return bound;
  }
  if (hindrance_to_hold(*motor, loop).empty()) {
    const PassivityBound held = hold_statement(*motor, loop);
    if (!loop.is_late()) return held;
    PassivityBound sampled = sampled_statement(*motor, loop, {}, 0, terms);
    sampled.reason = "over all frequencies less is needed than sample by sample";
    const bool asks_less =
        sampled.proof != Proof::none && (held.proof == Proof::none || sampled.needed < held.needed * hardly_less);
    return asks_less ? sampled : held;
  }
  if (!motor->follows_estimate()) return sampled_statement(*motor, loop, {}, 0, terms);
  const bool varies = divides_by_varying_interval(loop) && loop.amplifier_lag == 0;
  if (const auto linear = varies ? std::nullopt : estimator_factors(loop))
    return sampled_statement(*motor, loop, *linear, 0, terms);
  const std::optional<double> besides = damping_for_estimate(*motor, loop);
  bound.reason = not_proved_for(loop);
  if (besides) bound = sampled_statement(position_driven(*motor), loop, {}, *besides, terms);
  if (besides && bound.proof != Proof::none) bound.reason = hindrance_to_hold(*motor, loop);
  return bound;
}

}  // namespace

PassivityBound passivity_bound(const std::optional<MotorConstants>& motor, const SampledLoop& loop, std::size_t terms) {
  if (loop.may_overtake()) return not_proved(overtaken);
  const PassivityBound bound = prompt_bound(motor, loop, terms);
  return motor ? with_slew(bound, *motor, loop) : bound;
}

PassivityBound bound_beside_slips(const MotorConstants& linear, const SlipMotor& slips, const SampledLoop& loop,
                                  std::size_t terms) {
  PassivityBound nothing;
  nothing.proof = Proof::hold;
  const MotorConstants beside = motor_beside(slips, linear);
  return beside.is_idle() ? nothing : passivity_bound(beside, loop, terms);
}

// The needed dampings add up, and of the two kinds of proof the weaker one is stated.
PassivityBound with_slips(PassivityBound bound, const SlipMotor& slips, const SampledLoop& loop) {
  bound.any_regime = true;
  bound.storage.reset();
  if (bound.proof == Proof::none) return bound;
  if (loop.may_overtake()) return not_proved(overtaken);
  if (loop.motor_slew > 0)
    return not_proved(
        "the motor's slew is limited, and its force jumps where a slip gives way or a contact begins or ends");
  if (const std::string why = contact_uncovered_when_late(slips, loop); !why.empty()) return not_proved(why);
  if (loop.amplifier_lag > 0) {
    bound.proof = Proof::sampled;
    bound.reason = "the amplifier lags";
    bound.constant_period_only = bound.constant_period_only || loop.is_punctual();
    if (loop.jitter >= loop.sample_period) return not_proved(at_once);
  }
  const double hold = loop.longest_hold() / loop.sample_period;
  const double compensation = slips.compensation * hold;
  const std::optional<double> gain = compensation > 0 ? estimate_gain(loop) : 0;
  if (!gain) return not_proved(not_proved_for(loop));
  const double share = stiffness_share(slips, loop),
               needed = slips.stiffness * share * loop.sample_period + slips.damping;
  bound.needed += (needed * hold + compensation * *gain) * (1 + 1e-14);
  bound = within_range(bound);
  if (bound.proof == Proof::none) return bound;
  return slips.behind_contact ? of_a_free_tool(bound, loop) : bound;
}

double missing_damping(const PassivityBound& bound, const SampledLoop& loop, double brake) {
  const Rational lacking = Rational(bound.needed) - assured_damping(loop, brake);
  if (lacking <= 0) return 0;
  const Rational share = assured_share(loop);
  return share > 0 ? ceiling(lacking / share) : std::numeric_limits<double>::infinity();
}

std::string_view grade_of(const Certificate& c) {
  if (!c.certified) return "not certified";
  return c.bound.constant_period_only ? "certified for a constant period only" : "certified";
}

std::string_view name_of(Proof proof) {
  switch (proof) {
    case Proof::none: return "none";
    case Proof::hold: return "hold";
    case Proof::sampled: return "sampled";
  }
  return "";
}

void compare_with_bound(Certificate& certificate, const Rational& assured) {
  certificate.assured = assured.convert_to<double>();
  certificate.certified = certificate.bound.proof != Proof::none && assured >= Rational(certificate.bound.needed);
}

double brake_command(const PassivityBound& bound, const SampledLoop& loop, double damping, ScalarType scalar) {
  const double alone = nearest(damping, scalar);
  if (!loop.has_device || bound.proof == Proof::none) return alone;
  const double missing = missing_damping(bound, loop, alone);
  if (missing == 0 || !std::isfinite(missing)) return alone;
  const double together = sum_above(alone, missing, scalar);
  return together <= loop.max_damping ? together : alone;
}

double unpaid_force(const Certificate& certificate) {
  const double most = certificate.quantisation_gain.value_or(0) * certificate.loop.encoder_step / 2;
  return std::max(most - certificate.loop.coulomb_friction, 0.0);
}

namespace {

// Each operation of a step rounds by one unit of its result at most; no result is larger than the sum of the terms'
// sizes.
double rounding_of_step(const UpdateLaw& law, std::initializer_list<const std::vector<Statement>*> programs) {
  std::size_t operations = 0;
  for (const std::vector<Statement>* program : programs) {
    const Cost cost = cost_of(law, *program);
    operations += cost.additions + cost.multiplications + cost.coupled;
  }
  return law.relative_error_bound + unit_roundoff(law.scalar) * double(operations);
}

// The damping lacking for the worst parameters, stated as what is needed while the brake has its least command.
PassivityBound box_bound(const BoxMotor& box, const SampledLoop& loop) {
  if (!box.hindrance.empty()) return not_proved(box.hindrance);
  if (loop.may_overtake()) return not_proved(overtaken);
  if (loop.motor_slew > 0) return not_proved("the motor's slew is limited, and parameters change");
  if (loop.amplifier_lag > 0 && loop.jitter >= loop.sample_period) return not_proved(at_once);
  PassivityBound bound;
  bound.needed = box.lacking + box.largest_brake;
  if (!std::isfinite(bound.needed)) return within_range(bound);
  bound.proof = loop.amplifier_lag > 0 ? Proof::sampled : Proof::hold;
  if (loop.amplifier_lag > 0) bound.reason = "the amplifier lags";
  bound.constant_period_only = loop.amplifier_lag > 0 && loop.is_punctual();
  bound.needed = std::max(0.0, ceiling(assured_share(loop) * Rational(box.least_brake) + Rational(box.lacking)));
  bound.any_value = true;
  return bound;
}

// The bound part by part. Behind an amplifier's lag, the bound of all parts together, sample by sample, is taken if it
// asks for no more, since it holds at the motor's limit too.
PassivityBound bound_with_slips(const PassivityBound& beside, const MotorConstants& linear, const SlipMotor& slips,
                                const SampledLoop& loop) {
  PassivityBound bound = with_slips(beside, slips, loop);
  if (bound.proof == Proof::none || !needs_jitter_gap(loop)) return bound;
  const std::optional<double> together = needed_sample_by_sample(linear, slips, loop);
  // Behind a contact the brake is off while the tool is free, and a touch is noticed late.
  const bool is_enough = !slips.behind_contact || (together && Rational(*together) <= assured_damping(loop, 0));
  if (!together || !is_enough || bound.needed < *together * hardly_less) return bound;
  bound.proof = Proof::hold;
  bound.needed = *together;
  bound.frequency = 0;
  return bound;
}

PassivityBound bound_of(const UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips) {
  if (!slips)
    return stated_bound(motor_constants(law), loop,
                        assured_damping(loop, brake_command({}, loop, law.damping, law.scalar)));
  const MotorConstants linear = linear_motor_constants(law);
  const PassivityBound beside = bound_beside_slips(linear, *slips, loop);
  return bound_with_slips(under_jitter(beside, linear, loop, std::nullopt), linear, *slips, loop);
}

BoxMotor box_of(const UpdateLaw& law, const SampledLoop& loop) {
  return box_motor(law, {longest_hold_share(loop), lateness(loop), estimate_gain(loop), assured_share(loop),
                         estimate_pulse(loop), loop.encoder_step, loop.out_of_step});
}

// Lower bound of the command: one that changes is a sum, whose rounding is allowed for.
double surely_told(const UpdateLaw& law) {
  return law.brake_changes() ? law.damping * (1 - 8 * unit_roundoff(law.scalar)) : law.damping;
}

// Out: what has been added to the brake's command in every regime. Behind a contact nothing would help: the brake is
// off while the tool is free.
double add_missing(UpdateLaw& law, const PassivityBound& bound, const SampledLoop& loop, bool behind_contact) {
  if (behind_contact) return 0;
  if (!law.brake_changes()) {
    const double alone = law.damping;
    law.damping = law.largest_damping = brake_command(bound, loop, alone, law.scalar);
    return nearest(law.damping - alone, law.scalar);
  }
  const double missing = missing_damping(bound, loop, surely_told(law));
  if (!loop.has_device || missing == 0 || !std::isfinite(missing)) return 0;
  const double added = sum_above(missing, 32 * unit_roundoff(law.scalar) * (law.largest_damping + missing), law.scalar);
  if (sum_above(law.largest_damping, added, law.scalar) > loop.max_damping) return 0;
  law = with_steady_damping(std::move(law), added);
  return added;
}

// The certificate: the bound, what is added for it, and whether that is enough. `known`: the bound, if it is known.
Certificate decided(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips,
                    const std::optional<PassivityBound>& known) {
  Certificate result;
  result.loop = loop;
  result.bound = known ? *known : bound_of(law, loop, slips);
  if (result.bound.proof != Proof::none) {
    result.minimum_damping = missing_damping(result.bound, loop, surely_told(law));
    result.added_damping = add_missing(law, result.bound, loop, slips && slips->behind_contact);
  }
  compare_with_bound(result, assured_damping(loop, surely_told(law)));
  result.bound.any_regime = slips.has_value();
  return result;
}

// The same for a law with tunables. What is added leaves b less of the brake's range, so that the motor makes more and
// more must be added: a few rounds find the balance, or there is none.
Certificate decided_over_box(UpdateLaw& law, const SampledLoop& loop, bool has_slips) {
  Certificate result;
  result.loop = loop;
  TunableBrake& brake = law.tunable->brake;
  const double reach = brake.max_damping;
  BoxMotor box = box_of(law, loop);
  result.bound = box_bound(box, loop);
  const auto missing = [&] {
    return missing_damping(result.bound, loop, box.least_brake * (1 - 8 * unit_roundoff(law.scalar)));
  };
  const bool is_proved = result.bound.proof != Proof::none;
  double added = 0;
  for (int round = 0; is_proved && loop.has_device && missing() > added; ++round) {
    added = sum_above(missing(), 32 * unit_roundoff(law.scalar) * (box.largest_brake + missing()), law.scalar);
    const bool is_beyond = round == 20 || !(added < loop.max_damping);
    if (is_beyond) added = 0;
    brake.max_damping =
        is_beyond ? reach
                  : std::min(reach, nearest((loop.max_damping - added) * (1 - unit_roundoff(law.scalar)), law.scalar));
    box = box_of(law, loop);
    result.bound = box_bound(box, loop);
    if (is_beyond) break;
  }
  if (is_proved) result.minimum_damping = missing();
  result.added_damping = brake.added = added;
  if (added > 0) law = without_unread_locals(with_programs(std::move(law)));
  result.quantisation_gain = box.quantisation_gain;
  law.damping = box.least_brake + added;
  law.largest_damping = box.largest_brake + added;
  compare_with_bound(result, assured_damping(loop, surely_told(law)));
  result.bound.any_regime = has_slips;
  return result;
}

// Fills in the rest of the certificate: energy between samples, the encoder's steps and the motor's limits.
void look_beyond_bound(Certificate& result, const UpdateLaw& law, const std::optional<SlipMotor>& slips) {
  const SampledLoop& loop = result.loop;
  const std::optional<MotorConstants> motor = motor_constants(law);
  const MotorConstants linear = motor ? *motor : linear_motor_constants(law);
  if (slips) result.energy = check_energy_lemma_with_slips(linear, parts_behind_slips(law));
  else if (motor) result.energy = check_energy_lemma(linear);
  if (motor) result.quantisation_gain = quantisation_gain(linear, loop);
  else if (slips) result.quantisation_gain = quantisation_gain(linear, *slips, loop);
  if (!motor) result.energy.rounding_share = rounding_of_step(law, {&law.output});
  result.limits = motor_limits(law, slips, loop, result.bound.needed, assured_damping(loop, surely_told(law)));
}

void look_beyond_box(Certificate& result, const UpdateLaw& law) {
  const SampledLoop& loop = result.loop;
  result.energy = check_energy_lemma_over_box(law);
  // The error bound covers the updates of modes, but not those of springs whose parameters change.
  result.energy.rounding_share = rounding_of_step(law, {&law.output, &law.update});
  const bool is_proved = result.bound.proof != Proof::none;
  result.limits = motor_limits_over_box(loop, is_proved ? std::optional(result.bound.needed) : std::nullopt,
                                        assured_damping(loop, surely_told(law)));
}

Certificate decided_as_it_is(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips) {
  return law.tunable ? decided_over_box(law, loop, slips.has_value()) : decided(law, loop, slips, std::nullopt);
}

}  // namespace

Certificate beyond_numbers(const SampledLoop& loop) {
  Certificate result;
  result.loop = loop;
  result.bound = not_proved("a number of it is beyond what its scalar can hold");
  return result;
}

Certificate certify(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips) {
  if (!has_finite_numbers(law)) return beyond_numbers(loop);
  Certificate result = decided_as_it_is(law, loop, slips);
  law.tunable ? look_beyond_box(result, law) : look_beyond_bound(result, law, slips);
  if (loop.encoder_step > 0) result.quantisation_stiffness = 2 * loop.coulomb_friction / loop.encoder_step;
  return result;
}

Certificate certify_in_search(UpdateLaw& law, const SampledLoop& loop, const std::optional<SlipMotor>& slips) {
  return has_finite_numbers(law) ? decided_as_it_is(law, loop, slips) : beyond_numbers(loop);
}

Certificate weighed_by_gap(UpdateLaw& law, const SampledLoop& loop, const SlipMotor& slips, double gap) {
  if (!has_finite_numbers(law)) return beyond_numbers(loop);
  const MotorConstants linear = linear_motor_constants(law);
  const PassivityBound beside = bound_beside_slips_by_gap(linear, slips, loop, gap);
  return decided(law, loop, slips, bound_with_slips(beside, linear, slips, loop));
}

}  // namespace dashpot::compiler
