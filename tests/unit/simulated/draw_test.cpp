// The simulation's random numbers: what they are drawn from, and that they know nothing of each other.
#include <cmath>

#include <gtest/gtest.h>

#include <dashpot/simulated/draw.hpp>

namespace dashpot::simulated {
namespace {

constexpr int draws = 100000;
// Five standard deviations of a mean of this many values of variance 1.
const double five_sigma = 5 / std::sqrt(draws);

// If this failed, uniform and normal numbers would not be what their names say.
TEST(Draw, HasTheMomentsOfItsDistribution) {
  double sum = 0, squares = 0, normal = 0, normal_squares = 0;
  for (int k = 0; k < draws; ++k) {
    const double u = draw_uniform(5, draw_stream::jitter, static_cast<std::uint64_t>(k));
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    const double x = draw_normal(5, draw_stream::jitter, static_cast<std::uint64_t>(k));
    normal += x;
    normal_squares += x * x;
  }
  EXPECT_NEAR(sum / draws, 0.5, five_sigma * std::sqrt(1.0 / 12));
  EXPECT_NEAR(squares / draws, 1.0 / 3, five_sigma * std::sqrt(1.0 / 5 - 1.0 / 9));
  EXPECT_NEAR(normal / draws, 0, five_sigma);
  EXPECT_NEAR(normal_squares / draws, 1, five_sigma * std::sqrt(2));
}

// If this failed, jitter would follow the sensor's noise, one seed another, or one sample the one before.
TEST(Draw, PlacesAreIndependent) {
  double streams = 0, seeds = 0, neighbours = 0;
  for (std::uint64_t k = 0; k < draws; ++k) {
    const double here = draw_uniform(5, draw_stream::jitter, k) - 0.5;
    streams += here * (draw_uniform(5, draw_stream::sensor_noise, k) - 0.5);
    seeds += here * (draw_uniform(6, draw_stream::jitter, k) - 0.5);
    neighbours += here * (draw_uniform(5, draw_stream::jitter, k + 1) - 0.5);
  }
  for (const double correlation : {streams, seeds, neighbours}) EXPECT_NEAR(correlation * 12 / draws, 0, five_sigma);
}

}  // namespace
}  // namespace dashpot::simulated
