#include "fig12.hpp"

#include <gtest/gtest.h>

namespace {

using namespace dashpot::paper;

const Fig12& fig12() {
  static const Fig12 measured = measure_fig12();
  return measured;
}

// Fails if the paper's order does not come out: more energy back than the element's by the single motor, less by the
// dual channel.
TEST(Fig12, returns_most_energy_by_the_single_motor_and_least_by_the_dual_channel) {
  EXPECT_GT(fig12().parts[0].returned, fig12().parts[0].ideal_returned);
  EXPECT_LT(fig12().parts[1].returned, fig12().parts[1].ideal_returned);
}

// Fails if by how much changes.
TEST(Fig12, errs_by_what_the_page_says) {
  EXPECT_NEAR(fig12().parts[0].excess(), 0.125, 0.01);
  EXPECT_NEAR(fig12().parts[1].excess(), -0.019, 0.01);
}

// Fails if the offline velocity makes the order: with the true velocity and the forces that act it is the same.
TEST(Fig12, has_the_same_order_in_truth) {
  EXPECT_GT(fig12().parts[0].felt_returned, fig12().parts[0].ideal_returned);
  EXPECT_LT(fig12().parts[1].felt_returned, fig12().parts[1].ideal_returned);
}

}  // namespace
