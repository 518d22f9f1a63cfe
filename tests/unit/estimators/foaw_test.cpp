// The adaptive window against its definition, in whole numbers and without the interval's shortcuts.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/estimators/foaw.hpp>

namespace dashpot::foaw_test {
namespace {

constexpr double sample_period = 1e-3;  // [s]
constexpr unsigned longest = 24;        // [samples]

using counts = std::vector<long>;  // newest last

long ago(const counts& history, unsigned age) { return history[history.size() - 1 - age]; }

// |y_{k−i} − line(i)| ≤ 1 count, all multiplied by n.
bool all_near_end_line(const counts& history, unsigned n) {
  const long rise = ago(history, 0) - ago(history, n);
  for (unsigned i = 1; i < n; ++i) {
    const long deviation = (ago(history, i) - ago(history, 0)) * static_cast<long>(n) + rise * static_cast<long>(i);
    if (std::labs(deviation) > static_cast<long>(n)) return false;
  }
  return true;
}

// Some line passes within half a count of every sample unless a sample lies more than one count above or below the
// chord of two others, on the inner side: the strip's width is then more than a count (Helly: three samples decide).
bool all_near_some_line(const counts& history, unsigned n) {
  for (unsigned a = 0; a <= n; ++a)
    for (unsigned c = a + 2; c <= n; ++c)
      for (unsigned b = a + 1; b < c; ++b) {
        const long span = static_cast<long>(c - a);
        const long chord = ago(history, a) * static_cast<long>(c - b) + ago(history, c) * static_cast<long>(b - a);
        if (std::labs(ago(history, b) * span - chord) > span) return false;
      }
  return true;
}

template <class Condition>
unsigned defined_window(const counts& history, Condition all_near) {
  unsigned n = 1;
  while (n < longest && all_near(history, n + 1)) ++n;
  return n;
}

// Counts of motions that are by turns steady, accelerated, reversed, at rest and shaken.
counts random_counts(std::mt19937& random, int length) {
  std::normal_distribution<double> kick(0, 0.15), shake(0, 0.4);
  std::uniform_int_distribution<int> chance(0, 99);
  counts result(longest + 1, 0);
  double position = 0.5, speed = 0, noise = 0;
  for (int k = 0; k < length; ++k) {
    if (chance(random) < 8) speed = chance(random) < 20 ? 0 : speed + 5 * kick(random);
    if (chance(random) < 3) noise = chance(random) < 60 ? 0 : 1;
    position += speed;
    result.push_back(static_cast<long>(std::floor(position + noise * shake(random))));
  }
  return result;
}

class Foaw : public testing::TestWithParam<double> {};

// A shortcut that accepts another window than the definition gives another velocity in the moments that matter. Steps
// that are no powers of two make every tie a matter of rounding, which the definition in whole counts does not know.
TEST_P(Foaw, EndFitWindowIsTheDefinedOne) {
  std::mt19937 random(20000101);
  const double step = GetParam();
  foaw<double> estimator(longest, foaw_fit::end, step, sample_period);
  const counts all = random_counts(random, 20000);
  counts history(all.begin(), all.begin() + longest);
  for (std::size_t k = longest; k < all.size(); ++k) {
    history.push_back(all[k]);
    const double velocity = estimator.update(step * static_cast<double>(all[k]));
    const unsigned n = defined_window(history, all_near_end_line);
    ASSERT_EQ(estimator.window(), n) << "seed 20000101, sample " << k;
    const double slope = static_cast<double>(ago(history, 0) - ago(history, n)) * step / (n * sample_period);
    ASSERT_NEAR(velocity, slope, 1e-9 * step / sample_period);
  }
}

// The same for the best fit, whose velocity is the least-squares slope of the window.
TEST_P(Foaw, BestFitWindowIsTheDefinedOne) {
  std::mt19937 random(20000102);
  const double step = GetParam();
  foaw<double> estimator(longest, foaw_fit::best, step, sample_period);
  const counts all = random_counts(random, 4000);
  counts history(all.begin(), all.begin() + longest);
  for (std::size_t k = longest; k < all.size(); ++k) {
    history.push_back(all[k]);
    const double velocity = estimator.update(step * static_cast<double>(all[k]));
    const unsigned n = defined_window(history, all_near_some_line);
    ASSERT_EQ(estimator.window(), n) << "seed 20000102, sample " << k;
    double sum = 0, moment = 0;
    for (unsigned i = 0; i <= n; ++i) {
      sum += static_cast<double>(ago(history, i));
      moment += i * static_cast<double>(ago(history, i));
    }
    const double slope = 6 * (n * sum - 2 * moment) * step / (sample_period * n * (n + 1.0) * (n + 2.0));
    ASSERT_NEAR(velocity, slope, 1e-9 * step / sample_period);
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, Foaw, testing::Values(1.0, 30e-6, 2 * 3.14159265358979 / 65536));

// On positions that are no whole counts the O(n) form still equals the O(n²) one, sample by sample against the line.
TEST(FoawOffTheGrid, EndFitWindowIsTheDefinedOne) {
  std::mt19937 random(20000103);
  std::normal_distribution<double> kick(0, 1);
  foaw<double> estimator(longest, foaw_fit::end, 1, sample_period);
  std::vector<double> history(longest + 1, 0.0);
  for (int k = 0; k < 20000; ++k) {
    history.push_back(history.back() + (k / 50 % 4) * 0.7 + 0.3 * kick(random));
    estimator.update(history.back());
    const auto position = [&](unsigned age) { return history[history.size() - 1 - age]; };
    const auto all_near = [&](unsigned n) {
      const double slope = (position(0) - position(n)) / n;
      for (unsigned i = 1; i < n; ++i)
        if (std::abs(position(i) - (position(0) - slope * i)) > 1 + 1.0 / 1024) return false;
      return true;
    };
    unsigned n = 1;
    while (n < longest && all_near(n + 1)) ++n;
    ASSERT_EQ(estimator.window(), n) << "seed 20000103, sample " << k;
  }
}

double steady_window_of(foaw_fit fit, double speed, double rounding) {
  foaw<double> estimator(longest, fit, 1, sample_period);
  unsigned shortest = longest;
  for (int k = 0; k < 2000; ++k) {
    estimator.update(std::floor(speed * k + rounding));
    if (k > static_cast<int>(longest)) shortest = std::min(shortest, estimator.window());
  }
  return shortest;
}

// Quantisation alone must never shorten the window, whatever the speed [counts a sample], flooring or rounding: that is
// what d = one count (end fit) and half a count (best fit) are for.
TEST(FoawWindow, IsFullInSteadyMotion) {
  for (const double speed : {0.013, 0.11, 0.5, 0.77, 1.3, 7.41, -0.29, -3.6})
    for (const double rounding : {0.0, 0.5})
      for (const foaw_fit fit : {foaw_fit::end, foaw_fit::best})
        EXPECT_EQ(steady_window_of(fit, speed, rounding), longest) << speed << " counts a sample";
}

// A sudden stop must be seen at once, or the window is not adaptive.
TEST(FoawWindow, ShrinksWhenMotionChanges) {
  for (const foaw_fit fit : {foaw_fit::end, foaw_fit::best}) {
    foaw<double> estimator(longest, fit, 1, sample_period);
    for (int k = 0; k <= 100; ++k) estimator.update(4.0 * k);
    EXPECT_EQ(estimator.window(), longest);
    estimator.update(400);
    EXPECT_LE(estimator.window(), 2U);
    EXPECT_LE(estimator.update(400), 0.5 * 4.0 / sample_period);
  }
}

// Single precision holds counts exactly, so it must choose the same windows.
TEST(FoawWindow, IsTheSameInSinglePrecision) {
  std::mt19937 random(20000104);
  const double step = 2 * 3.14159265358979 / 65536;
  for (const foaw_fit fit : {foaw_fit::end, foaw_fit::best}) {
    foaw<float> single(longest, fit, step, sample_period);
    foaw<double> twice(longest, fit, step, sample_period);
    for (const long count : random_counts(random, 3000)) {
      single.update(static_cast<float>(step * static_cast<double>(count)));
      twice.update(step * static_cast<double>(count));
      ASSERT_EQ(single.window(), twice.window()) << "seed 20000104";
    }
  }
}

}  // namespace
}  // namespace dashpot::foaw_test
