// Passivity of the split under any delay of the estimate: theory, section 4.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decomposed.hpp"
#include "decompose/spectrum.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;
using std::numbers::pi;

std::vector<double> frequencies(const LinearForm& form, int points_per_decade) {
  std::vector<double> all = {0};
  const double low = form.modes.empty() ? 1 : to_double(form.modes.front().relaxation_rate) * 1e-3;
  const double high = form.modes.empty() ? 1 : to_double(form.modes.back().relaxation_rate) * 1e3;
  for (double w = low; w <= high * 1.0001; w *= std::pow(10, 1.0 / points_per_decade)) all.push_back(w);
  return all;
}

// The least of Re{b + (Z_d − b) G} over frequencies and random estimators in the unit disk, G = −1 … 1 and all delays
// among them.
double margin(const LinearForm& form, double damping, Random& random) {
  double least = damping;
  for (const double w : frequencies(form, 10)) {
    const MotorImpedance motor = motor_impedance(form, damping, StateInput::velocity, w);
    for (int i = 0; i < 16; ++i) {
      const double size = i % 2 == 0 ? 1 : std::sqrt(random.uniform());
      const std::complex<double> estimator = std::polar(size, i == 0 ? pi : random.uniform(0, 2 * pi));
      least = std::min(least, (damping + motor.position_driven + motor.velocity_driven * estimator).real());
    }
  }
  return least;
}

std::string complaint_about_half_viscosity(const Network& network) {
  const LinearForm form = linear_form(network);
  const double viscosity = to_double(zero_frequency_damping(form));
  if (viscosity == 0) return "";
  Random random(network.elements.size());
  // Some dozen terms are summed for each impedance.
  const double rounding = 1e-14 * viscosity;
  if (const double least = margin(form, 0.5 * viscosity, random); least < -rounding)
    return fmt::format("at half the viscosity {} the margin is {}", viscosity, least);
  if (const double least = margin(form, 0.49 * viscosity, random); least >= 0)
    return fmt::format("at 0.49 of the viscosity {} the margin is still {}", viscosity, least);
  return "";
}

NetworkRecipe recipe(Topology topology) {
  NetworkRecipe recipe;
  recipe.topology = topology;
  recipe.most_nodes = 12;
  return recipe;
}

// Fails if half the low-frequency viscosity in the brake is not enough for every estimator with |G| ≤ 1, or if less is.
TEST(Passivity, HalfViscosityTheorem) {
  EXPECT_EQ(first_failure(1, repetitions(60, 1000), recipe(Topology::tree), complaint_about_half_viscosity), "");
  EXPECT_EQ(first_failure(1, repetitions(60, 1000), recipe(Topology::graph), complaint_about_half_viscosity), "");
}

// What must be added so that no estimator on the unit circle makes the split active, tried out one by one.
double needed_damping(const LinearForm& form, double damping, StateInput input, double tolerance) {
  double needed = 0;
  for (const double w : frequencies(form, 100)) {
    const MotorImpedance motor = motor_impedance(form, damping, input, w);
    for (int i = 0; i < 720; ++i) {
      const std::complex<double> rendered =
          (1 - tolerance) * damping + motor.position_driven + motor.velocity_driven * std::polar(1.0, 2 * pi * i / 720);
      needed = std::max(needed, -rendered.real());
    }
  }
  return needed;
}

// Between two of 720 angles a vector loses at most 1 − cos(π/720) < 1e-5 of its length; the frequencies beyond the grid
// add 1e-6 of the scale.
std::string complaint_about_extra_damping(const Network& network) {
  const LinearForm form = linear_form(network);
  const double viscosity = to_double(zero_frequency_damping(form));
  Random random(network.elements.size());
  const double damping = viscosity * random.uniform(0, 1.5), tolerance = random.uniform(0, 0.3);
  const double scale = viscosity + damping;
  for (const StateInput input : {StateInput::position, StateInput::velocity, StateInput::nodal}) {
    const double found = extra_damping_any_delay(form, damping, input, tolerance);
    const double needed = needed_damping(form, damping, input, tolerance);
    if (std::abs(found - needed) > 2e-5 * scale)
      return fmt::format("{} driven with b = {} and ε = {}: {} found, {} needed", name_of(input), damping, tolerance,
                         found, needed);
  }
  return "";
}

// Fails if the extra damping that makes any delay harmless is missed at some frequency, or overstated.
TEST(Passivity, ExtraDampingForAnyDelay) {
  EXPECT_EQ(first_failure(1, repetitions(24, 400), recipe(Topology::tree), complaint_about_extra_damping), "");
  EXPECT_EQ(first_failure(1, repetitions(24, 400), recipe(Topology::graph), complaint_about_extra_damping), "");
}

// Fails if position driven states are not delay-passive exactly when 2b ≥ b∞.
TEST(Passivity, PositionDrivenNeedsHalfTheFeedthrough) {
  const LinearForm kelvin = linear_form(written_network(R"({ "parallel": [ { "spring": 1000 }, { "damper": 10 } ] })"));
  EXPECT_EQ(extra_damping_any_delay(kelvin, 5, StateInput::position, 0), 0);
  EXPECT_NEAR(extra_damping_any_delay(kelvin, 4, StateInput::position, 0), 2, 1e-14);
}

std::string complaint_about_negative_damping(const Network& network) {
  const Decomposed all = decomposed(network);
  for (const Candidate& candidate : all.result->candidates)
    if (!(candidate.damping >= 0)) return fmt::format("{} asks for {}", candidate.name, candidate.damping);
  const double viscosity = to_double(zero_frequency_damping(all.form));
  if (all["quietest-passive"].damping < 0.5 * viscosity) return "quietest-passive is below half the viscosity";
  if (all["quietest-passive"].extra_damping_any_delay.value() > 1e-12 * viscosity)
    return "quietest-passive is not passive";
  if (all["velocity-free"].velocity_gain != 0) return "velocity-free takes a velocity";
  if (all["zero-frequency"].damping != viscosity) return "zero-frequency is not the viscosity";
  if (all["largest-observer"].damping < all["paper"].damping) return "largest-observer is not the largest";
  return "";
}

// Fails if any candidate of any network is one that a brake cannot make, or lacks the property that it is named for.
TEST(Passivity, CandidatesKeepTheirPromises) {
  EXPECT_EQ(first_failure(1, repetitions(60, 1000), recipe(Topology::tree), complaint_about_negative_damping), "");
  EXPECT_EQ(first_failure(1, repetitions(60, 1000), recipe(Topology::graph), complaint_about_negative_damping), "");
}

}  // namespace
