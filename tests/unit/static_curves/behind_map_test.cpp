// A law behind a static curve, against the network's own equations: solved here by the method of Runge and Kutta.
#include <cmath>
#include <random>

#include "law/evaluate.hpp"
#include "linear/motion_map.hpp"
#include "discretise/tunable_programs.hpp"
#include "lower/begun_at_rest.hpp"
#include "static_case.hpp"
#include "support/repetitions.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

double odd_value(const MotionMap& map, double u) { return std::copysign(map.value_at(std::abs(u)), u); }

// The force of 400 N/m beside a Maxwell element of 200 N/m and 40 N s/m while w goes straight from sample to sample.
class Physics {
 public:
  explicit Physics(const MotionMap& map) : map_(map) {}

  double force_after(double u, double period) {
    const double next = odd_value(map_, u), rate = (next - w_) / period;
    const auto slope = [&](double force) { return 200 * rate - 5 * force; };
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
      const double h = period / steps, k1 = slope(maxwell_), k2 = slope(maxwell_ + h / 2 * k1),
                   k3 = slope(maxwell_ + h / 2 * k2), k4 = slope(maxwell_ + h * k3);
      maxwell_ += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    w_ = next;
    return map_.tangent_at(std::abs(u)) * (400 * w_ + maxwell_);
  }

 private:
  const MotionMap& map_;
  double w_ = 0, maxwell_ = 0;
};

TEST(BehindMap, AgreesWithTheEquationsOfMotion) {
  Choices choices;
  choices.decomposition = 0.0;
  for (const char* curve : {hertz, exponential, table}) {
    const Compilation c = compiled(behind(curve), choices);
    Evaluation<double> law(c.law);
    law.reset(0);
    Physics physics(*c.network.map);
    double furthest = 0, largest = 0;
    for (int k = 0; k < 2000; ++k) {
      const double u = 4e-3 * std::sin(0.011 * k) + 2e-3 * std::sin(0.137 * k);
      const double force = law.step(u, 0).force, expected = physics.force_after(u, 1e-3);
      furthest = std::max(furthest, std::abs(force - expected));
      largest = std::max(largest, std::abs(expected));
    }
    EXPECT_LT(furthest, 1e-9 * largest) << curve;
  }
}

// f(t) = f_e(u) G(t)/k after a step, whatever the curve: what a relaxation test sees.
TEST(BehindMap, RelaxesLikeTheNetworkToTheCurve) {
  Choices choices;
  choices.decomposition = 0.0;
  for (const char* curve : {hertz, exponential, table}) {
    const Compilation c = compiled(behind(curve), choices);
    for (const double u : {-4e-3, 1e-3, 4.5e-3}) {
      Evaluation<double> law(c.law);
      law.reset(0);
      const double rest = std::copysign(to_double(force_at(*c.network.static_curve, std::abs(u))), u);
      const double within = 200 * (1 - std::exp(-5e-3)) / 5e-3;  // a ramp of one sample
      for (int k = 0; k < 1500; ++k) {
        const double expected = rest * (1 + within / 400 * std::exp(-5e-3 * k));
        // The error is of the largest force, 2 N, and relaxation makes up to half as much of it again.
        EXPECT_NEAR(law.step(u, 0).force, expected, 2 * 1.5 * c.network.map->static_error) << curve << k;
      }
    }
  }
}

// A damper of the network is felt as w′² of it, whoever makes it.
TEST(BehindMap, BrakeFollowsTheSquareOfTheTangent) {
  const std::string network = R"({ "parallel": [ { "spring": "400 N/m" }, { "damper": "3 N s/m" } ] })";
  Choices motor_alone;
  motor_alone.decomposition = 0.0;
  const Compilation by_brake = compiled(behind(hertz, "", network)),
                    by_motor = compiled(behind(hertz, "", network), motor_alone);
  const MotionMap& map = *by_brake.network.map;
  for (double u = -6e-3; u < 6e-3; u += 0.31e-3) {
    Evaluation<double> brake(by_brake.law), motor(by_motor.law);
    brake.reset(u);
    motor.reset(u);
    const double square = map.tangent_at(std::abs(u)) * map.tangent_at(std::abs(u));
    const command<double> shared = brake.step(u, 0.2), alone = motor.step(u, 0.2);
    EXPECT_NEAR(shared.damping, 3 * square, 1e-12);
    EXPECT_EQ(alone.damping, 0);
    EXPECT_NEAR(alone.force - shared.force, 3 * square * 0.2, 1e-12);
  }
}

// Around a closed path a spring behind a map gives nothing: w and w′ are one function and its derivative.
TEST(BehindMap, SpringGivesBackWhatItTook) {
  for (const char* curve : {hertz, exponential, table}) {
    const Compilation c = compiled(behind(curve, "", R"({ "spring": "400 N/m" })"));
    const auto work = [&](int steps) {
      Evaluation<double> law(c.law);
      law.reset(0);
      double sum = 0, last = 0, before = 0;
      for (int k = 1; k <= steps; ++k) {
        const double u = 5e-3 * std::sin(2 * M_PI * k / steps), force = law.step(u, 0).force;
        sum += (force + before) / 2 * (u - last);
        last = u;
        before = force;
      }
      return sum;
    };
    EXPECT_LT(std::abs(work(20'000)), 1e-9) << curve;
  }
}

TEST(BehindMap, ContactPushesFromItsSurfaceOnAndNeverPulls) {
  const Compilation c = compiled(behind(table, R"(, "contact": { "at": "2 mm" })"));
  Evaluation<double> law(c.law);
  law.reset(0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-3e-3, 8e-3);
  double u = 0;
  for (int k = 0; k < 20'000; ++k) {
    u += 0.05 * (place(random) - u);
    const command<double> now = law.step(u, 0);
    EXPECT_GE(now.force, 0);
    if (u < 2e-3) {
      EXPECT_EQ(now.force, 0) << u;
    }
  }
  law.reset(5e-3);
  EXPECT_NEAR(law.step(5e-3, 0).force, 0.9, 1e-3) << "3 mm beyond the surface";
}

std::string behind_hertz(std::string network) {
  return network.insert(network.find('{') + 1,
                        R"( "static": { "power": 1.5, "force": "2 N", "at": "5 mm", "is": "instantaneous" },)");
}

VariableId local_of(const UpdateLaw& law, const char* name) {
  for (const Variable& variable : law.variables)
    if (variable.role == Role::local && variable.name == name) return law.variables.id_of(variable);
  throw std::logic_error(name);
}

// Fails if with parameters that change a law behind a map is in any bit, or in its energy, another one than the same
// law of w, as f = w′ F and b = w′² B.
void expect_same_law_of_w(std::uint64_t seed, const TunableLaw& curved, const TunableLaw& bare) {
  UpdateLaw told_of_map = bare.law();
  told_of_map.tunable->head.map = curved.law().tunable->head.map;
  told_of_map = begun_at_rest(with_programs(std::move(told_of_map)));
  Evaluation<double> law(curved.law()), of_w(told_of_map);
  const MotionMap& map = *curved.compilation().network.map;
  const VariableId tangent = local_of(curved.law(), "tangent"), start = curved.law().started_at;
  Random random(seed);
  std::vector<double> values = curved.defaults();
  int n = 0;
  for (const double u : random_walk(random, 300)) {
    if (random.chance(0.03)) {
      law.reset(u);
      of_w.reset(law.value_of(start));
    }
    if (random.chance(0.3)) {
      values = next_values(curved.tunables(), values, random);
      ASSERT_EQ(law.set(values), of_w.set(values)) << "seed " << seed << ", sample " << n;
    }
    const command<double> now = law.step(u, 0.1);
    const double w = law.value_of(curved.law().mapped), steepness = law.value_of(tangent);
    ASSERT_NEAR(w, odd_value(map, u), 1e-13 * std::abs(w));
    const command<double> expected = of_w.step(w, steepness * 0.1);
    ASSERT_EQ(now.force, steepness * expected.force) << "seed " << seed << ", sample " << n;
    ASSERT_EQ(now.damping, steepness * steepness * expected.damping) << "seed " << seed << ", sample " << n;
    ASSERT_EQ(law.stored_energy(), of_w.stored_energy()) << "seed " << seed << ", sample " << n;
    ++n;
  }
}

TEST(BehindMap, FollowsChangingParameters) {
  int tried = 0;
  for (const Kind kind : {Kind::parallel_branches, Kind::tree, Kind::graph, Kind::touched, Kind::slips})
    for (std::uint64_t seed = 1; seed <= repetitions(3, 200); ++seed) {
      const std::string network = tunable_network(seed, kind);
      Choices choices;
      if (kind == Kind::slips) choices.decomposition = 0.0;
      std::optional<TunableLaw> curved;
      try {
        curved.emplace(behind_hertz(network), choices);
      } catch (const std::runtime_error& refusal) {
        EXPECT_NE(std::string(refusal.what()).find("static-without-springs"), std::string::npos) << refusal.what();
        continue;
      }
      ++tried;
      expect_same_law_of_w(seed, *curved, TunableLaw(network, choices));
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(tried, 10);
}

TEST(BehindMap, AcceptsEveryPositionAndKeepsEverySample) {
  const Compilation c = compiled(behind(hertz));
  Evaluation<double> law(c.law);
  law.reset(1e-3);
  const double before = law.step(1e-3, 0).force;
  for (const double bad : {NAN, INFINITY, -INFINITY}) EXPECT_EQ(law.step(bad, 0).force, 0);
  EXPECT_NEAR(law.step(1e-3, 0).force, before, 1e-12);
  EXPECT_TRUE(std::isfinite(law.step(1.0, 0).force)) << "far beyond the last cubic";
}

}  // namespace
}  // namespace dashpot::testing
