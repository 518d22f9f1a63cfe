#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <dashpot/servo/histogram.hpp>

namespace dashpot {
namespace {

// The same definition on the sorted list of everything recorded.
std::uint64_t exact_percentile(std::vector<std::uint64_t> sorted, double percent) {
  const double wanted = percent / 100 * static_cast<double>(sorted.size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(wanted)));
  return sorted[rank - 1];
}

// Broken, a percentile could be below the true one, or further above it than a bin is wide.
TEST(Histogram, PercentilesBoundTheTrueOnesFromAboveWithinOneBin) {
  constexpr unsigned seed = 7;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(0, 36);
  histogram times;
  std::vector<std::uint64_t> all;
  for (int i = 0; i < 20000; ++i) {
    all.push_back(static_cast<std::uint64_t>(std::exp2(exponent(random))));
    times.record(static_cast<std::int64_t>(all.back()));
  }
  std::sort(all.begin(), all.end());
  for (const double percent : {0.0, 1.0, 25.0, 50.0, 90.0, 99.0, 99.9, 100.0}) {
    const std::uint64_t exact = exact_percentile(all, percent);
    EXPECT_GE(times.percentile(percent), exact) << percent << " seed " << seed;
    EXPECT_LE(times.percentile(percent), exact + exact / 32) << percent << " seed " << seed;
  }
}

// Broken, two neighbouring durations would share a bin where the header promises one each.
TEST(Histogram, IsExactBelow64Nanoseconds) {
  histogram times;
  for (std::int64_t value = 0; value < 64; ++value) times.record(value);
  for (unsigned value = 0; value < 64; ++value) EXPECT_EQ(times.percentile(100.0 * (value + 1) / 64), value);
}

// Broken, durations at the edge of an octave would be counted in the octave beside it.
TEST(Histogram, OctavesMeetWithoutGapOrOverlap) {
  for (unsigned octave = 6; octave < 36; ++octave) {
    const std::int64_t edge = std::int64_t{1} << octave;
    histogram times;
    times.record(edge - 1);
    times.record(edge);
    times.record(2 * edge);
    EXPECT_EQ(times.percentile(33), static_cast<std::uint64_t>(edge - 1));
    EXPECT_GE(times.percentile(66), static_cast<std::uint64_t>(edge));
    EXPECT_LE(times.percentile(66), static_cast<std::uint64_t>(edge + edge / 32));
  }
}

// Broken, the longest stall of a run, which matters most, would be rounded or lost.
TEST(Histogram, KeepsLeastGreatestAndMeanExactly) {
  histogram times;
  for (const double value : {1'000'003.0, 17.0, 5e11}) times.record(static_cast<std::int64_t>(value));
  EXPECT_EQ(times.min(), 17u);
  EXPECT_EQ(times.max(), 500'000'000'000u);
  EXPECT_EQ(times.percentile(100), histogram::longest());
  EXPECT_DOUBLE_EQ(times.mean(), (1'000'003 + 17 + 5e11) / 3);
}

// Broken, a percentile could be longer than the longest duration that ever was.
TEST(Histogram, NoPercentileExceedsTheGreatest) {
  histogram times;
  times.record(1'000'003);
  EXPECT_EQ(times.percentile(50), 1'000'003u);
}

// Broken, a clock that runs backwards, or a run without a period, would read outside the bins.
TEST(Histogram, SurvivesNothingAndNegativeDurations) {
  histogram times;
  EXPECT_EQ(times.percentile(50), 0u);
  EXPECT_EQ(times.min(), 0u);
  EXPECT_EQ(times.mean(), 0);
  times.record(-5);
  EXPECT_EQ(times.percentile(50), 0u);
  EXPECT_EQ(times.count(), 1u);
}

}  // namespace
}  // namespace dashpot
