// Maxwell elements in parallel and Kelvin elements in series: two forms of one network.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "linear/linear_form.hpp"
#include "support/exact_oracle.hpp"
#include "support/shrink.hpp"
#include "support/written_network.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

const Real allowed{"1e-12"};

bool agree(const Real& x, const Real& y) { return abs(x - y) <= allowed * abs(y); }

std::string difference(const LinearForm& found, const LinearForm& expected) {
  if (!agree(found.static_stiffness, expected.static_stiffness)) return "k0";
  if (!agree(found.feedthrough_damping, expected.feedthrough_damping)) return "b∞";
  if (found.modes.size() != expected.modes.size())
    return fmt::format("{} modes, not {}", found.modes.size(), expected.modes.size());
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    if (!agree(found.modes[i].stiffness, expected.modes[i].stiffness)) return fmt::format("stiffness of mode {}", i);
    if (!agree(found.modes[i].relaxation_rate, expected.modes[i].relaxation_rate))
      return fmt::format("rate of mode {}", i);
  }
  return "";
}

std::string complaint_about_round_trip(const Network& network) {
  const LinearForm form = linear_form(network);
  return difference(linear_form(kelvin_form(form)), form);
}

std::string complaint_about_reciprocal(const Network& network) {
  const LinearForm form = linear_form(network);
  return difference(reciprocal(reciprocal(form)), form);
}

ExactComplex compliance(const KelvinForm& form, const Exact& w) {
  ExactComplex sum{Exact(form.glass_compliance), -Exact(form.fluidity) / w};
  for (const KelvinElement& element : form.elements)
    sum = sum + ExactComplex{1, 0} / ExactComplex{Exact(element.stiffness), w * Exact(element.damping)};
  return sum;
}

std::string complaint_about_compliance(const Network& network) {
  const KelvinForm form = kelvin_form(linear_form(network));
  for (int decade = -5; decade <= 5; ++decade) {
    const Exact w = pow(Exact(10), decade);
    const ExactComplex product = compliance(form, w) * dynamic_stiffness_by_elimination(network, w);
    const double error = magnitude(product - ExactComplex{1, 0}).convert_to<double>();
    if (error > 1e-12) return fmt::format("compliance at 1e{} rad/s is off by {:.2g}", decade, error);
  }
  return "";
}

NetworkRecipe graphs() {
  NetworkRecipe recipe;
  recipe.topology = Topology::graph;
  return recipe;
}

// Fails if going to the generalised Kelvin form and back changes a parameter by more than 1e-12.
TEST(Interconversion, ReturnsToTheMaxwellForm) {
  EXPECT_EQ(first_failure(1, repetitions(90, 2000), {}, complaint_about_round_trip), "");
  EXPECT_EQ(first_failure(1, repetitions(90, 2000), graphs(), complaint_about_round_trip), "");
}

// Fails if s/D(s), taken twice, is not D(s).
TEST(Interconversion, ReciprocalIsItsOwnInverse) {
  EXPECT_EQ(first_failure(3001, repetitions(90, 2000), {}, complaint_about_reciprocal), "");
  EXPECT_EQ(first_failure(3001, repetitions(90, 2000), graphs(), complaint_about_reciprocal), "");
}

// Fails if the Kelvin elements in series do not yield as the network does.
TEST(Interconversion, KelvinFormHasTheComplianceOfTheNetwork) {
  EXPECT_EQ(first_failure(6001, repetitions(90, 2000), {}, complaint_about_compliance), "");
  EXPECT_EQ(first_failure(6001, repetitions(90, 2000), graphs(), complaint_about_compliance), "");
}

// Fails if Kelvin elements written in series are not found again: K and B of each, the lone spring, the lone damper.
TEST(Interconversion, FindsTheKelvinElementsAgain) {
  const KelvinForm form = kelvin_form(linear_form(written_network(R"({ "series": [
      { "parallel": [ { "spring": 1000 }, { "damper": 10 } ] },
      { "parallel": [ { "spring": 1 }, { "damper": 0.5 } ] },
      { "spring": 4 }, { "damper": 8 } ] })")));
  ASSERT_EQ(form.elements.size(), 2u);
  EXPECT_TRUE(agree(form.glass_compliance, Real(1) / 4));
  EXPECT_TRUE(agree(form.fluidity, Real(1) / 8));
  EXPECT_TRUE(agree(form.elements[0].stiffness, 1) && agree(form.elements[0].damping, Real(1) / 2));
  EXPECT_TRUE(agree(form.elements[1].stiffness, 1000) && agree(form.elements[1].damping, 10));
}

}  // namespace
