// The searches of convex functions that ask for few values, against those that ask for many.
#include "certify/convex_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace dashpot::compiler {
namespace {

// The largest of some parabolas, some of them lines; counts how often it is asked for.
class Convex {
 public:
  explicit Convex(unsigned seed) : random_(seed) {
    for (int i = 0; i < 5; ++i)
      pieces_.push_back({i % 2 == 0 ? 0 : within(0, 3), within(0, 2), within(-2, 2), within(0, 1)});
  }

  double operator()(double x) {
    ++asked;
    double largest = 0;
    for (const Piece& piece : pieces_) {
      const double way = x - piece.middle;
      largest = std::max(largest, piece.bend * way * way + piece.slope * way + piece.height);
    }
    return largest;
  }

  double within(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }

  int asked = 0;

 private:
  struct Piece {
    double bend, middle, slope, height;
  };
  std::mt19937_64 random_;
  std::vector<Piece> pieces_;
};

constexpr double low = 0, high = 2, precision = 1e-14;

// Fails if the chords that save most of the questions lead to another answer than bisection.
TEST(LevelBoundary, MatchesBisectionWithFewerEvaluations) {
  int compared = 0, asked = 0, by_bisection = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    Convex f(seed);
    const ValueAt least = golden_section(std::ref(f), low, high, 0, 1e-10);
    for (const double end : {low, high}) {
      const ValueAt fails{end, f(end)};
      const double level = least.value + f.within(0, 0.9) * (fails.value - least.value);
      if (!(least.value <= level && fails.value > level)) continue;
      f.asked = 0;
      const double plain = boundary([&](double x) { return f(x) <= level; }, least.place, end, precision);
      by_bisection += f.asked, f.asked = 0;
      const double found = level_boundary(std::ref(f), level, least, fails, precision);
      asked += f.asked;
      EXPECT_NEAR(found, plain, 2 * precision * std::max(found, plain)) << seed << ", " << end;
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
  EXPECT_LT(2 * asked, by_bisection);
}

// Fails if an end at which nothing is proved, an infinite value, spoils the chords.
TEST(LevelBoundary, MayFailAtAnInfiniteValue) {
  const auto f = [](double x) { return x < 1.5 ? x * x : std::numeric_limits<double>::infinity(); };
  EXPECT_NEAR(level_boundary(f, 2, {0, f(0)}, {4, f(4)}, precision), std::sqrt(2.0), 1e-13);
  EXPECT_NEAR(level_boundary(f, 100, {0, f(0)}, {4, f(4)}, precision), 1.5, 1e-13);
}

// Fails if the search gives up a level that is reached, or goes on where the chords tell that it is not.
TEST(GoldenSection, GivesUpOnlyUnreachedLevels) {
  constexpr double fine = 1e-10;
  int given_up = 0, asked = 0, to_the_end = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    Convex f(seed);
    const ValueAt least = golden_section(std::ref(f), low, high, 0, fine);
    const double at_low = f(low), at_high = f(high), room = std::min(at_low, at_high) - least.value;
    if (!(room > 1e-3)) continue;
    for (const double above : {1e-6, 1e-3, 0.5}) {
      const double level = least.value + above * room;
      EXPECT_LE(golden_section(std::ref(f), low, high, level, fine, OfInterest{level, at_low, at_high}).value, level)
          << seed;
    }
    const double level = least.value - 0.1 * room;
    f.asked = 0;
    EXPECT_GT(golden_section(std::ref(f), low, high, level, fine).value, level);
    to_the_end += f.asked, f.asked = 0;
    EXPECT_GT(golden_section(std::ref(f), low, high, level, fine, OfInterest{level, at_low, at_high}).value, level);
    asked += f.asked;
    ++given_up;
  }
  EXPECT_GT(given_up, 200);
  EXPECT_LT(8 * asked, to_the_end);
}

}  // namespace
}  // namespace dashpot::compiler
