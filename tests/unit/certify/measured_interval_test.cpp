// A motor that follows the difference over the time that has passed, in closed loop: the runtime's estimator, and a
// tool and a clock that are led so as to take energy out.
#include <gtest/gtest.h>

#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <vector>

#include "certify/proved_bound.hpp"
#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::uint64_t period_ns = 1'000'000;

SampledLoop measuring_loop(double jitter) {
  SampledLoop loop = differencing_loop(0.001, 1);
  loop.velocity.estimator = estimator_kind::interval_difference;
  loop.jitter = jitter * loop.sample_period;
  return loop;
}

// What the motor k0 u + g v̂ and a damping at the tool have taken from whoever leads it.
class MeasuringTool {
 public:
  MeasuringTool(const MotorConstants& motor, const SampledLoop& loop, double damping)
      : motor_(motor), estimator_(loop.velocity, loop.sample_period, 0), damping_(damping) {
    estimator_.reset(0);
    sample();
  }

  // By `moved` [m] in so much time, at constant speed, while the force is held.
  void move(double moved, std::uint64_t hold_ns) {
    energy_ += force_ * moved + damping_ * moved * moved / (double(hold_ns) * 1e-9);
    newest_.position += moved;
    newest_.timestamp_ns += hold_ns;
    sample();
  }

  double force() const { return force_; }
  double energy() const { return energy_; }  // [J]

 private:
  void sample() {
    force_ = motor_.static_stiffness * newest_.position + motor_.velocity_gain * estimator_.update(newest_);
  }

  const MotorConstants& motor_;
  any_estimator<double> estimator_;
  double damping_, force_ = 0, energy_ = 0;
  device_sample newest_;
};

// Forth in a short hold and back in a long one, w ∝ √T: of a damper alone what is stated is necessary, to the digit.
TEST(MeasuredInterval, StatedDampingIsNecessaryForADamper) {
  for (const double jitter : {0.05, 0.2, 0.5}) {
    const SampledLoop loop = measuring_loop(jitter);
    const MotorConstants motor = damper_motor(5);
    const double needed = passivity_bound(motor, loop).needed;
    const auto least_energy = [&](double damping) {
      MeasuringTool tool(motor, loop, damping);
      double least = 0;
      for (int k = 0; k < 2000; ++k) {
        const auto late = static_cast<std::uint64_t>(std::llround(jitter * double(period_ns)));
        const std::uint64_t hold_ns = k % 2 == 0 ? period_ns - late : period_ns + late;
        tool.move((k % 2 == 0 ? 1e-3 : -1e-3) * std::sqrt(double(hold_ns) / double(period_ns)), hold_ns);
        least = std::min(least, tool.energy());
      }
      return least;
    };
    EXPECT_GE(least_energy(needed), 0) << jitter;
    EXPECT_LT(least_energy(0.99 * needed), 0) << jitter;
  }
}

// If this failed, what is stated of a spring and a damper would not be enough for a hand and a clock that look for the
// worst: any move in any hold, among them the one that takes most out of the force that is held.
TEST(MeasuredInterval, StatedDampingIsEnough) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  for (const double jitter : {0.05, 0.2, 0.5, 0.9})
    for (const double gain : {5.0, -5.0}) {
      motor.velocity_gain = gain;
      const SampledLoop loop = measuring_loop(jitter);
      const double needed = proved_bound(motor, loop).needed;
      if (jitter < 0.6) {
        EXPECT_LT(needed, passivity_bound(motor, differencing_loop(0.001, 1)).needed * (1 + jitter));
      }
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        testing::Random random(seed);
        MeasuringTool tool(motor, loop, needed);
        const double greed = random.uniform(0.5, 2), restless = random.chance(0.5) ? 1 : 0.01;
        for (int k = 0; k < 2000; ++k) {
          const double share = random.chance(0.5)   ? jitter
                               : random.chance(0.5) ? -jitter
                                                    : random.uniform(-jitter, jitter);
          const auto hold_ns = static_cast<std::uint64_t>(std::llround((1 + share) * double(period_ns)));
          const double most = -tool.force() * (double(hold_ns) * 1e-9) / (2 * needed);
          tool.move(k == 0 || random.chance(restless * 0.1) ? random.uniform(-1e-3, 1e-3) : greed * most, hold_ns);
          ASSERT_GE(tool.energy(), -1e-15) << jitter << " " << gain << " " << seed << " " << k;
        }
      }
    }
}

}  // namespace
}  // namespace dashpot::compiler
