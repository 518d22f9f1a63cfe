// Springs and slips alone: hysteresis that knows no time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "slip_run.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace dashpot::testing {
namespace {

struct Branch {
  double stiffness;  // K_i [N/m]
  double yield;      // Y_i [N]
};

std::vector<Branch> ten_branches() {
  std::vector<Branch> branches;
  for (int i = 1; i <= 10; ++i) branches.push_back({100.0 + 37 * i, 0.1 * i});
  return branches;
}

compiler::Network maxwell_slip(const std::vector<Branch>& branches) {
  std::string text;
  for (const Branch& branch : branches)
    text += fmt::format("{}{{\"series\": [{{\"spring\": {}}}, {{\"slip\": {}}}]}}", text.empty() ? "" : ", ",
                        branch.stiffness, branch.yield);
  return written_network(fmt::format("{{\"parallel\": [{}]}}", text));
}

// Sliding parts within sliding parts, of springs and slips only.
std::vector<std::string> coupled_networks() {
  return {
      R"({"series": [{"spring": 300}, {"parallel": [{"slip": 1}, {"series": [{"spring": 200}, {"slip": 2}]}]}]})",
      R"({"series": [{"spring": 500}, {"slip": 3}, {"parallel": [{"slip": 0.5}, {"spring": 80}, {"series": [{"spring": 150}, {"slip": 0.7}, {"parallel": [{"slip": 0.2}, {"spring": 60}]}]}]}]})",
      R"({"parallel": [{"spring": 20}, {"series": [{"parallel": [{"spring": 90}, {"slip": 0.3}]}, {"parallel": [{"spring": 40}, {"slip": 0.8}]}, {"spring": 700}]}]})",
  };
}

std::vector<double> there_and_back(double amplitude, int samples) {
  std::vector<double> motion;
  for (int i = 1; i <= samples; ++i) motion.push_back(amplitude * i / samples);
  for (int i = samples - 1; i >= -samples; --i) motion.push_back(amplitude * i / samples);
  for (int i = 1 - samples; i <= samples; ++i) motion.push_back(amplitude * i / samples);
  return motion;
}

}  // namespace

// If this failed, a reversal would not follow the virgin curve at twice the scale.
TEST(RateIndependent, MaxwellSlipObeysMasing) {
  const compiler::Compilation compilation = compiled(maxwell_slip(ten_branches()), compiler::Scheme::exact);
  const auto virgin = [](double u) {
    double force = 0;
    for (const Branch& branch : ten_branches())
      force += std::copysign(std::min(branch.stiffness * std::abs(u), branch.yield), u);
    return force;
  };
  const double amplitude = 0.004;
  WholeForce law(compilation.law);
  int sample = 0;
  for (double u : there_and_back(amplitude, 40)) {
    const double force = law.step(u);
    const double expected = sample < 40    ? virgin(u)
                            : sample < 120 ? virgin(amplitude) - 2 * virgin((amplitude - u) / 2)
                                           : -virgin(amplitude) + 2 * virgin((amplitude + u) / 2);
    EXPECT_NEAR(force, expected, 1e-13 * virgin(1)) << "sample " << sample;
    ++sample;
  }
}

// If this failed, a cycle would lose another energy than Σ 4 Y_i (A − Y_i/K_i)⁺. Trapezia are exact but where a branch
// yields between two samples: their error falls with the square of the step.
TEST(RateIndependent, MaxwellSlipLosesTheKnownEnergyACycle) {
  const double amplitude = 0.004;
  double expected = 0;
  for (const Branch& branch : ten_branches())
    expected += 4 * branch.yield * std::max(amplitude - branch.yield / branch.stiffness, 0.0);
  const compiler::Compilation compilation = compiled(maxwell_slip(ten_branches()), compiler::Scheme::exact);
  std::vector<double> errors;
  for (int samples : {500, 2000}) {
    WholeForce law(compilation.law);
    double loss = 0, last_force = 0, last = 0;
    int sample = 0;
    for (double u : there_and_back(amplitude, samples)) {
      const double force = law.step(u);
      if (sample++ >= samples) loss += (force + last_force) / 2 * (u - last);
      last_force = force;
      last = u;
    }
    errors.push_back(std::abs(loss - expected) / expected);
  }
  // Ten corners a half cycle, each within K (step)²/2: K·step² ≈ 470·(8e-6)² of 0.05 J.
  EXPECT_LT(errors[0], 1e-5);
  EXPECT_LT(errors[1], errors[0] / 4);
}

// If this failed, a spring with a slip would depend on how often a piecewise-linear motion is sampled: it is the play
// operator, exact.
TEST(RateIndependent, SpringWithSlipIsThePlayOperator) {
  const compiler::Network network = written_network(R"({"series": [{"spring": 250}, {"slip": 0.75}]})");
  const compiler::Compilation compilation = compiled(network, compiler::Scheme::exact);
  const std::vector<double> motion = random_motion(network, 3, 500);
  WholeForce coarse(compilation.law), fine(compilation.law);
  double slider = 0, last = 0;
  for (double u : motion) {
    slider = std::clamp(slider, u - 0.75 / 250, u + 0.75 / 250);
    for (int i = 1; i < 8; ++i) fine.step(last + (u - last) * i / 8);
    const double force = coarse.step(u);
    // A sample adds a roundoff of K u to the state at most; sliding forgets them.
    const double rounding = 500 * 0x1p-52 * (0.75 + 250 * std::abs(u));
    EXPECT_NEAR(force, 250 * (u - slider), rounding);
    EXPECT_NEAR(force, fine.step(u), 8 * rounding);
    last = u;
  }
}

// If this failed, states that are forces would drift over many closed cycles.
TEST(RateIndependent, CoupledSlipsDoNotDrift) {
  for (const std::string& text : coupled_networks()) {
    const compiler::Compilation compilation = compiled(written_network(text), compiler::Scheme::exact);
    ASSERT_GT(most_coupled(compilation), 1u);
    WholeForce law(compilation.law);
    const std::vector<double> cycle = {0.0031,  0.0107,  0.0193,  0.0112,  0.0161,
                                       -0.0033, -0.0147, -0.0011, -0.0093, 0.0007};
    std::vector<double> first;
    double scale = 0;
    for (std::size_t i = 0; i < repetitions(10000, 1000000); ++i) {
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        const double force = law.step(cycle[k]);
        scale = std::max(scale, std::abs(force));
        if (i == 1) first.push_back(force);
        if (i > 1) {
          ASSERT_NEAR(force, first[k], 1e-9 * scale) << "cycle " << i << " of " << text;
        }
      }
    }
  }
}

}  // namespace dashpot::testing
