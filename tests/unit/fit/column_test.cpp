// Unit columns against closed forms, and what holds between them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/floor.hpp"
#include "fit/non_negative.hpp"
#include "fit/projection.hpp"
#include "synthetic.hpp"

namespace dashpot::compiler::fitting {
namespace {

Recording ramp(double rate, double period, int rows) {
  Recording recording;
  for (int i = 0; i <= rows; ++i) {
    recording.time.push_back(i * period);
    recording.position.push_back(rate * i * period);
  }
  recording.force.assign(recording.time.size(), 0.0);
  return recording;
}

Recording wandering() {
  Recording recording = ramp(0, 0, 0);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 400; ++i) {
    recording.time.push_back(recording.time.back() + 0.01 * std::exp(2 * uniform(random)));
    recording.position.push_back(recording.position.back() + 1e-3 * uniform(random));
  }
  recording.force.assign(recording.time.size(), 0.0);
  return recording;
}

Eigen::VectorXd column(const Recording& recording, const Term& term, Form form = Form::stiffness) {
  return unit_column(signal_of(recording, 0, form, {1e-3, 1e3}), term);
}

// Fails if a Maxwell element is not exact for a ramp: f = r τ (1 − e^{−t/τ}), to rounding.
TEST(Column, MaxwellOnARamp) {
  const Recording recording = ramp(0.01, 0.003, 500);
  for (const double time : {1e-4, 0.02, 1.0, 1e5}) {
    const Eigen::VectorXd force = column(recording, {TermKind::maxwell, time, 0, 0, 0});
    for (std::size_t i = 0; i < recording.time.size(); ++i)
      EXPECT_NEAR(force[static_cast<Eigen::Index>(i)], -0.01 * time * std::expm1(-recording.time[i] / time), 1e-14);
  }
}

// Fails if the derivatives that the search follows are not those of the columns: 1e-6 is the error of the differences.
TEST(Column, SlopesAreDerivatives) {
  const Recording recording = wandering();
  const Signal signal = signal_of(recording, 0, Form::stiffness, {1e-3, 1e3});
  constexpr double reach = 1e-5;
  for (const double time : {0.003, 0.05, 2.0}) {
    const Eigen::VectorXd slope = column_slope(signal, {TermKind::maxwell, time, 0, 0, 0}, Shape::time);
    const Eigen::VectorXd difference = (column(recording, {TermKind::maxwell, time * std::exp(reach), 0, 0, 0}) -
                                        column(recording, {TermKind::maxwell, time * std::exp(-reach), 0, 0, 0})) /
                                       (2 * reach);
    EXPECT_LE((slope - difference).cwiseAbs().maxCoeff(), 1e-6 * slope.cwiseAbs().maxCoeff());
  }
  for (const double threshold : {5e-4, 3e-3}) {
    const Eigen::VectorXd slope = column_slope(signal, {TermKind::stop, 0, threshold, 0, 0}, Shape::threshold);
    const Eigen::VectorXd difference = (column(recording, {TermKind::stop, 0, threshold * (1 + 1e-9), 0, 0}) -
                                        column(recording, {TermKind::stop, 0, threshold * (1 - 1e-9), 0, 0})) /
                                       2e-9;
    EXPECT_LE((slope - difference).cwiseAbs().maxCoeff(), 1e-5 * slope.cwiseAbs().maxCoeff());
  }
}

// Fails if a slip beside a damper is not the Maxwell element without the slip, and the stop without the damper.
TEST(Column, SlidingSpringBetweenItsLimits) {
  const Recording recording = wandering();
  const Eigen::VectorXd maxwell = column(recording, {TermKind::maxwell, 0.2, 0, 0, 0});
  EXPECT_LE((column(recording, {TermKind::sliding, 0.2, 0, 0, 0}) - maxwell).cwiseAbs().maxCoeff(), 1e-15);
  const Eigen::VectorXd stop = column(recording, {TermKind::stop, 0, 2e-3, 0, 0});
  EXPECT_LE((column(recording, {TermKind::sliding, 1e-12, 2e-3, 0, 0}) - stop).cwiseAbs().maxCoeff(), 1e-12);
  // Beyond the threshold y = s z − d relaxes to v τ: on a ramp z = d + v τ (1 − e^{−(t − t_d)/τ}).
  const Recording steady = ramp(0.01, 0.001, 1000);
  const Eigen::VectorXd sliding = column(steady, {TermKind::sliding, 0.1, 2e-3, 0, 0});
  for (const int row : {100, 200, 300, 900}) {
    const double beyond = std::max(0.0, row * 0.001 - 0.2);
    const double expected = std::min(row * 1e-5, 2e-3) - 0.01 * 0.1 * std::expm1(-beyond / 0.1);
    EXPECT_NEAR(sliding[row], expected, 1e-15);
  }
}

// Fails if the ladder of a springpot is not a springpot: t^(1−β)/Γ(2−β) on a ramp, to the ladder's ripple.
TEST(Column, SpringpotOnARamp) {
  const Recording recording = ramp(1, 0.01, 2000);
  for (const double exponent : {0.1, 0.5, 0.9}) {
    const Eigen::VectorXd force = column(recording, {TermKind::springpot, 0, 0, exponent, 0});
    for (const Eigen::Index row : {10, 100, 1000, 2000}) {
      const double expected = std::pow(0.01 * static_cast<double>(row), 1 - exponent) / std::tgamma(2 - exponent);
      EXPECT_NEAR(force[row], expected, 3e-3 * expected) << exponent << " " << row;
    }
  }
}

// Fails if storage and loss of the unit elements are not Re and Im of jωτ/(1 + jωτ), jω and 1.
TEST(Column, Spectra) {
  Recording recording;
  recording.kind = RecordingKind::frequency;
  recording.time = {0.1, 2, 30};
  recording.force = recording.loss = {1, 1, 1};
  const Eigen::VectorXd maxwell = column(recording, {TermKind::maxwell, 0.5, 0, 0, 0});
  const Eigen::VectorXd damper = column(recording, {TermKind::damper, 0, 0, 0, 0});
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double x = 0.5 * recording.time[static_cast<std::size_t>(i)];
    EXPECT_DOUBLE_EQ(maxwell[i], x * x / (1 + x * x));
    EXPECT_DOUBLE_EQ(maxwell[3 + i], x / (1 + x * x));
    EXPECT_EQ(damper[i], 0);
    EXPECT_EQ(damper[3 + i], recording.time[static_cast<std::size_t>(i)]);
  }
}

// Fails if the compliance form is not the reciprocal: a Kelvin element under the force that moved it, to rounding.
TEST(Column, KelvinElementUnderItsOwnForce) {
  const double stiffness = 200, damping = 30;
  Recording recording = wandering();
  const Recording pushed = [&] {
    Recording r = recording;
    r.force = r.position;  // any force
    return r;
  }();
  const Eigen::VectorXd position =
      column(pushed, {TermKind::maxwell, damping / stiffness, 0, 0, 0}, Form::compliance) / stiffness;
  // K u + B u̇ = f with f linear between rows: u ← a u + (f₋(φ − a) + f(1 − φ))/K.
  const std::vector<double> steps = steps_of(pushed.time);
  const double decay = stiffness / damping;
  double expected = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double h = steps[i], x = decay * h, a = std::exp(-x), phi = -std::expm1(-x) / x;
    expected = a * expected + (pushed.force[i - 1] * (phi - a) + pushed.force[i] * (1 - phi)) / stiffness;
    EXPECT_NEAR(position[static_cast<Eigen::Index>(i)], expected, 1e-15);
  }
}

// Fails if the optimum is not one: gradients of columns without weight must not fall, of columns with weight be zero.
TEST(NonNegative, MeetsTheOptimalityConditions) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd columns(60, 25);
    Eigen::VectorXd target(60);
    for (auto& value : columns.reshaped()) value = normal(random);
    for (auto& value : target) value = normal(random);
    columns.col(7) = columns.col(3);  // two alike
    std::vector<bool> either(25, false);
    either[5] = true;
    const NonNegativeSolution solution = solve_non_negative(columns, target, either);
    const Eigen::VectorXd gradient = columns.transpose() * (target - columns * solution.weights);
    for (Eigen::Index j = 0; j < 25; ++j) {
      EXPECT_TRUE(j == 5 || solution.weights[j] >= 0);
      EXPECT_LE(gradient[j], 1e-9);
      EXPECT_TRUE(gradient[j] >= -1e-9 || (j != 5 && solution.weights[j] == 0));
    }
    const NonNegativeSolution again = solve_non_negative(columns, target, either, solution.weights);
    EXPECT_NEAR(again.residual_sum, solution.residual_sum, 1e-12 * solution.residual_sum);
  }
}

// Fails if the search does not come back to times that were put in, from a factor of three away.
TEST(Projection, FindsTheTimesOfExactData) {
  const Model truth = network_of(100, 3, {{150, 0.05}, {90, 2}});
  const std::vector<Recording> files{answered(truth, 0, Noise::white, 1)};
  const Problem problem(files, Form::stiffness, Weighting::uniform, 1'000'000);
  Model start = network_of(1, 1, {{1, 0.15}, {1, 0.8}});
  const Model found = refined(problem, start, false, {});
  for (std::size_t j = 0; j < truth.terms.size(); ++j) {
    EXPECT_NEAR(found.weights[static_cast<Eigen::Index>(j)] / truth.weights[static_cast<Eigen::Index>(j)], 1, 1e-6);
    EXPECT_NEAR(found.terms[j].time, truth.terms[j].time, 1e-6 * truth.terms[j].time);
  }
}

}  // namespace
}  // namespace dashpot::compiler::fitting
