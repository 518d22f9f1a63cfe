// What `faithful` chooses on random devices, against a scan of all dampings that the brake can give.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "certified_loop.hpp"
#include "certify/settle.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

int faithful_choices() { return static_cast<int>(repetitions(5, 500)); }
int scanned_points() { return static_cast<int>(repetitions(60, 400)); }

CompiledCase faithful_case(std::uint64_t seed) {
  CompiledCase one = random_case(seed);
  one.choices.decomposition = "faithful";
  Diagnostics unheard;
  one.compilation = compile(*one.source, one.choices, one.device, unheard);
  return one;
}

// The whole reach of the brake, evenly and by decades, and closely around b∞ and the choice.
std::vector<double> dampings(double most, double feedthrough, double chosen) {
  std::vector<double> all = {0, most, feedthrough};
  for (int i = 1; i < scanned_points(); ++i) {
    const double share = double(i) / scanned_points();
    all.push_back(most * share);
    all.push_back(most * std::pow(10, -9 * share));
    for (const double center : {feedthrough, chosen}) {
      all.push_back(2 * center * share);
      all.push_back(center * (1 + std::pow(10, -5 * share)));
      all.push_back(center * (1 - std::pow(10, -5 * share)));
    }
  }
  std::erase_if(all, [=](double b) { return !(b >= 0 && b <= most); });
  return all;
}

class Scan {
 public:
  explicit Scan(const CompiledCase& one)
      : one_(one),
        c_(*one.compilation),
        port_(PortDevice::of(one.device, c_.network, unheard_).value()),
        settler_(c_.network, c_.form, c_.decomposition, one.choices, port_, c_.rate) {}

  // Of one damping and each state input, weighed as any candidate that a user names is.
  void add(double damping, std::vector<EvaluatedOption>& options) {
    for (const StateInputMerit& merit : c_.decomposition.choice().state_inputs) {
      Candidate candidate = c_.decomposition.choice();
      candidate.name = "given";
      candidate.state_inputs = {merit};
      candidate.state_input = merit.state_input;
      settler_.place(candidate, damping);
      settler_.settle(candidate);
      if (candidate.damping != damping) continue;  // lowered until it fits: that one is another point
      options.push_back({damping, candidate.largest_error, candidate.minimum_damping, candidate.certified == true,
                         candidate.motor_noise});
    }
  }

 private:
  const CompiledCase& one_;
  const Compilation& c_;
  Diagnostics unheard_;
  PortDevice port_;
  CandidateSettler settler_;
};

// Between the neighbours of one damping that was scanned: what is least may lie between two points.
void look_closer(Scan& scan, std::vector<EvaluatedOption>& options, double at) {
  double low = 0, high = at * 2;
  for (const EvaluatedOption& option : options) {
    if (option.damping < at) low = std::max(low, option.damping);
    if (option.damping > at) high = std::min(high, option.damping);
  }
  for (int i = 1; i < scanned_points(); ++i) scan.add(low + (high - low) * i / scanned_points(), options);
}

// Where an option that is certified and errs by at most `allowed` needs the least added.
std::optional<double> least_added_place(const std::vector<EvaluatedOption>& options, double allowed) {
  const EvaluatedOption* least = nullptr;
  for (const EvaluatedOption& option : options)
    if (option.certified && is_within(option.error, allowed) && (!least || *option.added < *least->added))
      least = &option;
  return least ? std::optional(least->damping) : std::nullopt;
}

// The choice as an option, a little better than it is: what a scan finds is not told from it by less.
EvaluatedOption as_chosen(const Candidate& choice) {
  constexpr double alike = 1 - 1e-3;
  return {choice.damping, choice.largest_error * alike, choice.minimum_damping.value_or(0) * alike,
          choice.certified == true, choice.motor_noise};
}

void expect_nothing_larger(std::uint64_t seed) {
  const CompiledCase one = faithful_case(seed);
  ASSERT_TRUE(one.compilation) << "seed " << seed;
  const Candidate& choice = one.compilation->decomposition.choice();
  const double most = one.device.description.brake.max_damping,
               feedthrough = to_double(one.compilation->form.linear.feedthrough_damping);
  std::vector<EvaluatedOption> options;
  Scan scan(one);
  for (const double damping : dampings(most, feedthrough, choice.damping)) scan.add(damping, options);
  for (int closer = 0; closer < 2; ++closer)
    if (const auto place = least_added_place(options, choice.faithful->allowed_error))
      look_closer(scan, options, *place);
  const EvaluatedOption chosen = as_chosen(choice);
  options.push_back(chosen);
  // The least error of all may lie between two points of a scan, which would then allow more than the rule does.
  options.push_back({0, choice.faithful->least_error, std::nullopt, false, std::nullopt});
  const FaithfulChoice found = choose_faithful(options, one.choices.tolerance);
  const double damping = options[found.chosen].damping;
  EXPECT_EQ(found.certified, chosen.certified) << "seed " << seed;
  EXPECT_LE(damping, choice.damping * (1 + 2e-3) + 1e-9 * most)
      << "seed " << seed << ": a scan finds " << damping << " with an error of " << options[found.chosen].error
      << ", the choice is " << choice.damping << " with " << choice.largest_error;
  EXPECT_GE(damping, choice.damping * (1 - 2e-3) - 1e-9 * most)
      << "seed " << seed << ": by a scan the choice, " << choice.damping << " with an error of " << choice.largest_error
      << ", is out; it has " << found.allowed_error << " allowed, " << found.least_added << " added, and takes "
      << damping;
}

// Fails if some damping that the brake can give, with any state input, is larger than the choice and meets its rule, or
// if the choice itself does not meet it.
TEST(FaithfulChoice, NoScanFindsALargerDamping) {
  for (int seed = 0; seed < faithful_choices(); ++seed) expect_nothing_larger(std::uint64_t(seed));
}

// Fails if a place is lost that is a millionth of the brake's reach wide, or one at the very edge of the error allowed.
TEST(FaithfulChoice, MissesNeitherSmallPlacesNorEdges) {
  for (const std::uint64_t seed : {142u, 290u, 355u}) expect_nothing_larger(seed);
}

}  // namespace
}  // namespace dashpot::testing
