// What the encoder's step can stir up in the motor, where it is known in closed form.
#include <gtest/gtest.h>

#include "certify/held_slips.hpp"
#include "certify/quantisation.hpp"
#include "motors.hpp"

namespace dashpot::compiler {
namespace {

constexpr double T = 0.001;  // [s]

double gain_of(const MotorConstants& motor, const SampledLoop& loop) { return quantisation_gain(motor, loop).value(); }

// If this failed, a spring would not pass on an error of the encoder as itself, however late it acts.
TEST(Quantisation, OfASpringIsTheSpring) {
  SampledLoop loop = plain_loop(T);
  EXPECT_EQ(gain_of(spring_motor(800), loop), 800);
  loop.delay_samples = 3;
  loop.amplifier_lag = 0.002;
  EXPECT_EQ(gain_of(spring_motor(800), loop), 800);
}

// If this failed, Maxwell elements would not pass on twice what they answer within a sample, however slow they are: an
// error that jumps after a long rest is felt whole.
TEST(Quantisation, OfMaxwellElementsIsTwiceTheirStep) {
  for (const double rate : {3e-9, 0.2, 700.0}) {
    MotorConstants motor = spring_motor(100);
    add_maxwell(motor, 500, rate, T, true);
    add_maxwell(motor, 40, 20 * rate, T, true);
    EXPECT_NEAR(gain_of(motor, plain_loop(T)) / (100 + 2 * motor.step_stiffness), 1, 1e-12) << rate;
  }
}

// If this failed, a damper through a difference over N samples would not pass on 2 B/(N T); through a least-squares
// slope the sum of its weights' sizes.
TEST(Quantisation, OfADamperFollowsTheEstimator) {
  for (const unsigned window : {1u, 4u, 15u})
    EXPECT_NEAR(gain_of(damper_motor(-3), differencing_loop(T, window)), 6 / (window * T), 1e-9);
  SampledLoop loop = differencing_loop(T, 4);
  loop.velocity.estimator = estimator_kind::least_squares;
  EXPECT_NEAR(gain_of(damper_motor(1), loop), 6 * (4 + 2 + 0 + 2 + 4) / (T * 4 * 5 * 6), 1e-9);
}

// If this failed, FOAW would be taken for its longest window, though it may choose the shortest at every edge; and
// nothing is known of an estimator that is neither linear nor that.
TEST(Quantisation, OfOtherEstimators) {
  SampledLoop loop = differencing_loop(T, 20);
  loop.velocity.estimator = estimator_kind::foaw;
  MotorConstants motor = spring_motor(50);
  motor.velocity_gain = -0.3;
  EXPECT_NEAR(gain_of(motor, loop), 50 + 0.6 / T, 1e-9);
  loop.velocity.estimator = estimator_kind::super_twisting;
  EXPECT_FALSE(quantisation_gain(motor, loop));
}

// If this failed, what friction leaves unpaid would not be K Δ/2 − f_c, nor nothing where it pays for all.
TEST(Quantisation, FrictionPays) {
  Certificate certificate;
  certificate.quantisation_gain = 4000;
  certificate.loop.encoder_step = 1e-5;
  EXPECT_DOUBLE_EQ(unpaid_force(certificate), 0.02);
  certificate.loop.coulomb_friction = 0.015;
  EXPECT_NEAR(unpaid_force(certificate), 0.005, 1e-15);
  certificate.loop.coulomb_friction = 0.02;
  EXPECT_EQ(unpaid_force(certificate), 0);
}

using Tree = NormalTree;

Tree spring(double stiffness) {
  Tree block{Tree::Kind::block, {}, 0, {}, {}};
  block.form.static_stiffness = stiffness;
  return block;
}
Tree damper(double damping) {
  Tree block{Tree::Kind::block, {}, 0, {}, {}};
  block.form.feedthrough_damping = damping;
  return block;
}
Tree slip(double yield_force) { return {Tree::Kind::slip, {}, yield_force, {}, {}}; }
Tree series(std::vector<Tree> children) { return {Tree::Kind::series, {}, 0, {}, std::move(children)}; }
Tree parallel(std::vector<Tree> children) { return {Tree::Kind::parallel, {}, 0, {}, std::move(children)}; }

const CutSettings exact_settings = {Scheme::exact, Real(T), 1};

// If this failed, a spring in front of a slip would not pass on an error as itself, to the tool and to the slip; or a
// slip beside which dampers lie would not hold them fast.
TEST(Quantisation, OfASlipBehindASpringIsTheSpring) {
  for (const Tree& rest : {slip(2), parallel({slip(2), damper(7)})}) {
    const HeldSlips held = held_slips(series({spring(300), rest}), {Real(0)}, exact_settings);
    EXPECT_EQ(held.gain, 300);
    ASSERT_EQ(held.slips.size(), 1u);
    EXPECT_EQ(held.slips.front().gain, 300);
    EXPECT_EQ(held.series_yield, rest.kind == Tree::Kind::slip ? 2 : -1);
  }
}

// If this failed, a damper in front of a slip would not pass on twice what it answers within a sample; or the brake's
// part of it would count.
TEST(Quantisation, OfASlipInSeriesWithADamperIsTheMotorsPart) {
  const Tree component = series({damper(3), slip(1)});
  EXPECT_NEAR(to_double(held_slips(component, {Real(0)}, exact_settings).gain), 2 * 3 / T, 1e-9);
  EXPECT_NEAR(to_double(held_slips(component, {Real(3)}, exact_settings).gain), 0, 1e-9);
  EXPECT_NEAR(to_double(held_slips(component, {Real(3), Real(1)}, exact_settings).gain), 2 * 2 / T, 1e-9);
}

// Behind a damper an error that jumps is felt twice, once as it comes and once as it has died away: 2/(1 + λh) of its
// spring by a slip whose own spring lies beside another.
TEST(Quantisation, OfASlipDeeperInsideHasTermsOfEitherSign) {
  const Tree component = series({damper(4), parallel({spring(50), series({spring(30), slip(1)})})});
  const HeldSlips held = held_slips(component, {Real(0)}, exact_settings);
  EXPECT_NEAR(to_double(held.slips.front().gain), 2 * 30 / (1 + 80.0 / 4 * T), 1e-9);
  EXPECT_NEAR(to_double(held.gain), 2 * 80 / (1 + 80.0 / 4 * T), 1e-9);
}

// If this failed, a slip that gives way within the encoder's step would have a gain, though nothing is known of the
// sum; or one that holds none.
TEST(Quantisation, OfSlipsThatGiveWayWithinAStepIsNotKnown) {
  SlipMotor slips;
  slips.held_gain = 40;
  EXPECT_EQ(quantisation_gain(spring_motor(100), slips, plain_loop(T)), 140);
  slips.slides_within_step = true;
  EXPECT_FALSE(quantisation_gain(spring_motor(100), slips, plain_loop(T)));
}

}  // namespace
}  // namespace dashpot::compiler
