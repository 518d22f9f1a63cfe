// What a motor needs that follows an adaptive window (theory, section 6b, "Adaptive windows").
#include <gtest/gtest.h>

#include <algorithm>

#include "certify/adaptive_window.hpp"
#include "certify/proved_bound.hpp"
#include "motors.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

SampledLoop adaptive_loop(double sample_period, unsigned longest, unsigned delay = 0, bool best_fit = false) {
  SampledLoop loop = differencing_loop(sample_period, longest);
  loop.velocity.estimator = estimator_kind::foaw;
  loop.velocity.best_fit = best_fit;
  loop.delay_samples = delay;
  return loop;
}

bool is_proved(const MotorConstants& motor, const SampledLoop& loop, const dashpot_check::Storage& storage,
               double damping) {
  return dashpot_check::proves(checked_program(motor), checked_device(loop), storage, damping);
}

// What one of the windows needs that never changes.
double need_of_fixed_windows(const MotorConstants& motor, SampledLoop loop) {
  double most = 0;
  loop.velocity.estimator =
      loop.velocity.best_fit ? estimator_kind::least_squares : estimator_kind::backward_difference;
  for (; loop.velocity.window > 0; --loop.velocity.window) most = std::max(most, bound_of(motor, loop).attained);
  return most;
}

// If this failed, an entry of the tables would not be proved, or be proved with a thousandth less, or be above what is
// known without it, or below what a window needs that never changes.
TEST(AdaptiveWindow, EveryEntryIsProved) {
  unsigned entries = 0;
  for (const bool best_fit : {false, true})
    for (const double gain : {1.0, -1.0})
      for (unsigned delay = 0; delay <= 3; ++delay)
        for (unsigned longest = 1; longest <= 15; ++longest, ++entries) {
          SCOPED_TRACE(::testing::Message() << best_fit << " " << gain << " " << delay << " " << longest);
          const SampledLoop loop = adaptive_loop(1, longest, delay, best_fit);
          const MotorConstants motor = damper_motor(gain);
          const std::optional<WindowStorage> known = window_storage(loop, gain);
          ASSERT_TRUE(known);
          EXPECT_TRUE(is_proved(motor, loop, known->storage, known->factor));
          EXPECT_FALSE(is_proved(motor, loop, known->storage, known->factor * 0.999));
          EXPECT_LE(known->factor, *adaptive_window_gain(loop) * (1 + 2e-5));
          EXPECT_GE(known->factor, need_of_fixed_windows(motor, loop));
        }
  EXPECT_EQ(entries, 240u);
}

// If this failed, the factors would not be the least that semidefinite programming gives.
TEST(AdaptiveWindow, KnownFactors) {
  const auto expect = [](bool best_fit, double gain, unsigned delay, unsigned longest, double known, double digits) {
    SCOPED_TRACE(::testing::Message() << best_fit << " " << gain << " " << delay << " " << longest);
    EXPECT_NEAR(window_storage(adaptive_loop(0.001, longest, delay, best_fit), gain)->factor, known, digits / 2);
  };
  for (const auto& [longest, along, against] :
       {std::tuple(2u, 1.008, 1.042), std::tuple(3u, 1.018, 1.077), std::tuple(5u, 1.037, 1.138),
        std::tuple(8u, 1.055, 1.203), std::tuple(10u, 1.063, 1.235), std::tuple(12u, 1.070, 1.261),
        std::tuple(15u, 1.078, 1.293)}) {
    expect(false, 5, 0, longest, along, 0.001);
    expect(false, -5, 0, longest, against, 0.001);
  }
  for (const auto& [longest, along] :
       {std::pair(2u, 1.0076), std::pair(3u, 1.0135), std::pair(5u, 1.0216), std::pair(8u, 1.0281),
        std::pair(10u, 1.0307), std::pair(12u, 1.0328), std::pair(15u, 1.0351)})
    expect(true, 5, 0, longest, along, 0.0001);
  for (const auto& [delay, along, against] :
       {std::tuple(1u, 1.175, 1.186), std::tuple(2u, 1.240, 1.207), std::tuple(3u, 1.286, 1.243)}) {
    expect(false, 1, delay, 8, along, 0.001);
    expect(false, -1, delay, 8, against, 0.001);
  }
  // 25/24, and what P is lifted by.
  EXPECT_NEAR(window_storage(adaptive_loop(1, 2), -1)->factor, 25.0 / 24, 4e-6);
}

// If this failed, a storage function of one window alone, the longest, would pass for one of all.
TEST(AdaptiveWindow, EveryWindowIsLookedAt) {
  for (const double gain : {1.0, -1.0}) {
    const SampledLoop fixed = differencing_loop(0.001, 8);
    const std::optional<StorageProof> proof = storage_proof(damper_motor(gain), fixed);
    ASSERT_TRUE(proof);
    EXPECT_TRUE(is_proved(damper_motor(gain), fixed, proof->storage, proof->damping));
    EXPECT_FALSE(is_proved(damper_motor(gain), adaptive_loop(0.001, 8), proof->storage, proof->damping));
  }
}

// If this failed, beyond the tables more than γ would be asked for, or less, or no storage function be told that is
// known.
TEST(AdaptiveWindow, BeyondTheTables) {
  SampledLoop lagging = adaptive_loop(0.001, 8);
  lagging.amplifier_lag = 0.0002;
  for (const auto& [loop, has_storage] :
       {std::pair(adaptive_loop(0.001, 16), true), std::pair(adaptive_loop(0.001, 32), true),
        std::pair(adaptive_loop(0.001, 16, 0, true), true), std::pair(adaptive_loop(0.001, 8, 4), true),
        std::pair(adaptive_loop(0.001, 1, 9), true), std::pair(adaptive_loop(0.001, 33), false),
        std::pair(lagging, false)}) {
    SCOPED_TRACE(::testing::Message() << loop.velocity.window << " " << loop.delay_samples);
    EXPECT_EQ(window_storage(loop, 2).has_value(), has_storage);
    const PassivityBound bound = proved_bound(damper_motor(-2), loop);
    EXPECT_EQ(bound.proof, Proof::sampled);
    ASSERT_EQ(bound.storage.has_value(), has_storage);
    EXPECT_NEAR(bound.needed, 2 * *adaptive_window_gain(loop), 1e-7);
    EXPECT_TRUE(!has_storage || is_proved(damper_motor(-2), loop, *bound.storage, bound.needed));
  }
  EXPECT_FALSE(window_storage(differencing_loop(0.001, 8), 2));
  EXPECT_FALSE(adaptive_window_gain(differencing_loop(0.001, 8)));
}

MotorConstants random_motor_with_few_modes(testing::Random& random, double sample_period) {
  MotorConstants motor = spring_motor(random.chance(0.3) ? 0 : random.log_uniform(1, 1000));
  for (std::size_t modes = random.index(3); modes > 0; --modes)
    add_maxwell(motor, random.log_uniform(1, 1000), random.log_uniform(0.1, 1000), sample_period, true);
  motor.velocity_gain = random.uniform(-3, 3);
  return motor;
}

// If this failed, the whole motor's storage function would not prove the sum of both needs, or a tenth of it could be
// left out, or jitter cost anything but its share.
TEST(AdaptiveWindow, AddsUpWithWhatPositionDrives) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    SampledLoop loop = adaptive_loop(random.log_uniform(1e-4, 1e-2), unsigned(random.between(1, 15)),
                                     unsigned(random.index(4)), random.chance(0.5));
    if (random.chance(0.5)) loop.jitter = random.uniform(0, 0.5) * loop.sample_period;
    const MotorConstants motor = random_motor_with_few_modes(random, loop.sample_period);
    const PassivityBound bound = proved_bound(motor, loop);
    ASSERT_TRUE(bound.storage);
    EXPECT_TRUE(is_proved(motor, loop, *bound.storage, bound.needed));
    EXPECT_FALSE(is_proved(motor, loop, *bound.storage, bound.needed * 0.9));
    const double factor = window_storage(loop, motor.velocity_gain)->factor;
    const double beside = passivity_bound(position_driven(motor), loop).needed;
    const double of_estimate = factor * std::abs(motor.velocity_gain) * (1 + loop.jitter / loop.sample_period);
    EXPECT_NEAR(bound.needed / (beside + of_estimate), 1, 2e-8);
    EXPECT_EQ(bound.reason, "the motor follows the velocity estimate");
    EXPECT_LT(bound.needed, passivity_bound(motor, loop).needed * (1 + 1e-8));
  }
}

// The energy that a motion puts in, at least, while `damping` turns as little of it into heat as it can: the estimate
// is of any window that is chosen. At each sample the window and the next displacement are random, or what takes out
// most.
double least_energy(const MotorConstants& motor, const SampledLoop& loop, double damping, testing::Random& random) {
  const double T = loop.sample_period, per_square = damping / loop.longest_hold();
  std::vector<double> last(loop.delay_samples + loop.velocity.window, 0.0);  // displacements, the newest first
  std::vector<double> modes(motor.modes.size(), 0.0);
  const double greed = random.uniform(0, 1), rate = random.chance(0.5) ? -1 : random.uniform(-1, 1);
  double seen = 0, energy = 0, least = 0, next = 1;
  for (int k = 0; k < 400; ++k) {
    const double moved = last[loop.delay_samples];
    seen += moved;
    double held = motor.static_stiffness * seen + motor.step_stiffness * moved;
    for (const double force : modes) held += force;
    const auto estimate = [&](unsigned n) {
      double sum = 0;
      for (unsigned j = 0; j < n; ++j)
        sum += last[loop.delay_samples + j] *
               (loop.velocity.best_fit ? 6.0 * (j + 1) * (n - j) / (n * (n + 1.0) * (n + 2)) : 1.0 / n);
      return sum / T;
    };
    double velocity = estimate(1 + unsigned(random.index(loop.velocity.window)));
    const bool is_greedy = random.chance(greed);
    for (unsigned n = 1; n <= loop.velocity.window && is_greedy; ++n)
      if (std::abs(held + motor.velocity_gain * estimate(n)) > std::abs(held + motor.velocity_gain * velocity))
        velocity = estimate(n);
    const double force = held + motor.velocity_gain * velocity;
    for (std::size_t i = 0; i < modes.size(); ++i)
      modes[i] = motor.modes[i].decay * modes[i] + motor.modes[i].position_drive * moved +
                 motor.modes[i].velocity_drive * velocity;
    next = is_greedy ? -force / (2 * per_square) : rate * next + (rate == -1 ? 0 : random.uniform(-1, 1));
    energy += force * next + per_square * next * next;
    least = std::min(least, energy);
    last.insert(last.begin(), next);
    last.pop_back();
  }
  return least;
}

// If this failed, some motion and some choice of windows would take energy out of a loop with the damping that is
// stated; and with four fifths of it no motion that is tried would.
TEST(AdaptiveWindow, NoMotionTakesEnergyOut) {
  unsigned taken_with_less = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed + 500);
    const SampledLoop loop = adaptive_loop(random.log_uniform(1e-4, 1e-2), unsigned(random.between(1, 15)),
                                           unsigned(random.index(4)), random.chance(0.5));
    MotorConstants motor = random_motor_with_few_modes(random, loop.sample_period);
    if (random.chance(0.3)) add_maxwell(motor, random.log_uniform(1, 1000), random.log_uniform(1, 1000), 0.001, false);
    const PassivityBound bound = passivity_bound(motor, loop);
    ASSERT_EQ(bound.proof, Proof::sampled);
    for (int motion = 0; motion < 20; ++motion) {
      EXPECT_GE(least_energy(motor, loop, bound.needed, random), -1e-9);
      taken_with_less += least_energy(motor, loop, bound.needed * 0.8, random) < -1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(taken_with_less, 30u);
}

// If this failed, nothing would be stated of an estimate that drives states, or less than the largest response at any
// frequency needs.
TEST(AdaptiveWindow, MayDriveStates) {
  SampledLoop loop = adaptive_loop(0.001, 8);
  MotorConstants motor = damper_motor(-5);
  add_maxwell(motor, 50, 10, loop.sample_period, false);
  double response = 0;  // |g + e/(z − a)| on a grid of angles
  const MotorMode& mode = motor.modes.front();
  for (int i = 0; i <= 100'000; ++i)
    response = std::max(response, std::abs(motor.velocity_gain +
                                           mode.velocity_drive / (std::polar(1.0, i * 3.14159265e-5) - mode.decay)));
  const PassivityBound bound = proved_bound(motor, loop);
  EXPECT_EQ(bound.proof, Proof::sampled);
  EXPECT_FALSE(bound.storage);
  EXPECT_EQ(bound.reason, "the velocity estimate drives the states");
  EXPECT_NEAR(bound.needed, *adaptive_window_gain(loop) * response, 1e-6);
  loop.jitter = 0.0005;
  EXPECT_NEAR(proved_bound(motor, loop).needed, 1.5 * bound.needed, 1e-9);
  motor.modes.front().decay = 1;
  motor.modes.front().loss = 0;
  EXPECT_EQ(proved_bound(motor, loop).proof, Proof::none);
}

}  // namespace
}  // namespace dashpot::compiler
