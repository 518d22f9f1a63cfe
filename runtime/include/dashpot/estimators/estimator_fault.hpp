// What keeps an estimator from being built as a device file describes it.
#pragma once

#include <dashpot/device_description.hpp>

namespace dashpot {

// 20 ms at 10 kHz, the longest in common use, with room to spare.
inline constexpr unsigned longest_window = 256;  // [samples]

// Each names the key to be corrected; what follows is what that key must be.
enum class estimator_fault : unsigned char {
  none,
  window,         // 1 … longest_window
  order,          // 2 or 4
  cutoff,         // above 0, below half the sample rate
  acceleration,   // above 0
  filter_factor,  // 1 or more
  bandwidth,      // 0 or more
  encoder_step,   // above 0: the estimator is tuned to the quantum it smooths
};

namespace detail {

constexpr estimator_fault unless(bool holds, estimator_fault fault) noexcept {
  return holds ? estimator_fault::none : fault;
}

}  // namespace detail

// The first fault of `wanted`, for `sample_period` [s] > 0 and `encoder_step` [m] or [rad]; a value that is not a
// number is a fault.
constexpr estimator_fault fault_in(const velocity_description& wanted, double sample_period,
                                   double encoder_step) noexcept {
  using detail::unless;
  using fault = estimator_fault;
  const fault window = unless(wanted.window >= 1 && wanted.window <= longest_window, fault::window);
  const fault order = unless(wanted.order == 2 || wanted.order == 4, fault::order);
  const fault cutoff = unless(wanted.cutoff > 0 && wanted.cutoff * sample_period < 0.5, fault::cutoff);
  const fault acceleration = unless(wanted.acceleration > 0, fault::acceleration);
  const fault step = unless(encoder_step > 0, fault::encoder_step);
  switch (wanted.estimator) {
    case estimator_kind::backward_difference:
    case estimator_kind::least_squares: return window;
    case estimator_kind::butterworth: return order != fault::none ? order : cutoff;
    case estimator_kind::inverse_time: return step;
    case estimator_kind::foaw: return window != fault::none ? window : step;
    case estimator_kind::kalman: return acceleration != fault::none ? acceleration : step;
    case estimator_kind::super_twisting: return acceleration;
    case estimator_kind::tracking_differentiator:
      return acceleration != fault::none ? acceleration : unless(wanted.filter_factor >= 1, fault::filter_factor);
    case estimator_kind::sensor: return unless(wanted.bandwidth >= 0, fault::bandwidth);
    case estimator_kind::interval_difference: return fault::none;
  }
  return fault::none;
}

}  // namespace dashpot
