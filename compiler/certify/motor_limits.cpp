#include "certify/motor_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "certify/estimator_factors.hpp"
#include "certify/hold_bound.hpp"
#include "certify/unproved.hpp"

namespace dashpot::compiler {
namespace {

// √3/36, the largest B₃(x) = x³ − 3/2 x² + ½ x over 0 … 1: counts a last step that is not a whole one.
constexpr double largest_bernoulli = 0.04811252243246881;

constexpr double margin = 1 + 1e-12;  // more than rounding changes these few sums by

// β and what the estimate adds to it, γ|g|/h [N/m].
struct Gains {
  double position = 0;
  double estimate = 0;
  double dampers = 0;  // across the cut, without those that the brake makes [N·s/m]
  std::string hindrance;
  bool follows_estimate = false;

  double all() const { return (position + estimate) * margin; }
};

double position_stiffness(MotorConstants motor) {
  motor.velocity_gain = 0;
  return hold_stiffness(motor).convert_to<double>() * margin;
}

void add_estimate(double damping, const SampledLoop& loop, Gains& gains) {
  if (damping == 0) return;
  gains.follows_estimate = true;
  const std::optional<double> gain = estimate_gain(loop);
  if (!gain) gains.hindrance = "nothing is known of the gain of its velocity estimator";
  else gains.estimate += damping * *gain / loop.sample_period;
}

Gains gains_of(const MotorConstants& linear, const std::optional<SlipMotor>& slips, const SampledLoop& loop) {
  Gains gains;
  gains.follows_estimate = linear.estimate_drives_modes();
  if (gains.follows_estimate) gains.hindrance = "the velocity estimate drives the states";
  if (gains.hindrance.empty()) {
    const MotorConstants beside = motor_beside(slips, linear);
    gains.position = position_stiffness(beside);
    add_estimate(std::abs(beside.velocity_gain), loop, gains);
  }
  if (!slips) return gains;
  gains.position += slips->stiffness;
  gains.dampers = slips->damping;
  const bool is_late = loop.is_late();
  // The brake's own excess covers what a ramp takes back, as long as both act on the same hold.
  add_estimate(slips->compensation + (is_late ? slips->held_compensation : 0), loop, gains);
  if (const std::string why = uncovered_when_late(*slips, loop); !why.empty()) gains.hindrance = why;
  return gains;
}

// For a law without tunables, with slips or without.
Unbounded unbounded(const Gains& gains, const std::optional<SlipMotor>& slips, const SampledLoop& loop) {
  if (!(loop.travel > 0)) return Unbounded::no_range;
  if (!gains.follows_estimate && gains.hindrance.empty() && gains.dampers == 0) return Unbounded::nothing;
  if (slips && slips->lets_go_by_estimate) return Unbounded::contact;
  return gains.follows_estimate ? Unbounded::estimate : Unbounded::dampers;
}

// Stiffness of the network before any slip gives way.
double stiffness_of(const MotorConstants& linear, const std::optional<SlipMotor>& slips) {
  const MotorConstants beside = motor_beside(slips, linear);
  return beside.static_stiffness + beside.step_stiffness + (slips ? 2 * slips->stiffness : 0);
}

// F_i = c_i (u − q_i), where q_i is an average of earlier positions: within the travel R it is at most c_i R.
double largest_force(const MotorConstants& linear, const std::optional<SlipMotor>& slips, const SampledLoop& loop) {
  return stiffness_of(linear, slips) * loop.travel * margin;
}

bool is_enough(const std::optional<double>& wanted, double given) { return given == 0 || (wanted && *wanted <= given); }

// b ≥ β′ ((1 + 2n) T + L + S + W)
double needed_by(const Gains& gains, const SampledLoop& loop, double slew_time) {
  const double late =
      (1 + 2.0 * loop.delay_samples) * loop.longest_hold() + time_of_lag(loop) + time_of_write(loop) + slew_time;
  return gains.all() * late + gains.dampers * loop.longest_hold() / loop.sample_period * margin;
}

// Whether the hold certificate asks for the same, which is known to the last bit: up to a slack between the two of
// which nothing else that is proved of a law can be (certificate.cpp).
constexpr double as_good_as_one = 1 - 1e-9;

bool is_same_statement(const Gains& gains, const MotorConstants& linear, const std::optional<SlipMotor>& slips,
                       const SampledLoop& loop) {
  const bool is_prompt = loop.delay_samples == 0 && linear.velocity_gain == 0;
  return loop.amplifier_lag == 0 && (gains.estimate == 0 || (slips && is_prompt));
}

}  // namespace

std::string_view name_of(LimitRule rule) {
  switch (rule) {
    case LimitRule::none: return "none";
    case LimitRule::clamps: return "clamps";
    case LimitRule::sheds: return "sheds";
  }
  return "";
}

double largest_change(const SampledLoop& loop) {
  return loop.motor_slew * std::max(loop.sample_period - loop.jitter, 0.0);
}

std::optional<double> slew_needed(const MotorConstants& motor, const SampledLoop& loop) {
  const double shortest = loop.sample_period - loop.jitter;
  if (!(loop.travel > 0) || !(loop.tool_speed > 0) || !(shortest > 0) || motor.follows_estimate()) return std::nullopt;
  double change = (motor.static_stiffness + motor.step_stiffness) * loop.tool_speed * loop.longest_hold();
  for (const MotorMode& mode : motor.modes)
    change += (mode.decay > 0 ? mode.position_drive / mode.decay : mode.position_drive) * loop.travel * mode.loss;
  return change / shortest * margin;
}

double time_of_lag(const SampledLoop& loop) {
  const double lag = loop.amplifier_lag;
  if (!(lag > 0)) return 0;
  const double shortest = loop.sample_period - loop.jitter - (loop.write_latest - loop.write_earliest);
  const double kept = -std::expm1(-shortest / lag);                 // 1 − q
  if (!(kept > 0)) return std::numeric_limits<double>::infinity();  // two samples may follow at once
  const double lost = -std::expm1(-2 * loop.longest_hold() / lag);  // 1 − q_T²
  return 2 * std::sqrt(loop.longest_hold() * lag * lost / 2) / kept * margin;
}

double time_of_write(const SampledLoop& loop) {
  if (loop.write_latest == 0) return 0;
  const double s = loop.late_share(), prompt = 1 + 2.0 * loop.delay_samples, all = prompt + 2 * s;
  // ½ (√(m² + 4κ) − m) = 2κ/(√(m² + 4κ) + m)
  const double apart = s * (1 - s), more = 2 * apart / (std::sqrt(all * all + 4 * apart) + all);
  return (2 * s + more) * loop.longest_hold() * margin;
}

double time_of_lateness(const SampledLoop& loop) {
  return time_of_lag(loop) + 2 * std::sqrt(loop.longest_hold() * loop.write_latest) * margin;
}

std::optional<double> damping_for_slew(const MotorConstants& motor, double used, const SampledLoop& loop) {
  const Gains gains = gains_of(motor, std::nullopt, loop);
  if (!gains.hindrance.empty()) return std::nullopt;
  return 2 * gains.all() * loop.longest_hold() * std::sqrt(used / (3 * loop.motor_slew)) * margin;
}

std::optional<double> needed_sample_by_sample(const MotorConstants& linear, const std::optional<SlipMotor>& slips,
                                              const SampledLoop& loop) {
  const Gains gains = gains_of(linear, slips, loop);
  const double needed = needed_by(gains, loop, 0);
  const bool is_known = gains.hindrance.empty() && loop.motor_slew == 0 && std::isfinite(needed);
  return is_known ? std::optional(needed) : std::nullopt;
}

double covered_discontinuity(double slew, double spare_damping, double stiffness, double sample_period) {
  if (!(slew > 0 && spare_damping > 0 && stiffness > 0)) return 0;
  // F0² − (6 ρ x/K − 3/2 ρT) F0 + (½ + B) (ρT)² ≤ 0
  const double step = slew * sample_period, sum = 6 * slew * spare_damping / stiffness - 1.5 * step;
  const double discriminant = sum * sum - 4 * (0.5 + largest_bernoulli) * step * step;
  const double force = sum > 0 && discriminant >= 0 ? (sum + std::sqrt(discriminant)) / 2 : 0;
  return force >= step ? force : 0;
}

MotorLimits motor_limits(const UpdateLaw& law, const std::optional<SlipMotor>& slips, const SampledLoop& loop,
                         double needed, const Rational& assured) {
  MotorLimits limits;
  if (!loop.has_device) return limits;
  const MotorConstants linear = linear_motor_constants(law);
  const Gains gains = gains_of(linear, slips, loop);
  limits.unbounded = unbounded(gains, slips, loop);
  if (limits.unbounded == Unbounded::nothing) limits.largest_force = largest_force(linear, slips, loop);
  if (!slips) limits.slew_needed = slew_needed(linear, loop);
  if (loop.motor_slew > 0 && loop.write_latest == 0)
    limits.largest_discontinuity = covered_discontinuity(loop.motor_slew, assured.convert_to<double>() - needed,
                                                         stiffness_of(linear, slips), loop.sample_period);
  const bool slew_is_enough = is_enough(limits.slew_needed, loop.motor_slew);
  if (is_enough(limits.largest_force, loop.max_force) && slew_is_enough) return limits;
  limits.rule = slips || linear.follows_estimate() || !slew_is_enough ? LimitRule::sheds : LimitRule::clamps;
  limits.reason = gains.hindrance;
  if (!slew_is_enough) limits.reason = "its force may have to fall faster than the motor's slew";
  if (!std::isfinite(time_of_lag(loop))) limits.reason = at_once;
  if (loop.motor_slew > 0 && loop.amplifier_lag > 0) limits.reason = "the amplifier lags, and its slew is limited";
  if (limits.reason.empty()) {
    const double slew_time =
        loop.motor_slew > 0 ? 2 * loop.longest_hold() * std::sqrt(*limits.slew_needed / (3 * loop.motor_slew)) : 0;
    limits.needed = needed_by(gains, loop, slew_time);
    if (is_same_statement(gains, linear, slips, loop) && needed >= limits.needed * as_good_as_one)
      limits.needed = needed;
    // Behind a contact the brake is off while the tool is free, and a touch is noticed late.
    const bool is_alone = slips && slips->behind_contact && loop.is_late();
    const Rational there = is_alone ? assured_damping(loop, 0) : assured;
    if (!std::isfinite(limits.needed) || Rational(limits.needed) > there) limits.available = there.convert_to<double>();
  }
  limits.is_covered = limits.reason.empty() && !limits.available;
  return limits;
}

MotorLimits motor_limits_over_box(const SampledLoop& loop, const std::optional<double>& needed,
                                  const Rational& assured) {
  MotorLimits limits;
  if (!loop.has_device || !(loop.max_force > 0 || loop.motor_slew > 0)) return limits;
  limits.rule = LimitRule::sheds;
  limits.unbounded = Unbounded::tunables;
  if (!needed) limits.reason = "passivity is not proved below the limit either";
  else if (loop.motor_slew > 0) limits.reason = "its force may have to fall faster than the motor's slew";
  else if (loop.is_late()) limits.reason = fmt::format("its parameters change while it runs, and {}", why_late(loop));
  else limits.needed = *needed;
  if (Rational(limits.needed) > assured) limits.available = assured.convert_to<double>();
  limits.is_covered = limits.reason.empty() && !limits.available;
  return limits;
}

std::string why_not_covered(const MotorLimits& limits, const std::string& unit) {
  if (!limits.available) return limits.reason;
  return fmt::format("by a proof sample by sample it needs {:.6g} {} of damping, and {:.6g} is guaranteed",
                     limits.needed, unit, *limits.available);
}

namespace {

std::string_view in_words(Unbounded why) {
  switch (why) {
    case Unbounded::nothing: return "";
    case Unbounded::no_range: return "the device file states no \"range\" of its encoder";
    case Unbounded::estimate: return "it uses the estimated velocity";
    case Unbounded::contact: return "the end of its contact is computed from the estimated velocity";
    case Unbounded::dampers: return "dampers are in its parts with slips";
    case Unbounded::tunables: return "its parameters change while it runs";
    case Unbounded::curve: return "it has a static curve";
  }
  return "";
}

}  // namespace

std::vector<std::string> to_lines(const MotorLimits& limits, const SampledLoop& loop, const PortUnits& units) {
  std::vector<std::string> lines;
  if (!loop.has_device) return lines;
  const std::string rate = units.force + "/s";
  std::string asked = limits.largest_force ? fmt::format("the law asks for up to {:.6g} {} within the encoder's range",
                                                         *limits.largest_force, units.force)
                                           : std::string("no bound is proved on the force that the law asks for");
  if (limits.unbounded != Unbounded::nothing) asked += fmt::format(", because {}", in_words(limits.unbounded));
  if (loop.max_force > 0) asked += fmt::format("; the motor gives {:.6g} {}", loop.max_force, units.force);
  if (loop.max_force > 0 || limits.largest_force) lines.push_back("largest force: " + asked);
  if (limits.slew_needed || loop.motor_slew > 0)
    lines.push_back("slew: " +
                    (limits.slew_needed ? fmt::format("{:.6g} {} are enough for any motion within range and speed",
                                                      *limits.slew_needed, rate)
                                        : std::string("what would be enough for any motion is not known")) +
                    (loop.motor_slew > 0 ? fmt::format(", the motor has {:.6g} {}", loop.motor_slew, rate) : ""));
  if (limits.largest_discontinuity.value_or(0) > 0)
    lines.push_back(fmt::format(
        "sudden loss: where a force of up to {:.6g} {} vanishes at once, as in a puncture, the motor follows "
        "as fast as its slew allows, without injecting energy",
        *limits.largest_discontinuity, units.force));
  if (limits.rule == LimitRule::none) return lines;
  const char* does =
      limits.rule == LimitRule::sheds ? "the law scales all its forces down together" : "the motor clips";
  lines.push_back(limits.is_covered
                      ? fmt::format("at the motor's limit: {}; that is passive with the {:.6g} {} that it needs", does,
                                    limits.needed, units.damping)
                      : fmt::format("at the motor's limit: {}; passivity is not proved there: {}", does,
                                    why_not_covered(limits, units.damping)));
  return lines;
}

}  // namespace dashpot::compiler
