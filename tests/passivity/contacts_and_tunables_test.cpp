// Certified laws behind contacts, and with parameters that change, in closed loop, held by random passive hands.
#include <gtest/gtest.h>

#include "random_cases.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

int certified_surfaces() { return static_cast<int>(repetitions(25, 1000)); }

// If this failed, a tool that touches and lets go, on a device with no more damping than the certificate asks for,
// would give out energy in some passive hand.
TEST(CertifiedContacts, NeverGiveOutEnergy) {
  int certified = 0, with_slips = 0;
  for (std::uint64_t seed = 1; certified < certified_surfaces(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = contact_case(seed, 1);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    with_slips += one.compilation->form.has_slips() ? 1 : 0;
    expect_no_energy_given_out(one, Random(seed + 4'000'000));
  }
  EXPECT_GT(with_slips, certified / 10);
}

// If this failed, a certified law whose parameters change at any time and as far as their ranges go would give out
// energy in some passive hand, beyond what a jump of the force brings that a change could not avoid; or such jumps
// would count for much.
TEST(CertifiedTunables, NeverGiveOutEnergyWhateverIsSet) {
  int certified = 0, by_hold = 0, with_slips = 0, without_jumps = 0;
  for (std::uint64_t seed = 1; certified < certified_surfaces(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = tunable_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    by_hold += one.compilation->certificate.bound.proof == Proof::hold ? 1 : 0;
    with_slips += one.compilation->law.tunable->couplings.empty() ? 0 : 1;
    without_jumps += expect_no_energy_given_out(one, Random(seed + 5'000'000), 0.02) ? 1 : 0;
  }
  EXPECT_GT(by_hold, certified / 10);
  EXPECT_GT(with_slips, certified / 10);
  EXPECT_GE(without_jumps, certified - certified / 50);
}

// If this failed, a law with slips, a contact or parameters would give out more than its certificate states for an
// encoder with steps; or K would be far above what any loop shows, with friction for a five-hundredth of it.
TEST(CertifiedSlipsContactsAndTunables, GiveOutNoMoreThanFrictionLeavesUnpaid) {
  int gave_out = 0, bounded = 0, touching = 0, tuned = 0, sliding = 0;
  for (std::uint64_t seed = 1; bounded < 2 * certified_surfaces(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = seed % 3 == 0   ? contact_case(seed, 1)
                             : seed % 3 == 1 ? tunable_case(seed)
                                             : slip_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified || !one.compilation->certificate.quantisation_gain)
      continue;
    if (one.device.description.brake.coil_lag > 0) continue;
    if (seed % 3 == 2 && (one.compilation->network.contact || !one.compilation->form.has_slips())) continue;
    ++bounded;
    touching += one.compilation->network.contact ? 1 : 0;
    tuned += one.compilation->law.tunable ? 1 : 0;
    sliding += one.compilation->form.has_slips() ? 1 : 0;
    Random random(seed + 6'000'000);
    for (const double share : {0.002, 1.0}) gave_out += gives_out_no_more_than_unpaid(one, random, share) ? 1 : 0;
  }
  EXPECT_GE(gave_out, certified_surfaces() / 20);
  EXPECT_GT(touching, bounded / 10);
  EXPECT_GT(tuned, bounded / 10);
  EXPECT_GT(sliding, bounded / 5);
}

}  // namespace
}  // namespace dashpot::testing
