// Networks that are known, recorded with noise: what is found again. 20 replicates of each, 100 with DASHPOT_LONG=1.
#include <gtest/gtest.h>

#include <cstdlib>

#include "fit/reduction.hpp"
#include "fit/uncertainty.hpp"
#include "synthetic.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr double noise_share = 0.005;

int replicates() {
  const char* const asked = std::getenv("DASHPOT_LONG");
  return asked != nullptr && std::string(asked) == "1" ? 100 : 20;
}

struct Recovery {
  int tried = 0, right_size = 0, intervals = 0, covered = 0, spurious = 0;
};

// Of a network whose size was found: does each interval hold the value that was put in?
void count_coverage(const Problem& problem, const Reduction& found, const Model& truth, Recovery& recovery) {
  const Uncertainty uncertainty(problem, found.model, found.effective_samples, false);
  for (std::size_t j = 0; j < truth.terms.size(); ++j)
    for (const bool times_time : {false, true}) {
      if (times_time && truth.terms[j].kind != TermKind::maxwell) continue;
      const ElementQuantity quantity{j, times_time, false, false};
      const auto interval = uncertainty.interval(quantity);
      if (!interval) continue;
      const double value = value_of(truth, quantity);
      ++recovery.intervals;
      recovery.covered += interval->low <= value && value <= interval->high ? 1 : 0;
    }
}

bool has_same_kinds(const Model& a, const Model& b) {
  if (a.terms.size() != b.terms.size()) return false;
  for (std::size_t j = 0; j < a.terms.size(); ++j)
    if (a.terms[j].kind != b.terms[j].kind) return false;
  return true;
}

Recovery recover(Noise kind) {
  Recovery recovery;
  std::uint64_t seed = kind == Noise::white ? 1000 : 2000;
  for (const Model& truth : sample_networks())
    for (int i = 0; i < replicates(); ++i) {
      const std::vector<Recording> files{answered(truth, noise_share, kind, ++seed)};
      const Problem problem(files, Form::stiffness, Weighting::uniform, 1'000'000);
      const Reduction found = reduce(problem, {});
      ++recovery.tried;
      const bool has_size = found.model.count(TermKind::maxwell) == truth.count(TermKind::maxwell);
      recovery.right_size += has_size ? 1 : 0;
      const bool has_kinds = has_same_kinds(found.model, truth);
      recovery.spurious += has_size && !has_kinds ? 1 : 0;
      if (has_kinds) count_coverage(problem, found, truth, recovery);
    }
  std::printf(
      "%d of %d with the right number of relaxations, %d of these with a spring or damper too many or too few; "
      "%d of %d intervals hold\n",
      recovery.right_size, recovery.tried, recovery.spurious, recovery.covered, recovery.intervals);
  return recovery;
}

// Fails if the criterion fits noise, or misses what can be seen through it.
TEST(Recovery, UnderWhiteNoise) {
  const Recovery recovery = recover(Noise::white);
  EXPECT_GE(recovery.right_size, 0.95 * recovery.tried);
  EXPECT_LE(recovery.spurious, 0.05 * recovery.tried);
}

// Fails if noise whose neighbours resemble each other is taken for relaxations, or intervals are told too narrow.
TEST(Recovery, UnderAutoregressiveNoise) {
  const Recovery recovery = recover(Noise::autoregressive);
  EXPECT_GE(recovery.right_size, 0.90 * recovery.tried);
  ASSERT_GT(recovery.intervals, 0);
  EXPECT_GE(recovery.covered, 0.88 * recovery.intervals);
}

}  // namespace
}  // namespace dashpot::compiler::fitting
