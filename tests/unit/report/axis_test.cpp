#include "report/axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "report/plot.hpp"

namespace dashpot::compiler {
namespace {

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> all;
  for (const Tick& tick : axis.ticks)
    if (!tick.label.empty()) all.push_back(tick.label);
  return all;
}

using Labels = std::vector<std::string>;

// If this fails, a linear axis has odd steps, or cuts off what it is to show.
TEST(LinearAxis, EnclosesTheValuesInRoundSteps) {
  EXPECT_EQ(labels(linear_axis({0, 26.9}, 4)), (Labels{"0", "10", "20", "30"}));
  EXPECT_EQ(labels(linear_axis({-0.013, 0.021}, 4)), (Labels{"−0.02", "−0.01", "0", "0.01", "0.02", "0.03"}));
  EXPECT_EQ(labels(linear_axis({0, 0}, 4)), (Labels{"−1", "−0.5", "0", "0.5", "1"}));
}

// If this fails, a curve that only rounding bends looks bent.
TEST(LinearAxis, ShowsAFlatCurveAsFlat) {
  const Axis axis = linear_axis({3, 3 + 1e-15}, 4);
  EXPECT_LT(axis.shown.low, 2.1);
  EXPECT_GT(axis.shown.high, 3.9);
}

// If this fails, small numbers push their labels into the axis's name, or are labelled a thousand times too large.
TEST(LinearAxis, LabelsFarNumbersInUnitsOfAPowerOfTen) {
  const Axis axis = linear_axis({0, 4e-4}, 4);
  EXPECT_EQ(axis.power_of_ten, -6);
  EXPECT_EQ(labels(axis), (Labels{"0", "100", "200", "300", "400"}));
  EXPECT_DOUBLE_EQ(axis.place(2e-4), 0.5);
  EXPECT_EQ(linear_axis({0, 0.04}, 4).power_of_ten, 0);
  EXPECT_EQ(linear_axis({0, 2e6}, 4).power_of_ten, 6);
}

// If this fails, a decade has no label, or twelve decades have so many that they overlap.
TEST(LogarithmicAxis, LabelsDecades) {
  EXPECT_EQ(labels(logarithmic_axis({0.02, 30})), (Labels{"0.1", "1", "10"}));
  EXPECT_LE(labels(logarithmic_axis({1e-6, 1e7})).size(), 8u);
  EXPECT_NEAR(logarithmic_axis({0.01, 100}).place(1), 0.5, 1e-15);
}

// If this fails, an axis of less than two decades has no numbers, or one alone, from which nothing can be read.
TEST(LogarithmicAxis, LabelsWhatLiesWithinADecade) {
  EXPECT_EQ(labels(logarithmic_axis({0.011, 0.99})), (Labels{"0.02", "0.05", "0.1", "0.2", "0.5"}));
  EXPECT_EQ(labels(logarithmic_axis({0.025, 0.095})), (Labels{"0.03", "0.05", "0.07"}));
  EXPECT_EQ(labels(logarithmic_axis({6.5, 9.5})), (Labels{"7", "8", "9"}));
  EXPECT_GE(labels(logarithmic_axis({0.0512, 0.0578})).size(), 2u);
}

Plot one_curve(std::vector<double> x, std::vector<double> y) {
  return {"title",           {"time", "s"},          {"force", "N"},
          AxisScale::linear, AxisScale::logarithmic, {{"", Channel::total, std::move(x), std::move(y)}}};
}

// If this fails, a plot of nothing is a frame around nothing, or what a logarithm cannot show is drawn at its edge.
TEST(PlotFigure, LeavesOutWhatItCannotShow) {
  EXPECT_EQ(plot_figure(one_curve({}, {})), "");
  EXPECT_EQ(plot_figure(one_curve({0, 1}, {0, -1})), "");
  const std::string figure = plot_figure(one_curve({0, 1, 2, 3, 4}, {1, 2, 0, 3, 4}));
  const std::string path = figure.substr(figure.find("curve total"));
  EXPECT_EQ(std::count(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(path.find("/>")), 'M'), 2) << path;
}

}  // namespace
}  // namespace dashpot::compiler
