// Slips outside trees: linear parts that they join keep their exact modes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "linear/validity.hpp"
#include "slip_run.hpp"
#include "support/written_network.hpp"
#include "discretise/discretise.hpp"

namespace dashpot::testing {
namespace {

// A bridge whose middle is a slip; every arm relaxes.
std::string bridge(const std::string& middle) {
  return R"([
    {"spring": 120, "nodes": ["tool", "left"]}, {"damper": 3, "nodes": ["tool", "right"]},
    {"damper": 5, "nodes": ["left", "far"]}, {"spring": 60, "nodes": ["far", "right"]}, {"damper": 2, "nodes": ["far", "ground"]},
    {"damper": 8, "nodes": ["left", "ground"]}, {"spring": 90, "nodes": ["right", "ground"]})" +
         middle + "]";
}

// Of two laws at this rate, over the largest force.
double largest_difference(const compiler::Network& one, const compiler::Network& other, int samples_a_millisecond) {
  const auto forces = [&](const compiler::Network& network) {
    const compiler::Compilation c = compiled(network, compiler::Scheme::exact);
    const compiler::UpdateLaw law = discretise(c.network, c.form, c.decomposition, {}, 1e3 * samples_a_millisecond);
    compiler::Evaluation<double> run(law);
    std::vector<double> all;
    double last = 0;
    for (int k = 1; k <= 500 * samples_a_millisecond; ++k) {
      const double t = double(k) / samples_a_millisecond, u = 0.01 * std::sin(0.004 * t) + 0.002 * std::sin(0.07 * t);
      const double velocity = (u - last) / law.sample_period;
      const auto [damping, force] = run.step(u, velocity);
      if (k % samples_a_millisecond == 0) all.push_back(damping * velocity + force);
      last = u;
    }
    return all;
  };
  const std::vector<double> first = forces(one), second = forces(other);
  double worst = 0, scale = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    worst = std::max(worst, std::abs(first[k] - second[k]));
    scale = std::max(scale, std::abs(second[k]));
  }
  return worst / scale;
}

}  // namespace

// If this failed, modes at several terminals would relax at other rates, or pull at other nodes: with a slip that never
// yields the bridge is that with both nodes in one, and with one that always does it is that without. Ends of slips
// move linearly within a sample, inner nodes of a linear part as they have to: the two come together with the period.
TEST(SlipOutsideTree, BecomesTheLinearNetworkAtBothLimits) {
  const compiler::Network held = written_network(bridge(R"(, {"slip": 1e6, "nodes": ["left", "right"]})"));
  ASSERT_EQ(compiled(held, compiler::Scheme::exact).law.networks.size(), 1u);
  const compiler::Network joined = written_network(R"([
    {"spring": 120, "nodes": ["tool", "left"]}, {"damper": 3, "nodes": ["tool", "left"]},
    {"damper": 5, "nodes": ["left", "far"]}, {"spring": 60, "nodes": ["far", "left"]}, {"damper": 2, "nodes": ["far", "ground"]},
    {"damper": 8, "nodes": ["left", "ground"]}, {"spring": 90, "nodes": ["left", "ground"]}])");
  const compiler::Network loose = written_network(bridge(R"(, {"slip": 1e-15, "nodes": ["left", "right"]})"));
  for (const auto& [slips, linear] : {std::pair(held, joined), std::pair(loose, written_network(bridge("")))}) {
    const double coarse = largest_difference(slips, linear, 1), fine = largest_difference(slips, linear, 4),
                 finest = largest_difference(slips, linear, 16);
    EXPECT_LT(coarse, 0.02);
    EXPECT_LT(fine, coarse / 3);
    EXPECT_LT(finest, fine / 3);
  }
}

// If this failed, a part whose step could take any time would be compiled.
TEST(SlipOutsideTree, RefusesMoreThanEight) {
  std::string text = bridge("");
  text.pop_back();
  for (int i = 1; i <= 9; ++i)
    text += ", {\"slip\": 1, \"nodes\": [\"left\", \"n" + std::to_string(i) + "\"]}, {\"spring\": 10, \"nodes\": [\"n" +
            std::to_string(i) + "\", \"right\"]}";
  compiler::Diagnostics diagnostics;
  EXPECT_FALSE(compiler::closed_normal_form(written_network(text + "]"), diagnostics));
  EXPECT_EQ(diagnostics.in_file_order().front().code, compiler::DiagnosticCode::too_many_slips_outside_tree);
}

}  // namespace dashpot::testing
