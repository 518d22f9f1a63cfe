// Energy counted in the loop against cases that are known in closed form.
#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/energy/brake_dissipation.hpp>
#include <dashpot/energy/compensated_sum.hpp>
#include <dashpot/energy/hold_observer.hpp>
#include <dashpot/energy/power_observer.hpp>

namespace dashpot::observer_test {
namespace {

constexpr double stiffness = 800, period = 0.001;

// If this failed, a sum of many small terms in float would stop growing.
TEST(CompensatedSum, KeepsWhatRoundingTakes) {
  compensated_sum<float> sum;
  float plain = 0;
  for (int k = 0; k < 1000000; ++k) {
    sum.add(0.1f);
    plain += 0.1f;
  }
  EXPECT_FLOAT_EQ(sum.value(), 100000);
  EXPECT_GT(std::abs(plain - 100000), 100);
}

// If this failed, the observer would not see, or not exactly, the K Δu²/2 that a held spring gives back too much a
// hold.
TEST(HoldObserver, SeesWhatAHeldSpringCreates) {
  hold_observer<double> observer;
  observer.reset(0);
  double position = 0, created = 0;
  for (int k = 0; k < 400; ++k) {
    observer.hold(stiffness * position, 0);
    const double next = 0.01 * std::sin(0.05 * (k + 1));
    created += stiffness * (next - position) * (next - position) / 2;
    position = next;
    observer.observe(position, period);
    // Σ K u_k (u_{k+1} − u_k) = K u²/2 − Σ K Δu²/2; the reference sums 400 terms, below 0.1 J, without compensation.
    EXPECT_NEAR(observer.motor_energy(), stiffness * position * position / 2 - created, 400 * 0.1 * 1.1e-16);
  }
  EXPECT_GT(created, 1e-4);
}

// If this failed, a delayed command would be paired with the displacement of another hold.
TEST(HoldObserver, PairsDelayedCommandsWithTheirHold) {
  hold_observer<double> observer(2);
  observer.reset(0);
  const double force[] = {1, 10, 100, 1000, 10000};
  const double position[] = {0, 1, 3, 6, 10};
  double expected = 0;
  for (int k = 0; k < 5; ++k) {
    if (k > 0) {
      observer.observe(position[k], period);
      if (k >= 3) expected += force[k - 3] * (position[k] - position[k - 1]);
      EXPECT_EQ(observer.motor_energy(), expected);
    }
    observer.hold(force[k], 0);
  }
  EXPECT_EQ(expected, 1 * 3 + 10 * 4);
}

// If this failed, without a new command the old one would be forgotten, or after reset() remembered.
TEST(HoldObserver, KeepsTheLastCommandUntilReset) {
  hold_observer<double> observer;
  observer.reset(1);
  observer.hold(2, 3);
  observer.observe(1.5, 0.5);
  observer.observe(2.5, 0.5);
  EXPECT_EQ(observer.motor_energy(), 2 * 1.5);
  EXPECT_EQ(observer.brake_energy(), 3 * (0.25 + 1) / 0.5);
  EXPECT_EQ(observer.balance(), observer.motor_energy() + observer.brake_energy());
  observer.reset(0);
  observer.observe(1, 0.5);
  EXPECT_EQ(observer.balance(), 0);
}

// If this failed, the bound would exceed the truth, b(t) and the motion within a hold being what they like.
TEST(BrakeDissipation, NeverExceedsTheTruth) {
  brake_dissipation<double> bound;
  bound.reset(0);
  double position = 0, truth = 0;
  for (int k = 0; k < 500; ++k) {
    const double damping = 5 + 4.9 * std::sin(0.3 * k);
    const int slices = 20;
    for (int slice = 0; slice < slices; ++slice) {
      const double speed = 0.1 * std::cos(0.02 * k) + 0.08 * std::sin(1.7 * slice + k);
      position += speed * period / slices;
      truth += damping * speed * speed * period / slices;
    }
    bound.observe(position, damping, period);
    EXPECT_LE(bound.value(), truth);
  }
  EXPECT_GT(bound.value(), 0.5 * truth);
}

// If this failed, for steady motion and exact positions the bound would be no equality.
TEST(BrakeDissipation, IsExactForSteadyMotion) {
  brake_dissipation<double> bound;
  bound.reset(0);
  for (int k = 1; k <= 100; ++k) bound.observe(k * 2e-4, 3, period);
  EXPECT_NEAR(bound.value(), 3 * 0.2 * 0.2 * 0.1, 1e-15);
}

double credited_share(double speed, double step) {
  brake_dissipation<double> bound(step);
  bound.reset(0);
  const int samples = 200000;
  for (int k = 1; k <= samples; ++k) {
    bound.observe(std::floor(speed * k * period / step) * step, 3, period);
  }
  return bound.value() / (3 * speed * speed * samples * period);
}

// If this failed, slow motion over an encoder would be credited with the fast motion that its single steps look like,
// or with nothing.
TEST(BrakeDissipation, QuantisedMotionIsNotOverestimated) {
  for (const double speed : {1e-4, 7e-4, 3e-3, 0.011, 0.05, 0.3}) {
    const double share = credited_share(speed, 30e-6);
    EXPECT_LE(share, 1) << speed;
    EXPECT_GE(share, 49.0 / 64 * 0.99) << speed;
  }
}

// If this failed, trembling by one encoder step at rest would be taken for motion.
TEST(BrakeDissipation, TremblingAtAnEdgeIsNoMotion) {
  brake_dissipation<double> bound(30e-6);
  bound.reset(0);
  for (int k = 0; k < 1000; ++k) bound.observe(k % 2 * 30e-6, 3, period);
  EXPECT_EQ(bound.value(), 0);
}

// If this failed, a pause, a reversal or a released brake would spoil what is counted after it.
TEST(BrakeDissipation, StartsAfreshAfterPauses) {
  const double step = 30e-6, speed = 0.02;
  brake_dissipation<double> bound(step);
  bound.reset(0);
  double truth = 0, position = 0;
  const auto go = [&](double velocity, double damping, int samples) {
    for (int k = 0; k < samples; ++k) {
      position += velocity * period;
      truth += damping * velocity * velocity * period;
      bound.observe(std::floor(position / step) * step, damping, period);
      EXPECT_LE(bound.value(), truth);
    }
  };
  go(0, 5, 10000);
  go(speed, 5, 300);
  go(0, 5, 10000);
  go(speed, 0, 300);
  go(speed, 5, 300);
  go(-speed, 5, 300);
  // Four beginnings and ends cost up to a stretch of eight steps each, of 600 steps.
  EXPECT_GE(bound.value(), 0.7 * truth);
}

// If this failed, motion by fits and starts would not be credited, each move diluted by the pause before it.
TEST(BrakeDissipation, ShortMovesBetweenPausesCount) {
  const double step = 30e-6;
  brake_dissipation<double> bound(step);
  bound.reset(0);
  double position = 0;
  const int moves = 50, steps = 4;
  for (int move = 0; move < moves; ++move) {
    for (int k = 0; k < 1000; ++k) bound.observe(position, 5, period);
    for (int k = 0; k < steps; ++k) bound.observe(position += step, 5, period);
  }
  // Three of the four steps of a move are certain: 9/16 of b Δu²/Δt.
  const double truth = moves * 5 * (steps * step) * (steps * step) / (steps * period);
  EXPECT_NEAR(bound.value(), 9.0 / 16 * truth, 1e-12 * truth);
}

// If this failed, the paper's (20) would not be f v Δt, or would lack the sign by which absorbed energy is positive.
TEST(PowerObserver, SumsForceTimesVelocity) {
  power_observer<double> observer;
  observer.observe(2, 0.5, 0.001);
  observer.observe(-4, 0.25, 0.001);
  observer.observe(3, 1, 0.002);
  EXPECT_NEAR(observer.energy(), 0.006, 1e-18);
  observer.reset();
  EXPECT_EQ(observer.energy(), 0);
}

// A spring's (20) with the velocity of before misses what the hold creates: the two observers would be taken for one.
TEST(PowerObserver, MissesWhatAHeldSpringCreates) {
  hold_observer<double> exact;
  power_observer<double> paper;
  exact.reset(0);
  double before = 0, position = 0;
  const int cycle = 200;
  for (int k = 0; k < cycle; ++k) {
    exact.hold(stiffness * position, 0);
    paper.observe(stiffness * position, (position - before) / period, period);
    before = position;
    position = 0.01 * std::sin(2 * 3.14159265358979323846 * (k + 1) / cycle);
    exact.observe(position, period);
  }
  // Over a cycle the truth is −Σ K Δu²/2, and (20) with a backward difference says the opposite.
  const double rate = 2 * 3.14159265358979323846 / cycle;
  const double created = stiffness * 1e-4 * (1 - std::cos(rate)) * cycle / 2;
  EXPECT_NEAR(exact.motor_energy(), -created, 1e-12 * created);
  EXPECT_GT(paper.energy(), 0.9 * created);
}

// A spring of 800 N/m, sampled and held `delay` samples late: what the observer says, and the sum over holds itself.
template <unsigned Delay>
void expect_true_energy() {
  hold_observer<double> observer(Delay);
  observer.reset(0);
  double position = 0, truth = 0;
  double forces[1000] = {};
  for (int k = 0; k < 1000; ++k) {
    forces[k] = stiffness * position;
    observer.hold(forces[k], 0);
    const double next = 0.01 * std::sin(2 * M_PI * (k + 1) / 1000);
    if (k >= static_cast<int>(Delay)) truth += forces[k - static_cast<int>(Delay)] * (next - position);
    position = next;
    observer.observe(position, period);
  }
  EXPECT_LT(truth, -0.001) << "a late spring gives energy away";
  EXPECT_NEAR(observer.balance(), truth, 1e-13) << Delay;
}

// Taken for 8 samples, a delay of 16 hides half of the energy that comes out of the motor.
TEST(HoldObserver, KnowsEveryDelayThatADeviceMayState) {
  expect_true_energy<1>();
  expect_true_energy<8>();
  expect_true_energy<9>();
  expect_true_energy<16>();
  expect_true_energy<most_delay_samples>();
}

// If a delay is longer than the account, nothing is certain: a number that came out would be believed.
TEST(HoldObserver, CreditsNothingBeyondItsLongestDelay) {
  hold_observer<double, 2> observer(3);
  observer.reset(0);
  observer.hold(1, 100);
  observer.observe(0.01, period);
  EXPECT_EQ(observer.balance(), -HUGE_VAL);
}

// A device that clips, or that has lost a command, makes another force than it was sent: what it tells must count.
TEST(HoldObserver, ReckonsWithWhatTheDeviceApplied) {
  hold_observer<double> observer(1);
  observer.reset(0);
  observer.hold(5, 20, 1);
  observer.observe(0, period);
  observer.hold(6, 20, 2);
  observer.tell(1, 4, true);  // of the first command the device made 4 N; it is in force from here on
  observer.observe(0, period);
  observer.hold(7, 20, 3);
  observer.tell(1, 4, true);  // the second was lost: the first went on
  observer.observe(0.001, period);
  EXPECT_DOUBLE_EQ(observer.motor_energy(), 0.004);
  EXPECT_EQ(observer.brake_energy(), 0) << "nothing is known of a brake that did not do what was asked";
}

}  // namespace
}  // namespace dashpot::observer_test
