#include "figure.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "axis.hpp"

namespace {

using namespace dashpot::paper;

// Fails if an axis does not hold its data, or its ticks are not 1, 2 or 5 times a power of ten, at any magnitude.
TEST(Axis, EnclosesItsValuesInRoundSteps) {
  for (int decade = -6; decade <= 6; ++decade)
    for (double digits = 1; digits < 10; digits += 0.37) {
      const double high = digits * std::pow(10, decade);
      const Ticks ticks = ticks_for({-0.3 * high, high}, 4);
      EXPECT_LE(ticks.low(), -0.3 * high);
      EXPECT_GE(ticks.high(), high * (1 - 1e-9));
      EXPECT_LE(ticks.last - ticks.first, 8) << high;
      const double mantissa = ticks.step / std::pow(10, std::floor(std::log10(ticks.step) + 1e-9));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-9 || std::abs(mantissa - 2) < 1e-9 || std::abs(mantissa - 5) < 1e-9);
    }
}

// Fails if a value that is a tick but for rounding opens a further, empty step.
TEST(Axis, DoesNotGrowByRounding) { EXPECT_EQ(ticks_for({0, 0.1 + 0.2}, 3).last, 3); }

// Fails if values that are all one number leave an axis without a length.
TEST(Axis, HasALengthForAConstant) {
  const Ticks ticks = ticks_for({3, 3}, 4);
  EXPECT_LT(ticks.low(), 3);
  EXPECT_GT(ticks.high(), 3);
}

// Fails if labels lose the decimals that tell neighbouring ticks apart.
TEST(Axis, LabelsAsManyDecimalsAsTheStepNeeds) {
  EXPECT_EQ(tick_label({0.05, 0, 4}, 3), "0.15");
  EXPECT_EQ(tick_label({0.2, -1, 4}, -1), "−0.2");
  EXPECT_EQ(tick_label({20, 0, 4}, 3), "60");
}

double number(const std::smatch& match, std::size_t group) { return std::stod(match[group]); }

// Where the tick with this label is written.
double tick_at(const std::string& svg, const std::string& label, const char* coordinate) {
  std::smatch match;
  const std::regex text(fmt::format("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\" text-anchor=\"[a-z]+\">{}</text>", label));
  EXPECT_TRUE(std::regex_search(svg, match, text)) << label;
  return number(match, *coordinate == 'x' ? 1 : 2);
}

// Fails if a point is drawn anywhere but where the labels of the axes say it is.
TEST(Figure, DrawsPointsWhereTheAxesSay) {
  const Figure figure{"t", {}, {{"p", "time [s]", "force [N]", {{"c", emitted, {7}, {-300}}}}}};
  const std::string svg = to_svg(figure);
  const std::string panel = svg.substr(svg.find(">−300<") - 80);  // behind the legend, which shows circles too
  std::smatch circle;
  ASSERT_TRUE(std::regex_search(panel, circle, std::regex("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"")));
  const double tick_6 = tick_at(svg, "6", "x"), tick_8 = tick_at(svg, "8", "x");
  EXPECT_NEAR(number(circle, 1), (tick_6 + tick_8) / 2, 0.1);          // positions are written to a tenth
  EXPECT_NEAR(number(circle, 2), tick_at(svg, "−300", "y") - 4, 0.1);  // 4 down: the middle of a digit
}

// Fails if the legend names a curve twice, or not at all, or one that has no name.
TEST(Figure, NamesEachCurveOnce) {
  const Curve named{"law & order", plain, {0, 1}, {0, 1}}, unnamed{"", plain, {0, 1}, {1, 0}};
  const std::string svg = to_svg({"t", {}, {{"a", "x", "y", {named, unnamed}}, {"b", "x", "y", {named}}}});
  const std::size_t first = svg.find(">law &amp; order<");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(svg.find(">law &amp; order<", first + 1), std::string::npos);
  EXPECT_EQ(svg.find("></text>"), std::string::npos);
}

}  // namespace
