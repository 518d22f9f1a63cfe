// Certified laws in closed loop on the simulated device, held by random passive hands.
#include <gtest/gtest.h>

#include <cstdlib>

#include "certified_loop.hpp"

namespace dashpot::testing {
namespace {

int cases() { return std::getenv("DASHPOT_LONG") != nullptr ? 2000 : 100; }

// A certified law would give out more energy than it took up: with ideal sensors the energy that motor, brake and
// mechanics have taken up together is never below zero, the brake at either end of its tolerance, with jitter where the
// hold certificate covers it. Rounding: 1e-9 of what went to and fro.
TEST(CertifiedLoops, NeverGiveOutEnergy) {
  int certified = 0, by_hold = 0;
  for (std::uint64_t seed = 1; certified < cases(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    by_hold += one.compilation->certificate.bound.proof == compiler::Proof::hold ? 1 : 0;
    Random random(seed + 1'000'000);
    for (const simulated::brake_gain gain : {simulated::brake_gain::lowest, simulated::brake_gain::highest}) {
      const RunOfLoop run = run_loop(one, random, gain, 1500);
      EXPECT_GE(run.least_energy, -1e-9 * run.largest_exchange);
    }
  }
  EXPECT_GE(by_hold, cases() / 20);
}

}  // namespace
}  // namespace dashpot::testing
