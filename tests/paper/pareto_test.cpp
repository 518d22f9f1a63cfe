#include "pareto.hpp"

#include <gtest/gtest.h>

#include "says.hpp"

namespace {

using namespace dashpot::paper;

const Pareto& pareto() { return measured_pareto(); }

const Pareto::Sweep& sweep(const char* network, const char* state_input, std::size_t estimator) {
  std::size_t seen = 0;
  for (const Pareto::Sweep& each : pareto().sweeps)
    if (each.network == network && each.state_input == state_input && seen++ == estimator) return each;
  throw std::out_of_range(network);
}

constexpr std::size_t one_sample = 0, papers_filter = 1;

// Fails if a split is said to be passive under the paper's filter below half of the network's viscosity by more than
// the arm's own damping pays for, or not to be at it, where the theorem of half the viscosity puts the line for an
// exact brake.
TEST(Pareto, TurnsPassiveNearHalfTheViscosity) {
  const Pareto::Sweep& fig5 = sweep("Fig. 5", "velocity", papers_filter);
  for (const Split& split : fig5.splits) {
    const double share = split.brake / fig5.viscosity;
    if (share < 0.4) {
      EXPECT_GT(split.missing[0], 0) << split.brake;
    } else if (share > 0.65 && share < 1.4) {
      EXPECT_EQ(split.missing[0], 0) << split.brake;
    }
  }
}

// Fails if a brake that is short does not cost what it is short of, where nothing else is missing.
TEST(Pareto, PaysForABrakeThatIsShort) {
  for (const Split& split : sweep("Fig. 5", "velocity", papers_filter).splits)
    if (split.brake > 5) {
      EXPECT_GT(split.missing[2], split.missing[0] + 0.04 * split.brake) << split.brake;
    }
}

// Fails if the b that needs least is another than the page says.
TEST(Pareto, HasNoOneWinnerDrivenByVelocity) {
  const Pareto::Sweep& fig5 = sweep("Fig. 5", "velocity", papers_filter);
  EXPECT_NEAR(fig5.best(0).brake, 6.60, 0.37);  // one step of the sweep
  EXPECT_NEAR(fig5.best(1).brake, 0.37, 0.37);
  EXPECT_EQ(fig5.best(2).brake, 0);
  EXPECT_EQ(sweep("Fig. 5", "velocity", one_sample).best(0).brake, 0);
  EXPECT_NEAR(sweep("Fig. 6", "velocity", papers_filter).best(1).brake, 5.67, 0.17);
}

// Fails if driving by position stops being free of noise and extra damping without a brake, or if some brake errs less.
TEST(Pareto, IsWonByNoBrakeDrivenByPosition) {
  for (const char* network : {"Fig. 5", "Fig. 6"})
    for (std::size_t estimator = 0; estimator < 3; ++estimator)
      for (std::size_t error = 0; error < brake_errors.size(); ++error) {
        const Split& best = sweep(network, "position", estimator).best(error);
        EXPECT_EQ(best.brake, 0);
        EXPECT_EQ(best.missing[error], 0);
        EXPECT_EQ(best.noise, 0);
        for (const Split& split : sweep(network, "position", estimator).splits) EXPECT_LE(best.error, split.error);
      }
}

// Fails if the rig's brake reaches half of Fig. 5's viscosity, or does not reach half of Fig. 6's: the page says what
// that means.
TEST(Pareto, LeavesFig5BeyondTheRigsBrake) {
  constexpr double reach = 2.8;  // [N·s/m]
  EXPECT_GT(sweep("Fig. 5", "velocity", papers_filter).viscosity / 2, reach);
  EXPECT_LT(sweep("Fig. 6", "velocity", papers_filter).viscosity / 2, reach);
}

// Fails if the words stay when the numbers change sides.
TEST(Pareto, SaysWhatTheNumbersSay) {
  EXPECT_TRUE(says(show(pareto()), "then needs least, and wins"));
  EXPECT_TRUE(says(show(pareto()), "is below ½ Z_d(0)"));
  Pareto other = pareto();
  for (Pareto::Sweep& each : other.sweeps) {
    each.splits.front().missing = {9, 9, 9};
    each.viscosity = 1;
  }
  EXPECT_TRUE(says(show(other), "does not win even then"));
  EXPECT_FALSE(says(show(other), "is below ½ Z_d(0)"));
}

}  // namespace
