// The canonical form against 60-digit elimination of K + sB: theory, section 2.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "linear/linear_form.hpp"
#include "support/exact_oracle.hpp"
#include "support/random.hpp"
#include "support/shrink.hpp"

namespace {

using namespace dashpot::testing;
using namespace dashpot::compiler;

// Of D(jω), with the constants of the form as they are emitted: rounded to double.
double relative_error(const LinearForm& form, const Network& network, const Exact& w) {
  ExactComplex d{to_double(form.static_stiffness), w * Exact(to_double(form.feedthrough_damping))};
  for (const Mode& mode : form.modes) {
    const Exact rate = to_double(mode.relaxation_rate);
    const ExactComplex drive{0, w * Exact(to_double(mode.stiffness))};
    d = d + drive / ExactComplex{rate, w};
  }
  const ExactComplex exact = dynamic_stiffness_by_elimination(network, w);
  return (magnitude(d - exact) / magnitude(exact)).convert_to<double>();
}

bool is_canonical(const LinearForm& form) {
  bool good = form.static_stiffness >= 0 && form.feedthrough_damping >= 0;
  for (std::size_t i = 0; i < form.modes.size(); ++i) {
    good = good && form.modes[i].stiffness > 0 && form.modes[i].relaxation_rate > 0;
    good = good && (i == 0 || form.modes[i - 1].relaxation_rate < form.modes[i].relaxation_rate);
  }
  return good;
}

// At one frequency in each of ten decades, other frequencies for other networks.
std::string complaint_about(const Network& network) {
  const LinearForm form = linear_form(network);
  if (!is_canonical(form)) return "not canonical:\n" + to_text(form, network);
  Random random(network.elements.size());
  for (int decade = -5; decade < 5; ++decade) {
    const double w = std::pow(10, decade + random.uniform());
    if (const double error = relative_error(form, network, w); error > 1e-12)
      return fmt::format("D(jω) at {} rad/s is off by {:.2g}", w, error);
  }
  return "";
}

NetworkRecipe recipe(Topology topology) {
  NetworkRecipe recipe;
  recipe.topology = topology;
  return recipe;
}

// Fails if any tree of up to 30 nodes with values over 8 decades has another dynamic stiffness than its canonical form.
TEST(Elimination, AgreesWithTheModesOfTrees) {
  EXPECT_EQ(first_failure(1, repetitions(90, 5000), recipe(Topology::tree), complaint_about), "");
}

// Fails if any graph, bridges and meshes included, has another dynamic stiffness than its canonical form.
TEST(Elimination, AgreesWithTheModesOfGraphs) {
  EXPECT_EQ(first_failure(1, repetitions(90, 5000), recipe(Topology::graph), complaint_about), "");
}

// D(0) is what is left of the springs without the dampers, D(jω)/jω for ω → ∞ what is left of the dampers.
std::string complaint_about_limits(const Network& network) {
  const LinearForm form = linear_form(network);
  // The other kind of element removed: what is left is one spring or one damper.
  const auto alone = [&](auto is_kept) {
    Network rest = network;
    std::erase_if(rest.elements, [&](const Element& e) { return !is_kept(e); });
    return tidy(rest) ? magnitude(dynamic_stiffness_by_elimination(rest, Exact(1))) : Exact(0);
  };
  const Exact springs = alone([](const Element& e) { return std::holds_alternative<Spring>(e.law); });
  const Exact dampers = alone([](const Element& e) { return std::holds_alternative<Damper>(e.law); });
  if (abs(Exact(form.static_stiffness) - springs) > Exact("1e-12") * springs)
    return fmt::format("k0 is {}, not {}", to_double(form.static_stiffness), springs.convert_to<double>());
  if (abs(Exact(form.feedthrough_damping) - dampers) > Exact("1e-12") * dampers)
    return fmt::format("b∞ is {}, not {}", to_double(form.feedthrough_damping), dampers.convert_to<double>());
  return "";
}

// Fails if k0 or b∞ loses digits to cancellation, or is not exactly zero where no path of springs or of dampers exists.
TEST(Elimination, AgreesWithK0AndFeedthrough) {
  EXPECT_EQ(first_failure(20001, repetitions(90, 2000), recipe(Topology::tree), complaint_about_limits), "");
  EXPECT_EQ(first_failure(20001, repetitions(90, 2000), recipe(Topology::graph), complaint_about_limits), "");
}

}  // namespace
