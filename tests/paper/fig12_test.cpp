#include "fig12.hpp"

#include <gtest/gtest.h>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Fig12& fig12() {
  static const Fig12 measured = measure_fig12();
  return measured;
}

// Fails if the paper's order does not come out: more energy back than the element's by the single motor, less by the
// dual channel.
TEST(Fig12, ReturnsMostEnergyByTheSingleMotorAndLeastByTheDualChannel) {
  EXPECT_GT(fig12().parts[0].returned, fig12().parts[0].ideal_returned);
  EXPECT_LT(fig12().parts[1].returned, fig12().parts[1].ideal_returned);
}

// Fails if by how much changes.
TEST(Fig12, ErrsByWhatThePageSays) {
  EXPECT_NEAR(fig12().parts[0].excess(), 0.125, 0.01);
  EXPECT_NEAR(fig12().parts[1].excess(), -0.019, 0.01);
}

// Fails if the offline velocity makes the order: with the true velocity and the forces that act it is the same.
TEST(Fig12, HasTheSameOrderInTruth) {
  EXPECT_GT(fig12().parts[0].felt_returned, fig12().parts[0].ideal_returned);
  EXPECT_LT(fig12().parts[1].felt_returned, fig12().parts[1].ideal_returned);
}

// Fails if the order depends on how (20) is read.
TEST(Fig12, HasTheSameOrderByBothReadingsOf20) {
  for (const auto reading : {&Readings::increment, &Readings::sum}) {
    EXPECT_GT((fig12().parts[0].readings.*reading).depth, (fig12().parts[0].ideal_readings.*reading).depth);
    EXPECT_LT((fig12().parts[1].readings.*reading).depth, (fig12().parts[1].ideal_readings.*reading).depth);
  }
}

// Fails if dashpot's default is not nearer to the element than every law of the paper.
TEST(Fig12, IsNearestToTheElementFaithfully) {
  for (const std::size_t other : {0U, 1U, 2U})
    EXPECT_LT(fig12().parts[3].rms_error, fig12().parts[other].rms_error / 5) << fig12().parts[other].name;
}

// Fails if the words stay when the numbers change sides.
TEST(Fig12, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(fig12()), "The paper’s order comes out"));
  EXPECT_TRUE(says(show(fig12()), "the default is nearer to the element"));
  Fig12 other = fig12();
  std::swap(other.parts[0].readings, other.parts[1].readings);
  EXPECT_TRUE(says(show(other), "The paper’s order does not come out"));
  EXPECT_TRUE(says(show(other), "Read so, the paper’s order does not come out"));
  other.parts[3].rms_error = 1;
  EXPECT_TRUE(says(show(other), "the default is no nearer to the element"));
}

}  // namespace
