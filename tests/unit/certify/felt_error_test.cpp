// What is felt of a law on a device, against the estimator's own transfer function.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "certify/felt_error.hpp"
#include "motors.hpp"

namespace dashpot::compiler {
namespace {

constexpr double sample_period = 5e-4;

velocity_description estimator(estimator_kind kind, unsigned window_or_order, double number = 0) {
  velocity_description velocity;
  velocity.estimator = kind;
  velocity.window = window_or_order;
  velocity.order = window_or_order;
  velocity.cutoff = number;
  velocity.acceleration = number;
  return velocity;
}

Device device_with(const velocity_description& velocity) {
  Device device;
  device_description& described = device.description;
  described.motion = motion::translation;
  described.loop.sample_period = sample_period;
  described.loop.delay_samples = 2;
  described.loop.band_low = 0.1;
  described.loop.band_high = 900;
  described.encoder.step = 1e-5;
  described.motor.amplifier_lag = 3e-4;
  described.velocity = velocity;
  return device;
}

// A damper made by the motor alone: the hold, the device and the estimator are all that stands between it and the hand.
// Fails if the error is told with another response of the estimator than the one that runs, its zeros at −1 included.
TEST(FeltError, OfAMotorThatDampsIsThatOfItsEstimator) {
  constexpr double damping = 3;
  LinearForm form;
  form.feedthrough_damping = damping;
  for (const velocity_description& velocity :
       {estimator(estimator_kind::backward_difference, 1), estimator(estimator_kind::backward_difference, 7),
        estimator(estimator_kind::least_squares, 9), estimator(estimator_kind::butterworth, 1, 100),
        estimator(estimator_kind::butterworth, 2, 100), estimator(estimator_kind::butterworth, 3, 400),
        estimator(estimator_kind::butterworth, 4, 60), estimator(estimator_kind::kalman, 0, 50)}) {
    SCOPED_TRACE(::testing::Message() << "estimator " << int(velocity.estimator) << ", " << velocity.order << ", "
                                      << velocity.cutoff);
    Diagnostics diagnostics;
    const PortDevice device = PortDevice::of(device_with(velocity), Network(), diagnostics).value();
    const SampledLoop loop = sampled_loop(device, sample_period);
    const FeltError felt(damper_motor(damping), form, form, loop, device);
    const std::vector<double> errors = felt.over_band(0, 0);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double w = 2 * std::numbers::pi * felt.frequencies()[i], half = w * sample_period / 2;
      const std::complex<double> hold = std::polar(std::sin(half) / half, -half);
      const std::complex<double> response = device.velocity_response(w) * device.motor_response(w) * hold;
      EXPECT_NEAR(errors[i], std::abs(response - 1.0), 1e-9) << felt.frequencies()[i] << " Hz";
    }
  }
}

}  // namespace
}  // namespace dashpot::compiler
