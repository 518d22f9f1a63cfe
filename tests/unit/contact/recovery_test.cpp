// What the tissue does while nothing touches it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "slips/element_reference.hpp"
#include "touched.hpp"
#include "discretise/discretise.hpp"

namespace dashpot::testing {
namespace {

// Pressed in, left within 10 ms, touched again 30 ms later while the surface is still on its way back.
double pressed_twice(double t) {
  if (t < 0.05) return 0.004 * std::sin(std::numbers::pi * t / 0.1);
  if (t < 0.06) return 0.004 - 0.006 * (t - 0.05) / 0.01;
  if (t < 0.09) return -0.002;
  return -0.002 + 0.008 * std::min((t - 0.09) / 0.04, 1.0);
}

const char* const zener =
    R"({"parallel": [{"spring": 200}, {"damper": 2}, {"series": [{"damper": 5}, {"spring": 300}]}]})";
const char* const with_slip =
    R"({"parallel": [{"damper": 2}, {"series": [{"spring": 900}, {"slip": 1}]}, {"series": [{"damper": 5}, {"spring": 300}]}, {"spring": 150}]})";

constexpr int milliseconds = 140, out = 65;  // in the second, nothing touches

std::vector<double> forces_of_elements(const compiler::Network& network, int samples_a_millisecond) {
  ElementReference reference(network, 1e-3 / samples_a_millisecond);
  std::vector<double> forces;
  for (int k = 1; k <= milliseconds * samples_a_millisecond; ++k) {
    const double force = reference.step(pressed_twice(k * 1e-3 / samples_a_millisecond));
    if (k % samples_a_millisecond == 0) forces.push_back(force);
  }
  return forces;
}

std::vector<double> forces_of_law(const compiler::Network& network, int samples_a_millisecond) {
  const compiler::Compilation c = compiled(network, compiler::Scheme::exact);
  const compiler::UpdateLaw law = discretise(c.network, c.form, c.decomposition, {}, 1e3 * samples_a_millisecond);
  TouchedForce run(law);
  std::vector<double> forces;
  for (int k = 1; k <= milliseconds * samples_a_millisecond; ++k) {
    const double force = run.step(pressed_twice(k * 1e-3 / samples_a_millisecond));
    if (k % samples_a_millisecond == 0) forces.push_back(force);
  }
  return forces;
}

}  // namespace

// If this failed, forces at the second touch would not be those of a tissue that has recovered in part. The reference
// are elements at 32 and 64 kHz, extrapolated to steps of none; the law comes closer in proportion to its period, as a
// contact falls anywhere in a sample. In that sample itself the dampers' force jumps, and is left out.
TEST(ContactRecovery, SecondTouchIsThatOfAFineStep) {
  for (const char* structure : {zener, with_slip}) {
    const compiler::Network network = behind_contact(structure, 0);
    const std::vector<double> coarse = forces_of_elements(network, 32), fine = forces_of_elements(network, 64);
    std::size_t touch = out;
    while (fine[touch] == 0) ++touch;
    std::vector<double> errors;
    for (const int rate : {1, 4, 16}) {
      const std::vector<double> forces = forces_of_law(network, rate);
      double worst = 0;
      for (std::size_t k = touch + 2; k < forces.size(); ++k)
        worst = std::max(worst, std::abs(forces[k] - (2 * fine[k] - coarse[k])));
      errors.push_back(worst / *std::max_element(fine.begin(), fine.end()));
    }
    // The surface is met before it has come back to where it was, and the tissue pushes until the end.
    EXPECT_GT(pressed_twice(1e-3 * double(touch + 1)), 1e-4);
    EXPECT_GT(*std::min_element(fine.begin() + std::ptrdiff_t(touch), fine.end()), 0);
    EXPECT_LT(errors[0], 0.05) << structure;
    EXPECT_LT(errors[1], errors[0] / 3) << structure;
    EXPECT_LT(errors[2], errors[1] / 3) << structure;
  }
}

// If this failed, a surface that nothing touches would not come back as its elements do: a Kelvin element by 1/(1 + h
// K/B) a sample.
TEST(ContactRecovery, FreeKelvinComesBackByItself) {
  const compiler::Compilation compilation =
      compiled(behind_contact(R"({"parallel": [{"spring": 500}, {"damper": 5}]})", 0.001), compiler::Scheme::exact);
  TouchedForce law(compilation);
  law.step(0.003);
  EXPECT_EQ(law.surface(), 0.003 - 0.001);
  double expected = law.surface();
  for (int k = 0; k < 200; ++k) {
    EXPECT_EQ(law.step(-1), 0);
    expected /= 1 + slip_period * 500 / 5;
    // Two roundoffs a sample.
    ASSERT_NEAR(law.surface(), expected, 400 * 0x1p-53 * expected);
  }
}

// If this failed, reset() would not load the static spring where the tool is, or leave the tissue pressed where it is
// not.
TEST(ContactRecovery, ResetsToRest) {
  for (const char* structure : {zener, with_slip}) {
    const double stiffness = structure == zener ? 200 : 150;
    const compiler::Compilation compilation = compiled(behind_contact(structure, 0.002), compiler::Scheme::exact);
    compiler::Evaluation<double> law(compilation.law);
    law.step(0.009, 1);
    law.reset(0.005);
    EXPECT_NEAR(law.stored_energy(), stiffness / 2 * 0.003 * 0.003, 1e-15);
    EXPECT_NEAR(law.step(0.005, 0).force, stiffness * 0.003, 1e-15 * stiffness) << structure;
    law.reset(-0.5);
    EXPECT_EQ(law.stored_energy(), 0);
    EXPECT_EQ(law.step(-0.5, 0).force, 0);
    EXPECT_EQ(law.step(0.001, 0).damping, 0);
  }
}

}  // namespace dashpot::testing
