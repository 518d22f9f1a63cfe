// The storage functions that prove the sampled bound (theory, section 6b), by their known values.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>

#include "certify/proved_bound.hpp"
#include "certify/storage_function.hpp"
#include "linear/real_traits.hpp"
#include "motors.hpp"

namespace dashpot::compiler {
namespace {

constexpr double punctual_period = 0.001;  // [s]

// Proved, and not more than 1e-8 above the supremum of which the printed digits are given.
void expect_proved(const MotorConstants& motor, const SampledLoop& loop, double supremum, double digits = 1e-9) {
  const std::optional<StorageProof> proof = storage_proof(motor, loop);
  ASSERT_TRUE(proof);
  EXPECT_NEAR(proof->damping / supremum, 1, 1e-8 + digits);
  EXPECT_LE(proof->damping, bound_of(motor, loop).attained * (1 + 1e-8));
  EXPECT_GE(proof->damping, bound_of(motor, loop).attained);
}

// If this failed, a late spring would not be proved at (KT/2)(1 + 2n).
TEST(StorageFunction, LateSpring) {
  for (const unsigned delay : {0u, 1u, 2u, 7u}) {
    SampledLoop loop = plain_loop(punctual_period);
    loop.delay_samples = delay;
    expect_proved(spring_motor(1000), loop, 0.5 * (1 + 2 * delay));
  }
}

// If this failed, differences over longer windows would not be proved at the tabled values.
TEST(StorageFunction, DamperThroughWindows) {
  expect_proved(damper_motor(5), differencing_loop(punctual_period, 2), 2.8125);
  expect_proved(damper_motor(5), differencing_loop(punctual_period, 3), 2.192608591, 3e-10);
  expect_proved(damper_motor(5), differencing_loop(punctual_period, 5), 1.728768207, 3e-10);
}

// If this failed, a Kelvin element in the motor, with delay, lag and filters, would not be proved at the tabled values.
TEST(StorageFunction, KelvinOnDevices) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  SampledLoop loop = differencing_loop(punctual_period, 15);
  loop.amplifier_lag = 0.0002;
  expect_proved(motor, loop, 1.718727108);
  loop.delay_samples = 1;
  expect_proved(motor, loop, 2.575818494);
  loop.amplifier_lag = 0;
  loop.velocity.window = 5;
  expect_proved(motor, loop, 3.352243202);

  motor = spring_motor(2000);
  motor.velocity_gain = 4;
  loop = differencing_loop(1e-4, 1);
  loop.velocity.estimator = estimator_kind::butterworth;
  loop.velocity.order = 4;
  loop.velocity.cutoff = 120;
  loop.delay_samples = 1;
  loop.amplifier_lag = 0.0002;
  expect_proved(motor, loop, 4.030414829);
}

// If this failed, a velocity-driven Maxwell element behind its brake would not be proved at the tabled values.
TEST(StorageFunction, MaxwellDrivenByTheEstimate) {
  for (const auto& [window, supremum] :
       {std::pair(1u, 4.975000208), std::pair(5u, 4.877106299), std::pair(15u, 4.730302196)}) {
    MotorConstants motor = damper_motor(-5);
    add_maxwell(motor, 50, 10, punctual_period, false);
    SampledLoop loop = differencing_loop(punctual_period, window);
    loop.delay_samples = 1;
    expect_proved(motor, loop, supremum);
  }
}

// If this failed, a spring behind a lag of a period would not be proved at the tabled value.
TEST(StorageFunction, SpringBehindALag) {
  SampledLoop loop = plain_loop(punctual_period);
  loop.amplifier_lag = punctual_period;
  expect_proved(spring_motor(1000), loop, 1.513540553);
}

// A spring of 1000 N/m at 1 ms whose commands act 0.1 ms after their samples needs the b of (10 b − 1.5) (b/0.9 − 0.5)
// = 1, sample by sample too; if they act at once or up to 0.1 ms later, that of (10 b − 1.5) (b − 0.5) = 1; a whole
// period later, that of a sample more.
TEST(StorageFunction, SpringOfLateCommands) {
  SampledLoop loop = plain_loop(punctual_period);
  const auto expect = [&](double earliest, double latest, double known) {
    loop.write_earliest = earliest * punctual_period;
    loop.write_latest = latest * punctual_period;
    const std::optional<StorageProof> proof = storage_proof(spring_motor(1000), loop);
    ASSERT_TRUE(proof);
    EXPECT_NEAR(proof->damping / known, 1, 2e-8);
    EXPECT_NEAR(passivity_bound(spring_motor(1000), loop).needed / known, 1, 1e-9);
  };
  expect(0.1, 0.1, 0.3 + std::sqrt(0.3 * 0.3 + 0.0225));
  EXPECT_NEAR(storage_proof(spring_motor(1000), loop)->damping, 0.6354, 5e-5);
  expect(0, 0.1, (6.5 + std::sqrt(6.5 * 6.5 + 10)) / 20);
  expect(1 - 1e-9, 1 - 1e-9, 1.5);
}

using Square = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

Real exact(const dashpot_check::Rational& value) { return Real(numerator(value)) / Real(denominator(value)); }

// For one hold of the tool's motion, in which a command acts for `before` until the next sample and for `after` from
// there on, how much the stored energy falls short of work and heat: the least eigenvalue of the form in the states,
// the displacements in both stretches and the one that the lag weighs, each in units of `scale`.
double least_left_over(const dashpot_check::LoopForm& loop, const StorageProof& proof, double before, double after,
                       double lag) {
  const Eigen::Index n = Eigen::Index(loop.states.size()), a = n, c = n + 1, rho = n + 2;
  std::map<std::string, Eigen::Index> place = {{"w", a}, {"late", c}};
  for (Eigen::Index i = 0; i < n; ++i) place[loop.states[std::size_t(i)]] = i;
  Square next = Square::Zero(n, n + 3), form = Square::Zero(n + 3, n + 3), P = Square::Zero(n, n);
  const auto add = [&](Square& to, Eigen::Index row, const std::string& name, const Real& value) {
    to(row, place.at(name)) += value;
    if (name == "w") to(row, c) += value;  // it is the sum of both
  };
  for (const auto& [state, values] : loop.next)
    for (const auto& [name, value] : values) add(next, place.at(state), name, exact(value));
  const Real A = before, D = after, tau = lag, first = exp(-A / tau), second = exp(-D / tau);
  next(n - 1, n - 1) += first * second;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) P(i, j) = P(j, i) = proof.storage[std::size_t(i)][std::size_t(j)];
  form.topLeftCorner(n, n) = P;
  form -= Square(next.transpose() * P * next);
  const auto work = [&](Eigen::Index i, Eigen::Index j, const Real& value) {
    form(i, j) += value / 2, form(j, i) += value / 2;
  };
  for (const auto& [name, value] : loop.force)
    for (const Eigen::Index part : {a, c}) work(place.at(name), part, exact(value));
  for (const Eigen::Index i : {a, c})
    for (const Eigen::Index j : {a, c}) form(i, j) -= exact(loop.stiffness) / 2;
  const Real mean = tau / A * (1 - first), then = first * tau / D * (1 - second);
  work(n - 1, a, mean), work(n - 1, c, then), work(n - 1, rho, 1);
  const Real square = tau / 2 * (1 - first * first * second * second) - A * mean * mean - D * then * then;
  form(a, a) += proof.damping / A, form(c, c) += proof.damping / D, form(rho, rho) += proof.damping / square;
  Square unit = form.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const Square scaled = unit.asDiagonal() * form * unit.asDiagonal();
  return double(Eigen::SelfAdjointEigenSolver<Square>(scaled, Eigen::EigenvaluesOnly).eigenvalues().minCoeff());
}

// If this failed, one P would not serve some lengths of a hold, or some times at which its commands act, where both
// vary; or it would be far from the least.
TEST(StorageFunction, OfLateCommandsServesAllHolds) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 2;
  add_maxwell(motor, 300, 50, punctual_period, true);
  SampledLoop loop = differencing_loop(punctual_period, 3);
  loop.delay_samples = 1;
  loop.jitter = 0.2 * punctual_period;
  loop.write_earliest = 0.1 * punctual_period;
  loop.write_latest = 0.3 * punctual_period;
  for (const double lag : {0.05, 0.5, 2.0}) {
    SCOPED_TRACE(lag);
    loop.amplifier_lag = lag * punctual_period;
    const std::optional<StorageProof> proof = storage_proof(motor, loop);
    ASSERT_TRUE(proof);
    SampledLoop longest = loop;
    longest.write_earliest = longest.write_latest;
    longest.jitter = loop.jitter;
    EXPECT_GE(proof->damping, storage_proof(motor, longest)->damping * 0.999);
    longest.jitter = 0;
    EXPECT_LE(proof->damping, 1.8 * storage_proof(motor, longest)->damping);
    const dashpot_check::LoopForm form = dashpot_check::loop_form(checked_program(motor), checked_device(loop));
    const double T = punctual_period;
    for (const double period : {0.8 * T, 0.87 * T, T, 1.13 * T, 1.2 * T})
      for (const double from : {0.1 * T, 0.17 * T, 0.3 * T})
        for (const double to : {0.1 * T, 0.21 * T, 0.3 * T})
          EXPECT_GE(least_left_over(form, *proof, period - from, to, loop.amplifier_lag), 0) << period << from << to;
  }
}

// At the supremum itself there is one P alone, here of a damper behind the difference over two samples: what is found
// just above it would lie elsewhere.
TEST(StorageFunction, MatchesTheUniqueSolutionAtTheSupremum) {
  const std::optional<StorageProof> proof = storage_proof(damper_motor(5), differencing_loop(punctual_period, 2));
  ASSERT_TRUE(proof);
  EXPECT_NEAR(proof->storage[0][0], 1562.5, 0.1);
  EXPECT_NEAR(proof->storage[1][0], 625, 0.1);
  EXPECT_NEAR(proof->storage[1][1], 1250, 0.1);
}

// If this failed, the tabled P of the same damper, for the last displacement and the force r = 2500 (Δu_k + Δu_{k−1}),
// would not prove a damping of S (1 + 1e-6), for which it was found; or it would prove S.
TEST(StorageFunction, OfADamperAsItIsTabled) {
  const double first = 1562.501565, mixed = -0.2500001139, second = 2.000000907e-4, r = 2500;
  const double square = second * r * r;
  const dashpot_check::Storage P = {{first + 2 * mixed * r + square}, {mixed * r + square, square}};
  const auto proves = [&](double damping) {
    const SampledLoop loop = differencing_loop(punctual_period, 2);
    return dashpot_check::proves(checked_program(damper_motor(5)), checked_device(loop), P, damping);
  };
  EXPECT_TRUE(proves(2.8125 * (1 + 1e-6)));
  EXPECT_FALSE(proves(2.8125));
}

// If this failed, a mode that hardly relaxes would be charged what the arcs of the frequency search leave open.
TEST(StorageFunction, SlowMode) {
  MotorConstants motor;
  motor.modes = {{0.9999999999974019, 1 - 0.9999999999974019, 0, 565.281042 * 0.9999999999974019 * 1e-4, 0}};
  motor.velocity_gain = 565.281042 * 1e-4;
  SampledLoop loop = differencing_loop(1e-4, 1);
  loop.delay_samples = 2;
  const std::optional<StorageProof> proof = storage_proof(motor, loop);
  ASSERT_TRUE(proof);
  EXPECT_NEAR(proof->damping / 0.14131997, 1, 4e-8);
}

// If this failed, a mode that loses less in a sample than a double can tell from 1, as those of a polymer over 21
// decades of time, would leave the law without a storage function.
TEST(StorageFunction, ModeThatOutlastsDoubles) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  motor.loss_is_emitted = true;
  motor.step_stiffness = 500;
  motor.modes = {{1, 1e-22, 300, 0, 0}, {1, 3e-16, 200, 0, 0}};
  SampledLoop loop = differencing_loop(punctual_period, 3);
  loop.delay_samples = 1;
  MotorConstants spring = motor;
  spring.modes.clear();
  spring.step_stiffness = 0;
  spring.static_stiffness = 1000;
  const std::optional<StorageProof> proof = storage_proof(motor, loop), limit = storage_proof(spring, loop);
  ASSERT_TRUE(proof && limit);
  EXPECT_NEAR(proof->damping / limit->damping, 1, 1e-8);  // a spring, but for what relaxes
}

// Under jitter: without a lag exactly in proportion to the longest hold; behind one, between what is necessary and what
// one P for all holds is known to need.
TEST(StorageFunction, Jitter) {
  SampledLoop late = plain_loop(punctual_period);
  late.delay_samples = 1;
  late.jitter = 0.2 * punctual_period;
  EXPECT_NEAR(storage_proof(spring_motor(1000), late)->damping / 1.8, 1, 1e-8);

  // What is necessary, and what one P for six parts is known to need.
  struct Known {
    double jitter, least, most;
  };
  const auto expect_between = [](const MotorConstants& motor, SampledLoop loop, std::initializer_list<Known> all) {
    loop.jitter = 0;
    const double punctual = storage_proof(motor, loop)->damping;
    for (const Known& known : all) {
      loop.jitter = known.jitter * loop.sample_period;
      const std::optional<StorageProof> proof = storage_proof(motor, loop);
      ASSERT_TRUE(proof);
      EXPECT_GE(proof->damping, punctual * (1 + (known.least - 0.005) / 100)) << known.jitter;
      EXPECT_LE(proof->damping, punctual * (1 + (known.most + 0.02) / 100)) << known.jitter;
    }
  };
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  SampledLoop loop = differencing_loop(punctual_period, 15);
  loop.amplifier_lag = 0.2 * punctual_period;
  expect_between(motor, loop, {{0.05, 4.502, 4.507}, {0.2, 18.00, 18.01}, {0.5, 44.98, 44.99}});

  motor = spring_motor(2000);
  motor.velocity_gain = 4;
  loop = differencing_loop(1e-4, 1);
  loop.velocity.estimator = estimator_kind::butterworth;
  loop.velocity.order = 4;
  loop.velocity.cutoff = 120;
  loop.delay_samples = 1;
  loop.amplifier_lag = 2e-4;
  expect_between(motor, loop, {{0.05, 4.47, 4.64}, {0.2, 17.8, 18.45}, {0.5, 44.5, 45.7}});

  loop = plain_loop(punctual_period);
  loop.amplifier_lag = punctual_period;
  expect_between(spring_motor(1000), loop, {{0.05, 1.73, 2.34}, {0.2, 6.9, 9.0}, {0.5, 17.3, 21.1}});
}

// K = 500 N/m, B = 5 N s/m, 1 ms: the estimate that divides by the interval that has passed hardly asks for more under
// jitter, where that over the nominal period asks for T_max/T.
TEST(StorageFunction, DividesByTheIntervalThatHasPassed) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  SampledLoop loop = differencing_loop(punctual_period, 1);
  const auto expect = [&](estimator_kind estimator, double jitter, double known) {
    loop.velocity.estimator = estimator;
    loop.jitter = jitter * punctual_period;
    const std::optional<StorageProof> proof = storage_proof(motor, loop);
    ASSERT_TRUE(proof);
    EXPECT_NEAR(proof->damping, known, 0.005)
        << name_of(estimator) << " " << jitter;  // as the known values are rounded
    EXPECT_TRUE(dashpot_check::proves(checked_program(motor), checked_device(loop), proof->storage, proof->damping));
    EXPECT_FALSE(dashpot_check::proves(checked_program(motor), checked_device(loop), proof->storage, known - 0.01));
  };
  for (const auto& [jitter, by_interval, by_period] :
       {std::tuple(0.0, 5.25, 5.25), {0.05, 5.26, 5.51}, {0.2, 5.36, 6.30}, {0.5, 6.03, 7.88}}) {
    expect(estimator_kind::interval_difference, jitter, by_interval);
    expect(estimator_kind::backward_difference, jitter, by_period);
  }
}

// Where the search for a P is too much, and in every search for a brake: a damper g alone needs (T₁ + T₂)/2√(T₁T₂) of
// it, whatever the delay, and what position drives beside it T₂/T of what it needs at punctual samples. Stated is what
// is needed together.
TEST(StorageFunction, OfAMeasuredIntervalIsNoMoreThanPartByPart) {
  for (const double jitter : {0.01, 0.2, 0.7})
    for (const unsigned delay : {0U, 2U}) {
      SCOPED_TRACE(jitter);
      SampledLoop loop = differencing_loop(punctual_period, 1);
      loop.velocity.estimator = estimator_kind::interval_difference;
      loop.jitter = jitter * punctual_period;
      loop.delay_samples = delay;
      MotorConstants motor = damper_motor(-3);
      const double alone = 3 / std::sqrt(1 - jitter * jitter);
      EXPECT_NEAR(passivity_bound(motor, loop).needed, alone, 1e-7);
      EXPECT_NEAR(proved_bound(motor, loop).needed, alone, 4e-4 * alone);  // as far as the search goes
      motor.static_stiffness = 400;
      const double together = alone + 0.2 * (1 + 2 * delay) * (1 + jitter);
      EXPECT_NEAR(passivity_bound(motor, loop).needed, together, 1e-7);
      const PassivityBound bound = proved_bound(motor, loop);
      EXPECT_LT(bound.needed, together);
      EXPECT_FALSE(bound.constant_period_only);
      ASSERT_TRUE(bound.storage);
      EXPECT_TRUE(dashpot_check::proves(checked_program(motor), checked_device(loop), *bound.storage, bound.needed));
    }
  SampledLoop loop = differencing_loop(punctual_period, 1);
  loop.velocity.estimator = estimator_kind::interval_difference;
  loop.jitter = punctual_period;
  EXPECT_EQ(proved_bound(damper_motor(1), loop).proof, Proof::none);  // no time may have passed
}

// If this failed, a law would be certified by a proof that leaves out the device's jitter; or the search that is soon
// would end below what the other finds, or far above it.
TEST(StorageFunction, CoversTheJitterBehindALag) {
  MotorConstants motor = spring_motor(500);
  motor.velocity_gain = 5;
  for (const unsigned window : {1U, 3U, 14U}) {
    SampledLoop loop = differencing_loop(punctual_period, window);
    loop.amplifier_lag = 0.2 * punctual_period;
    loop.jitter = 0.2 * punctual_period;
    const double needed = storage_proof(motor, loop)->damping;
    const PassivityBound lacking = stated_bound(motor, loop, 0);
    EXPECT_FALSE(lacking.constant_period_only);
    EXPECT_EQ(lacking.needed, needed);
    const PassivityBound soon = stated_bound(motor, loop, 1000);
    EXPECT_FALSE(soon.constant_period_only);
    EXPECT_GE(soon.needed, needed * (1 - 1e-3));
    EXPECT_LE(soon.needed, needed * 1.02);  // a hundredth above what is necessary, which is no more
    for (const PassivityBound& bound : {lacking, soon})
      EXPECT_TRUE(dashpot_check::proves(checked_program(motor), checked_device(loop), *bound.storage, bound.needed));
    loop.jitter = punctual_period;
    EXPECT_EQ(stated_bound(motor, loop, 1000).proof, Proof::none);
    loop.jitter = 0;
    EXPECT_TRUE(stated_bound(motor, loop, 1000).constant_period_only);
  }
}

// If this failed, jitter would cost a law of slow modes twice what is necessary, because rounding ends the search for
// its P.
TEST(StorageFunction, CoversTheJitterOfSlowModes) {
  constexpr double period = 1e-4;
  SampledLoop loop = differencing_loop(period, 1);
  loop.velocity.estimator = estimator_kind::butterworth;
  loop.velocity.order = 4;
  loop.velocity.cutoff = 120;
  loop.delay_samples = 1;
  loop.amplifier_lag = 2 * period;
  loop.jitter = period / 2;
  for (const double brake : {0.005, 0.02, 0.15}) {
    MotorConstants motor = spring_motor(5);
    add_maxwell(motor, 10, 1 / 0.6, period, true);
    add_maxwell(motor, 12, 2.4, period, true);
    motor.velocity_gain -= brake;
    const double longest = storage_proof(motor, loop)->damping;
    loop.jitter = 0;
    const double punctual = storage_proof(motor, loop)->damping;
    loop.jitter = period / 2;
    EXPECT_GT(longest, punctual * 1.3);
    EXPECT_LT(longest, punctual * 1.5);  // as much longer as the longest hold is
  }
}

// If this failed, a spring that pushes would be proved, whose energy no motion of the tool bounds.
TEST(StorageFunction, NotOfASpringThatPushes) {
  const SampledLoop loop = plain_loop(punctual_period);
  const dashpot_check::Storage nothing = {{0}};
  for (const double stiffness : {1.0, 0.0, -1.0})
    EXPECT_EQ(dashpot_check::proves(checked_program(spring_motor(stiffness)), checked_device(loop), nothing, 0.001),
              stiffness >= 0)
        << stiffness;
}

}  // namespace
}  // namespace dashpot::compiler
