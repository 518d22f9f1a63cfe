// Certified laws in closed loop on the simulated device, held by random passive hands.
#include <gtest/gtest.h>

#include "certified_loop.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

int certified_devices() { return static_cast<int>(repetitions(30, 2000)); }

// If this failed, a certified law would give out more energy than it took up: with ideal sensors the energy that motor,
// brake and mechanics have taken up together is never below zero, the brake at either end of its tolerance, with jitter
// where the certificate covers it, behind lags too.
TEST(CertifiedLoops, NeverGiveOutEnergy) {
  int certified = 0, by_hold = 0, lagging = 0;
  for (std::uint64_t seed = 1; certified < certified_devices(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    const compiler::Certificate& certificate = one.compilation->certificate;
    by_hold += certificate.bound.proof == compiler::Proof::hold ? 1 : 0;
    lagging += certificate.loop.amplifier_lag > 0 && certificate.loop.jitter > 0 ? 1 : 0;
    expect_no_energy_given_out(one, Random(seed + 1'000'000));
  }
  EXPECT_GE(by_hold, certified_devices() / 20);
  EXPECT_GE(lagging, certified_devices() / 20);
}

// If this failed, a certified law would give out more than the certificate states for an encoder with steps: nothing
// where friction pays, f_c ≥ K Δ/2, and else no more than (K Δ/2 − f_c) a metre. That the bound is about something:
// with a fiftieth of the friction some loops do give out energy.
TEST(CertifiedLoops, GiveOutNoMoreThanFrictionLeavesUnpaid) {
  int certified = 0, gave_out = 0;
  for (std::uint64_t seed = 1; certified < certified_devices(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    Random random(seed + 2'000'000);
    for (const double share : {0.02, 1.0}) gave_out += gives_out_no_more_than_unpaid(one, random, share) ? 1 : 0;
  }
  EXPECT_GT(gave_out, certified_devices() / 40);
}

// If this failed, a law would be stated for samples of one period on a device whose samples come early and late.
TEST(CertifiedLoops, LeaveNoJitterOut) {
  int lagging = 0;
  for (std::uint64_t seed = 1; seed <= 3 * repetitions(60, 2000); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation) continue;
    const compiler::Certificate& certificate = one.compilation->certificate;
    const bool is_lagging = certificate.loop.amplifier_lag > 0 && certificate.bound.proof != compiler::Proof::none;
    lagging += is_lagging ? 1 : 0;
    EXPECT_EQ(certificate.bound.constant_period_only, is_lagging && certificate.loop.is_punctual());
  }
  EXPECT_GE(lagging, 10);
}

}  // namespace
}  // namespace dashpot::testing
