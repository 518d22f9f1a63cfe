// The estimator a device description asks for, behind one type without heap or virtual calls: for the servo loop, and
// for the compiler, which reads delay, gain and transfer function here and so judges the code that will run.
#pragma once

#include <dashpot/device.hpp>
#include <dashpot/estimators/backward_difference.hpp>
#include <dashpot/estimators/estimator_fault.hpp>
#include <dashpot/estimators/estimator_names.hpp>
#include <dashpot/estimators/foaw.hpp>
#include <dashpot/estimators/interval_difference.hpp>
#include <dashpot/estimators/inverse_time.hpp>
#include <dashpot/estimators/kalman.hpp>
#include <dashpot/estimators/least_squares.hpp>
#include <dashpot/estimators/low_pass.hpp>
#include <dashpot/estimators/pulse_transfer.hpp>
#include <dashpot/estimators/sensor.hpp>
#include <dashpot/estimators/super_twisting.hpp>
#include <dashpot/estimators/tracking_differentiator.hpp>

namespace dashpot {

template <class Scalar>
class any_estimator {
 public:
  // `wanted` without a fault (estimator_fault.hpp); `sample_period` [s] > 0; `encoder_step` [m] or [rad].
  constexpr any_estimator(const velocity_description& wanted, double sample_period, double encoder_step) noexcept
      : kind_(wanted.estimator), chosen_(build(wanted, sample_period, encoder_step)) {}

  // At rest at `position` [m] or [rad].
  void reset(Scalar position) noexcept {
    visit(*this, [position](auto& estimator) { estimator.reset(position); });
  }

  // A sample with a finite position (of `sensor`: velocity) → velocity [m/s] or [rad/s].
  Scalar update(const device_sample& sample) noexcept {
    if (kind_ == estimator_kind::sensor) return chosen_.measured.update(static_cast<Scalar>(sample.velocity));
    const Scalar position = static_cast<Scalar>(sample.position);
    if (kind_ == estimator_kind::inverse_time)
      return chosen_.inverse.update(position, sample.edge_time_ns, sample.timestamp_ns);
    if (kind_ == estimator_kind::interval_difference) return chosen_.timed.update(position, sample.timestamp_ns);
    return update_from_position(position);
  }

  constexpr estimator_kind kind() const noexcept { return kind_; }

  // Mean delay [s], as the estimator's own header states it.
  constexpr double delay() const noexcept {
    return visit(*this, [](const auto& estimator) { return estimator.delay(); });
  }

  // Samples before the newest that the estimate depends on; 0: all of them.
  constexpr unsigned memory() const noexcept {
    switch (kind_) {
      case estimator_kind::backward_difference: return chosen_.difference.window();
      case estimator_kind::least_squares: return chosen_.slope.window();
      case estimator_kind::foaw: return chosen_.adaptive.longest_window();
      case estimator_kind::interval_difference: return 1;
      default: return 0;
    }
  }

  // max|G| as defined in frequency_response.hpp; 0 for an estimator that is not linear.
  constexpr double max_gain() const noexcept {
    switch (kind_) {
      case estimator_kind::backward_difference: return chosen_.difference.max_gain();
      case estimator_kind::least_squares: return chosen_.slope.max_gain();
      case estimator_kind::butterworth: return chosen_.filtered.max_gain();
      case estimator_kind::kalman: return chosen_.predicted.max_gain();
      case estimator_kind::sensor: return chosen_.measured.max_gain();
      case estimator_kind::interval_difference: return chosen_.timed.max_gain();
      default: return 0;
    }
  }

  // All coefficients of the numerator 0 for an estimator that is not linear.
  constexpr pulse_transfer<longest_window> transfer() const noexcept {
    switch (kind_) {
      case estimator_kind::backward_difference: return chosen_.difference.transfer();
      case estimator_kind::least_squares: return chosen_.slope.transfer();
      case estimator_kind::butterworth: return widen<longest_window>(chosen_.filtered.transfer());
      case estimator_kind::kalman: return widen<longest_window>(chosen_.predicted.transfer());
      case estimator_kind::sensor: return widen<longest_window>(chosen_.measured.transfer());
      case estimator_kind::interval_difference: return widen<longest_window>(chosen_.timed.transfer());
      default: return {};
    }
  }

 private:
  union alternative {
    constexpr explicit alternative(const backward_difference<Scalar, longest_window>& it) noexcept : difference(it) {}
    constexpr explicit alternative(const least_squares<Scalar, longest_window>& it) noexcept : slope(it) {}
    constexpr explicit alternative(const low_pass<Scalar>& it) noexcept : filtered(it) {}
    constexpr explicit alternative(const inverse_time<Scalar>& it) noexcept : inverse(it) {}
    constexpr explicit alternative(const foaw<Scalar, longest_window>& it) noexcept : adaptive(it) {}
    constexpr explicit alternative(const kalman<Scalar>& it) noexcept : predicted(it) {}
    constexpr explicit alternative(const super_twisting<Scalar>& it) noexcept : twisted(it) {}
    constexpr explicit alternative(const tracking_differentiator<Scalar>& it) noexcept : tracked(it) {}
    constexpr explicit alternative(const sensor<Scalar>& it) noexcept : measured(it) {}
    constexpr explicit alternative(const interval_difference<Scalar>& it) noexcept : timed(it) {}

    backward_difference<Scalar, longest_window> difference;
    least_squares<Scalar, longest_window> slope;
    low_pass<Scalar> filtered;
    inverse_time<Scalar> inverse;
    foaw<Scalar, longest_window> adaptive;
    kalman<Scalar> predicted;
    super_twisting<Scalar> twisted;
    tracking_differentiator<Scalar> tracked;
    sensor<Scalar> measured;
    interval_difference<Scalar> timed;
  };

  static constexpr alternative build(const velocity_description& wanted, double period, double step) noexcept {
    const foaw_fit fit = wanted.best_fit ? foaw_fit::best : foaw_fit::end;
    switch (wanted.estimator) {
      case estimator_kind::backward_difference:
        return alternative(backward_difference<Scalar, longest_window>(wanted.window, period));
      case estimator_kind::least_squares:
        return alternative(least_squares<Scalar, longest_window>(wanted.window, period));
      case estimator_kind::butterworth: return alternative(low_pass<Scalar>(wanted.order, wanted.cutoff, period));
      case estimator_kind::inverse_time: return alternative(inverse_time<Scalar>(step, period));
      case estimator_kind::foaw: return alternative(foaw<Scalar, longest_window>(wanted.window, fit, step, period));
      case estimator_kind::kalman: return alternative(kalman<Scalar>(wanted.acceleration, step, period));
      case estimator_kind::super_twisting: return alternative(super_twisting<Scalar>(wanted.acceleration, period));
      case estimator_kind::tracking_differentiator:
        return alternative(tracking_differentiator<Scalar>(wanted.acceleration, wanted.filter_factor, period));
      case estimator_kind::interval_difference: return alternative(interval_difference<Scalar>(period));
      case estimator_kind::sensor: break;
    }
    return alternative(sensor<Scalar>(wanted.bandwidth, period));
  }

  Scalar update_from_position(Scalar position) noexcept {
    switch (kind_) {
      case estimator_kind::backward_difference: return chosen_.difference.update(position);
      case estimator_kind::least_squares: return chosen_.slope.update(position);
      case estimator_kind::butterworth: return chosen_.filtered.update(position);
      case estimator_kind::foaw: return chosen_.adaptive.update(position);
      case estimator_kind::kalman: return chosen_.predicted.update(position);
      case estimator_kind::super_twisting: return chosen_.twisted.update(position);
      case estimator_kind::tracking_differentiator: return chosen_.tracked.update(position);
      case estimator_kind::inverse_time:
      case estimator_kind::interval_difference:
      case estimator_kind::sensor: break;
    }
    return 0;
  }

  template <class Self, class Verb>
  static constexpr auto visit(Self& self, Verb verb) noexcept {
    switch (self.kind_) {
      case estimator_kind::backward_difference: return verb(self.chosen_.difference);
      case estimator_kind::least_squares: return verb(self.chosen_.slope);
      case estimator_kind::butterworth: return verb(self.chosen_.filtered);
      case estimator_kind::inverse_time: return verb(self.chosen_.inverse);
      case estimator_kind::foaw: return verb(self.chosen_.adaptive);
      case estimator_kind::kalman: return verb(self.chosen_.predicted);
      case estimator_kind::super_twisting: return verb(self.chosen_.twisted);
      case estimator_kind::tracking_differentiator: return verb(self.chosen_.tracked);
      case estimator_kind::interval_difference: return verb(self.chosen_.timed);
      case estimator_kind::sensor: break;
    }
    return verb(self.chosen_.measured);
  }

  estimator_kind kind_;
  alternative chosen_;
};

}  // namespace dashpot
