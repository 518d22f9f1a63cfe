// The paper's Fig. 5: a ramp for 4 s, then a hold, on the second-order model.
#include <gtest/gtest.h>

#include <cmath>

#include "emitted_laws.hpp"
#include "motion.hpp"

namespace dashpot::responses {
namespace {

constexpr double K1 = 12, K2 = 10, K3 = 5;  // [N/m]
constexpr double B1 = 5, B2 = 6;            // [N·s/m]
constexpr double ramp_time = 4;             // [s]
constexpr double hold_time = 4;             // [s]
constexpr double strain_rate = 0x1p-4;      // [m/s]

// (6) with forces in place of stresses.
double ramp_force(double t) {
  return strain_rate * B1 - strain_rate * B1 * std::exp(-(K1 / B1) * t) + strain_rate * B2 -
         strain_rate * B2 * std::exp(-(K2 / B2) * t) + K3 * strain_rate * t;
}

// Its continuation: each Maxwell element relaxes from where the ramp left it, the spring stays.
double closed_form(double t) {
  if (t <= ramp_time) return ramp_force(t);
  const double held = t - ramp_time;
  return strain_rate * B1 * -std::expm1(-(K1 / B1) * ramp_time) * std::exp(-(K1 / B1) * held) +
         strain_rate * B2 * -std::expm1(-(K2 / B2) * ramp_time) * std::exp(-(K2 / B2) * held) +
         K3 * strain_rate * ramp_time;
}

struct Departure {
  double largest = 0;  // of the peak [1]
  double time = 0;     // [s]
};

// Of the emitted force from the closed form over ramp and hold.
Departure departure_of(const std::string& variant) {
  const EmittedLaw& law = law_of(variant, "second_order_maxwell");
  const double rate = law.rate(), peak = closed_form(ramp_time);
  const std::shared_ptr<Model> model = law.make();
  model->reset(0);
  Departure departure;
  for (int n = 1; n <= (ramp_time + hold_time) * rate; ++n) {
    const double time = n / rate;
    const double velocity = time <= ramp_time ? strain_rate : 0;
    const Command now = model->step(strain_rate * std::min(time, ramp_time), velocity);
    const double off = std::abs(felt_force(now, velocity) - closed_form(time)) / peak;
    if (off > departure.largest) departure = {off, time};
  }
  return departure;
}

// Fails if the exact scheme is not exact for a ramp and a hold, at the paper's own step or at a servo loop's.
TEST(Figure5, IsMetExactlyAtAnyStep) {
  EXPECT_LE(departure_of("exact_5hz").largest, 1e-12);
  EXPECT_LE(departure_of("exact_1khz").largest, 1e-12);
}

// Fails if backward Euler at the paper's 200 ms is not off by what that scheme must be off.
TEST(Figure5, IsMissedByBackwardEulerByTwoPercentAt200Ms) {
  const Departure departure = departure_of("euler_5hz");
  EXPECT_NEAR(100 * departure.largest, 2.200, 0.001);
  EXPECT_NEAR(departure.time, 0.6, 1e-9);
}

// Fails if backward Euler does not converge, or not by its first order.
TEST(Figure5, IsApproachedByBackwardEulerAsTheStep) {
  const double at_8_ms = departure_of("euler_125hz").largest, at_4_ms = departure_of("euler_250hz").largest;
  const double at_2_ms = departure_of("euler_500hz").largest, at_1_ms = departure_of("euler_position").largest;
  EXPECT_NEAR(std::log2(at_8_ms / at_4_ms), 1, 0.05);
  EXPECT_NEAR(std::log2(at_4_ms / at_2_ms), 1, 0.05);
  EXPECT_NEAR(std::log2(at_2_ms / at_1_ms), 1, 0.05);
}

// Fails if the brake is not given B1 + B2, the paper's choice, or the motor does not make up the rest.
TEST(Figure5, SharesTheForceAsThePaperDoes) {
  const std::shared_ptr<Model> model = law_of("exact_5hz", "second_order_maxwell").make();
  model->reset(0);
  const Command first = model->step(strain_rate * 0.2, strain_rate);
  EXPECT_EQ(first.damping, B1 + B2);
  EXPECT_NEAR(first.force, closed_form(0.2) - (B1 + B2) * strain_rate, 1e-12 * closed_form(ramp_time));
  EXPECT_LT(first.force, 0);
}

}  // namespace
}  // namespace dashpot::responses
