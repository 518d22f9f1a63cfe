#include "certify/slip_motor.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "certify/cut.hpp"
#include "certify/held_slips.hpp"
#include "certify/motor_limits.hpp"
#include "discretise/mode_coefficients.hpp"
#include "discretise/rounding.hpp"

namespace dashpot::compiler {
namespace {

// Over a component's regimes; 0 where they are not listed.
template <class Number>
Number least_of(const ComponentSplit& split, Number BrakeShare::*number) {
  return split.shares.empty() ? Number(0) : std::ranges::min(split.shares, {}, number).*number;
}

double largest_behind_slips(const SlipDecomposition& slips) {
  double sum = 0;
  for (const ComponentSplit* split : slips.all()) sum += split->largest_damping();
  return sum;
}

std::vector<Real> feedthroughs(const ComponentSplit& split) {
  std::vector<Real> all;
  for (const BrakeShare& share : split.shares) all.push_back(share.feedthrough);
  return all.empty() ? std::vector<Real>{0} : all;
}

// Whether the motor adds what a lagging coil does not make yet: not under the ramped law.
bool may_fall_short(const SlipDecomposition& slips) {
  const std::vector<const ComponentSplit*> all = slips.all();
  return slips.coil_share < 1 && std::any_of(all.begin(), all.end(), [](const ComponentSplit* split) {
           return split->law != SlipLaw::ramped && split->law != SlipLaw::steady;
         });
}

class Sum {
 public:
  Sum(const Network& network, const CutSettings& settings, double encoder_step, ScalarType scalar)
      : network_(network), settings_(settings), half_step_(encoder_step / 2), margin_(1 + 16 * unit_roundoff(scalar)) {}

  // Every part has a cut: networks in which slips alone join tool and ground were refused. `split`: the brake's part.
  // It is empty for a part behind a contact, where in the worst case the brake makes none of the dampers' force.
  void add(const NormalTree& component, const ComponentSplit& split) {
    const std::vector<Real> shares = feedthroughs(split);
    add(least_cut(component, settings_).value());
    add_held(held_slips(component, shares, settings_), shares);
    add_brake(split);
  }
  void add(const std::vector<std::size_t>& elements, const ComponentSplit& split) {
    const std::vector<Real> shares = feedthroughs(split);
    add(least_cut(network_, elements, settings_).value());
    add_held(held_slips(network_, elements, shares, settings_), shares);
    add_brake(split);
  }

  // The brake makes the dampers' force while the tool touches, and nothing while it is free. A ramp starts anew at
  // every touch.
  void add_behind_contact(const LinearForm& linear, double brake, double behind_slips) {
    add(cut_of(linear, settings_));
    held_gain_ += linear.static_stiffness;
    for (const Mode& mode : linear.modes)
      held_gain_ +=
          2 * mode_coefficients(mode, settings_.scheme, StateInput::position, settings_.sample_period).position_gain;
    motor_.behind_contact = true;
    const double feedthrough = to_double(linear.feedthrough_damping);
    motor_.lets_go_by_estimate = feedthrough + behind_slips > 0;
    motor_.compensation += feedthrough + behind_slips + std::abs(feedthrough - brake);
    motor_.largest_brake = brake + behind_slips;
  }

  // The brake's own excess covers what a ramp takes back; what a steady law takes back comes out of its constant b.
  void add_compensation(const ComponentSplit& split) {
    (split.law == SlipLaw::steady ? motor_.compensation : motor_.held_compensation) += split.largest_compensation();
  }

  // The motor adds (b of the regime less b) v̂ while the coil lags, at most `most`.
  void make_up(double most) { motor_.compensation += std::min(most, motor_.largest_brake - motor_.least_brake); }

  SlipMotor result() {
    motor_.stiffness = to_double(cut_.stiffness) * margin_;
    motor_.springs_alone = dampers_ == 0;
    const bool is_left_over = cut_.damping <= dampers_ * negligible_share;  // from cancellation
    motor_.damping = is_left_over ? 0 : to_double(cut_.damping) * margin_;
    motor_.held_gain = to_double(held_gain_) * margin_;
    return motor_;
  }

 private:
  void add_brake(const ComponentSplit& split) {
    cut_.damping -= least_of(split, &BrakeShare::feedthrough);
    motor_.least_brake += least_of(split, &BrakeShare::damping);
    motor_.largest_brake += split.largest_damping();
    add_compensation(split);
  }

  void add(const Cut& cut) {
    cut_ += cut;
    dampers_ += cut.damping;
  }

  // If the slip that carries all of the tool's force yields within an encoder step, that force is so small that K
  // bounds it anyway.
  void add_held(const HeldSlips& held, const std::vector<Real>& shares) {
    held_gain_ += held.gain;
    const bool is_motors = std::all_of(shares.begin(), shares.end(), [](const Real& x) { return x == 0; });
    if (is_motors && held.series_yield >= 0 && held.series_yield <= held.gain * half_step_) return;
    for (const HeldSlip& slip : held.slips)
      motor_.slides_within_step = motor_.slides_within_step || slip.yield_force < slip.gain * half_step_;
  }

  const Network& network_;
  CutSettings settings_;
  Real half_step_;  // Δ/2 [m]
  double margin_;
  Cut cut_;
  Real dampers_ = 0;  // dampers across the cut, with the brake's part
  Real held_gain_ = 0;
  SlipMotor motor_;
};

}  // namespace

MotorConstants motor_beside(const std::optional<SlipMotor>& slips, const MotorConstants& linear) {
  return slips && slips->behind_contact ? MotorConstants{} : linear;
}

double lateness(const SampledLoop& loop) {
  const double late = time_of_lateness(loop);
  return (loop.delay_samples + 1 + (std::isfinite(late) ? late / (2 * loop.longest_hold()) : 0)) * (1 + 1e-14);
}

double stiffness_share(const SlipMotor& motor, const SampledLoop& loop) {
  const double lag = time_of_lag(loop), late = std::isfinite(lag) ? lag + time_of_write(loop) : 0;
  if (motor.springs_alone && loop.write_latest > 0)
    return (1 + 2.0 * loop.delay_samples + late / loop.longest_hold()) * (1 + 1e-14);
  if (motor.springs_alone) return (2 * lateness(loop) - 1) * (1 + 1e-14);
  return lateness(loop) * lateness(loop);
}

std::optional<SlipMotor> slip_motor(const Network& network, const NormalForm& form, const Decomposition& decomposition,
                                    const Choices& choices, const SampledLoop& loop) {
  if (!form.has_slips() && !network.contact) return std::nullopt;
  const SlipDecomposition& slips = decomposition.slips;
  Sum sum(network, {choices.scheme, Real(loop.sample_period), lateness(loop)}, loop.encoder_step, choices.scalar);
  const ComponentSplit nothing{};
  const auto of_brake = [&](const ComponentSplit& split) -> const ComponentSplit& {
    return network.contact ? nothing : split;
  };
  const bool is_split = slips.components.size() == form.components.size();
  for (std::size_t i = 0; i < form.components.size(); ++i)
    if (is_split) sum.add(slips.components[i].rendered, of_brake(slips.components[i]));
    else sum.add(form.components[i], nothing);
  if (slips.networks.empty())
    for (const std::vector<std::size_t>& part : form.networks) sum.add(part, nothing);
  for (const ComponentSplit& split : slips.networks) sum.add(split.rendered_elements, of_brake(split));
  if (network.contact) {
    sum.add_behind_contact(form.linear, decomposition.choice().damping, largest_behind_slips(slips));
    for (const ComponentSplit* split : slips.all()) sum.add_compensation(*split);
  } else if (may_fall_short(slips)) {
    sum.make_up(slips.make_up);
  }
  return sum.result();
}

std::string contact_uncovered_when_late(const SlipMotor& motor, const SampledLoop& loop) {
  return motor.lets_go_by_estimate && loop.is_late()
             ? std::string("the end of the contact is computed from the estimated velocity, and ") + why_late(loop)
             : "";
}

std::string uncovered_when_late(const SlipMotor& motor, const SampledLoop& loop) {
  if (std::string contact = contact_uncovered_when_late(motor, loop); !contact.empty()) return contact;
  return !motor.springs_alone && loop.is_late()
             ? std::string("dampers are in the parts with slips, and ") + why_late(loop)
             : "";
}

}  // namespace dashpot::compiler
