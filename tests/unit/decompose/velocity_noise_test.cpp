// What the steps of an encoder leave in an estimate of velocity, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decompose/port_device.hpp"
#include "decomposed.hpp"

namespace {

using namespace dashpot::compiler;
using std::numbers::pi;

// In units of the rounding to an encoder's step, step/√12.
double noise_of(const Device& device) {
  Diagnostics diagnostics;
  const auto port = PortDevice::of(device, dashpot::testing::written_network(R"({ "spring": 1 })"), diagnostics);
  return port->velocity_noise().value() / (device.description.encoder.step / std::sqrt(12.0));
}

// Fails if the two readings of a difference are not counted as two, or once for each of the samples between them.
TEST(VelocityNoise, OfADifferenceIsThatOfTwoReadings) {
  for (const unsigned window : {1u, 2u, 40u}) {
    Device device = late_device(1);
    device.description.velocity.estimator = dashpot::estimator_kind::backward_difference;
    device.description.velocity.window = window;
    EXPECT_NEAR(noise_of(device) * window * 0.001, std::sqrt(2.0), 1e-14);
  }
}

// Fails if it is not that of a filter whose cut-off is far below the rate: with g = tan(ωT/2) and x = tan(θ/2)/g the
// power is 8g³/(πT²) ∫ x²/((1 + g²x²)² (1 + x⁸)) dx from 0 on, which is (π/8)/sin(3π/8) less at most 2g² of it. A
// state's rounding, one of 2⁵³, is felt for 1/g samples and integrated over as many.
TEST(VelocityNoise, OfAFourthOrderFilterIsThatOfItsBand) {
  for (const double period : {1e-3, 1e-4})
    for (const double cutoff : {0.02, 1.0, 20.0}) {
      Device device = late_device(1);
      device.description.loop.sample_period = period;
      device.description.velocity.cutoff = cutoff;
      const double g = std::tan(pi * cutoff * period),
                   whole = 8 * g * g * g / (pi * period * period) * (pi / 8) / std::sin(3 * pi / 8);
      const double share = std::pow(noise_of(device), 2) / whole;
      const double rounding = 0x1p-53 / (g * g);
      EXPECT_LE(share, 1 + rounding) << cutoff << " Hz at " << 1 / period;
      EXPECT_GE(share, 1 - 2 * g * g - rounding) << cutoff << " Hz at " << 1 / period;
    }
}

}  // namespace
