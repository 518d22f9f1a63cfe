#include "fig13.hpp"

#include <gtest/gtest.h>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Fig13& fig13() {
  static const Fig13 measured = measure_fig13(true);
  return measured;
}

// Fails if the tool is not let go at the printed velocity.
TEST(Fig13, LetsGoAtThePrintedVelocity) {
  for (const Fig13::Part& part : fig13().parts) EXPECT_NEAR(part.release_velocity, 1.8, 0.02) << part.name;
}

// Fails if the paper's order does not come out: the single motor swings back further than the element would, the dual
// channel less.
TEST(Fig13, SwingsBackFurtherByTheSingleMotor) {
  EXPECT_LT(fig13().parts[1].undershoot, fig13().parts[0].undershoot);
  EXPECT_GT(fig13().parts[2].undershoot, fig13().parts[0].undershoot);
  EXPECT_GT(fig13().parts[1].overshoot, fig13().parts[2].overshoot);
}

// Fails if the size changes. The paper's ratio of 1.9 does not come out with the values of the other figures.
TEST(Fig13, HasASmallerRatioThanThePapers) {
  EXPECT_NEAR(fig13().parts[1].undershoot / fig13().parts[2].undershoot, 1.19, 0.02);
}

// Fails if the ratio does not grow with the element's stiffness and fall with the inertia, if the hand, which is gone
// when it swings, matters to it by more than a percent, or if a hand lets go at another velocity than the printed one.
TEST(Fig13, HasARatioOfTheElementAndTheArm) {
  const auto& all = fig13().variations;
  ASSERT_EQ(all.size(), 8U);  // inertia fastest, then hand, then element
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(all[i + 4].ratio(), all[i].ratio());
  for (std::size_t i = 0; i < 8; i += 2) EXPECT_GT(all[i].ratio(), all[i + 1].ratio());
  for (const std::size_t i : {0U, 1U, 4U, 5U}) EXPECT_NEAR(all[i + 2].ratio(), all[i].ratio(), 0.01 * all[i].ratio());
  for (const Fig13::Variation& v : all)
    for (const double release : {v.single_release, v.dual_release}) EXPECT_NEAR(release, 1.8, 0.01);
}

// Fails if the paper's 1.9 is out of reach over what the paper does not print, or if settling does not change sides.
TEST(Fig13, AgreesWithThePaperInPartOfWhatItDoesNotPrint) {
  const Fig13 measured = measure_fig13();
  int ratio = 0, sooner = 0;
  for (const Fig13::Variation& v : measured.variations) ratio += v.ratio() >= 1.9, sooner += v.advantage() > 0;
  EXPECT_GT(ratio, 0);
  EXPECT_LT(ratio, int(measured.variations.size()) / 4);
  EXPECT_GT(sooner, int(measured.variations.size()) / 4);
  EXPECT_LT(sooner, int(measured.variations.size()));
  EXPECT_TRUE(says(show(measured), "“A faster settling time” agrees with the paper in part of that range"));
}

// Fails if the words stay when the numbers change sides.
TEST(Fig13, SaysWhatTheNumbersSay) {
  Fig13 other = fig13();
  for (Fig13::Variation& v : other.variations) v.dual = v.single, v.dual_settling = v.single_settling + 1;
  EXPECT_TRUE(says(show(fig13()), "that the dual channel swings back less agrees with the paper in all of that range"));
  EXPECT_TRUE(says(show(other), "that the dual channel swings back less agrees with the paper nowhere"));
  EXPECT_TRUE(says(show(other), "“A faster settling time” agrees with the paper nowhere"));
  EXPECT_TRUE(says(show(fig13()), "the paper’s order comes out"));
  EXPECT_TRUE(says(show(fig13()), "the default is nearer to the ideal"));
  std::swap(other.parts[1].undershoot, other.parts[2].undershoot);
  other.parts[4].distance = 1;
  EXPECT_TRUE(says(show(other), "the paper’s order does not come out"));
  EXPECT_TRUE(says(show(other), "the default is no nearer to the ideal"));
}

// Fails if dashpot's default does not follow the ideal more closely than the paper's laws do.
TEST(Fig13, IsNearestToTheIdealFaithfully) {
  for (const std::size_t other : {1U, 2U, 3U})
    EXPECT_LT(fig13().parts[4].distance, fig13().parts[other].distance / 5) << fig13().parts[other].name;
}

// Fails if settling changes. The paper's "faster settling" of the dual channel does not come out: it swings more
// slowly.
TEST(Fig13, SettlesNoFasterByTheDualChannel) {
  EXPECT_NEAR(fig13().parts[1].settling, 0.251, 0.01);
  EXPECT_NEAR(fig13().parts[2].settling, 0.275, 0.01);
}

}  // namespace
