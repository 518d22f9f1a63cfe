// The paper's printed update laws, written out as printed but for the index of their inputs: theory, section 3, takes
// them at k where the paper, for one sample of loop delay, takes them at k − 1.
#include <gtest/gtest.h>

#include <cmath>

#include "emitted_laws.hpp"
#include "motion.hpp"
#include "support/random.hpp"

namespace dashpot::responses::printed_laws_test {
namespace {

constexpr double period = 1e-3;  // Δt [s]

// A motion and a velocity that has nothing to do with it: the laws must agree for any estimate.
std::vector<Sample> unrelated_samples(std::uint64_t seed) {
  testing::Random random(seed);
  std::vector<Sample> samples;
  double position = 0;
  for (int k = 0; k < 2000; ++k) {
    position += random.uniform(-1e-3, 1e-3);
    samples.push_back({position, random.uniform(-0.5, 0.5)});
  }
  return samples;
}

// Fails to 1e-13 of the largest force where `printed(u, v)` is not the felt force b v + m of the emitted law.
template <class Printed>
void expect_same_force(const std::string& variant, const std::string& network, Printed printed) {
  const std::shared_ptr<Model> model = law_of(variant, network).make();
  model->reset(0);
  double largest = 0, off = 0;
  for (const Sample& sample : unrelated_samples(6)) {
    const double force = printed(sample.position, sample.velocity);
    const Command now = model->step(sample.position, sample.velocity);
    largest = std::max(largest, std::abs(force));
    off = std::max(off, std::abs(felt_force(now, sample.velocity) - force));
  }
  EXPECT_LE(off, 1e-13 * largest) << variant << "/" << network;
}

// Fails if `position` driven backward Euler is not the paper's law for the spring at the tool: (13), then (15) read as
// K(u − x_k).
TEST(PrintedLaws, OfFigure4aIsThePositionDrivenOne) {
  constexpr double K = 50, B = 5;
  double x = 0;
  expect_same_force("euler_position", "maxwell_spring_at_tool", [&](double u, double) {
    x = (K * u + B / period * x) / (K + B / period);
    return K * (u - x);
  });
}

// Fails if `velocity` driven backward Euler is not the paper's law for the damper at the tool, (17) and (19), or if
// `nodal`, whose observer is that damper, is another.
TEST(PrintedLaws, OfFigure4bIsTheVelocityDrivenAndTheNodalOne) {
  constexpr double K = 50, B = 5;
  for (const char* variant : {"euler_velocity", "euler_nodal"}) {
    double x = 0;
    expect_same_force(variant, "maxwell_damper_at_tool", [&](double, double v) {
      const double before = x;
      x = (B * v + B / period * x) / (K + B / period);
      return B * (v - (x - before) / period);
    });
  }
}

// Fails if the second-order model is not the sum of its branches, each by (17) and (19), and its spring.
TEST(PrintedLaws, OfBranchesAddUp) {
  constexpr double K[] = {12, 10}, B[] = {5, 6}, K3 = 5;
  for (const char* variant : {"euler_velocity", "euler_nodal"}) {
    double x[] = {0, 0};
    expect_same_force(variant, "second_order_maxwell", [&](double u, double v) {
      double force = K3 * u;
      for (int i = 0; i < 2; ++i) {
        const double before = x[i];
        x[i] = (B[i] * v + B[i] / period * x[i]) / (K[i] + B[i] / period);
        force += B[i] * (v - (x[i] - before) / period);
      }
      return force;
    });
  }
}

// Fails if `nodal` is not the paper's generalised Kelvin model, (10) and (11), whose element 1, next to the tool, is
// the observer: of networks/paper/generalised_kelvin_two.json it is the one with B/K² larger.
TEST(PrintedLaws, OfFigure3IsTheNodalOne) {
  constexpr double K1 = 80, B1 = 6, K2 = 200, B2 = 4;
  static_assert(B1 / (K1 * K1) > B2 / (K2 * K2));
  double x = 0;
  expect_same_force("euler_nodal", "generalised_kelvin_two", [&](double u, double v) {
    const double before = x;
    x = (K1 * u + B1 * v + (B1 + B2) / period * x) / (K1 + K2 + (B1 + B2) / period);
    return K1 * (u - x) + B1 * (v - (x - before) / period);
  });
}

// Fails if the three drives differ when the velocity is the backward difference of the positions, where they are one
// law.
TEST(PrintedLaws, CoincideForTheBackwardDifference) {
  for (const EmittedLaw& reference : laws_of_variant("euler_nodal"))
    for (const char* variant : {"euler_position", "euler_velocity"}) {
      const EmittedLaw& law = law_of(variant, reference.network);
      const std::shared_ptr<Model> one = reference.make(), other = law.make();
      double largest = 0, off = 0;
      for (const Sample& sample : samples_of(random_motion(7, 60), period)) {
        const Command first = one->step(sample.position, sample.velocity);
        const Command second = other->step(sample.position, sample.velocity);
        largest = std::max({largest, std::abs(first.force), first.damping * std::abs(sample.velocity)});
        off = std::max(off, std::abs(felt_force(first, sample.velocity) - felt_force(second, sample.velocity)));
      }
      EXPECT_LE(off, 1e-13 * largest) << law.title();
    }
}

// Fails if `nodal` is taken for one of the other two where both a spring and a damper join the tool to an inner node.
TEST(PrintedLaws, DifferForTwoKelvinElementsAndAnEstimate) {
  const std::shared_ptr<Model> nodal = law_of("euler_nodal", "generalised_kelvin_two").make();
  const std::shared_ptr<Model> position = law_of("euler_position", "generalised_kelvin_two").make();
  const std::shared_ptr<Model> velocity = law_of("euler_velocity", "generalised_kelvin_two").make();
  double off_position = 0, off_velocity = 0;
  for (const Sample& sample : unrelated_samples(8)) {
    const double force = nodal->step(sample.position, sample.velocity).force;
    off_position = std::max(off_position, std::abs(position->step(sample.position, sample.velocity).force - force));
    off_velocity = std::max(off_velocity, std::abs(velocity->step(sample.position, sample.velocity).force - force));
  }
  EXPECT_GT(off_position, 1e-3);
  EXPECT_GT(off_velocity, 1e-3);
}

}  // namespace
}  // namespace dashpot::responses::printed_laws_test
