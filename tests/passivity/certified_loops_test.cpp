// Certified laws in closed loop on the simulated device, held by random passive hands.
#include <gtest/gtest.h>

#include <cstdlib>

#include "certified_loop.hpp"

namespace dashpot::testing {
namespace {

int cases() { return std::getenv("DASHPOT_LONG") != nullptr ? 2000 : 100; }

// A certified law would give out more energy than it took up: with ideal sensors the energy that motor, brake and
// mechanics have taken up together is never below zero, the brake at either end of its tolerance, with jitter where the
// hold certificate covers it.
TEST(CertifiedLoops, NeverGiveOutEnergy) {
  int certified = 0, by_hold = 0;
  for (std::uint64_t seed = 1; certified < cases(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    by_hold += one.compilation->certificate.bound.proof == compiler::Proof::hold ? 1 : 0;
    expect_no_energy_given_out(one, Random(seed + 1'000'000));
  }
  EXPECT_GE(by_hold, cases() / 20);
}

// Motions of two to two hundred steps of the encoder, and friction that pays for `share` of what the step stirs up.
Conditions with_encoder_steps(const CompiledCase& one, Random& random, double share) {
  const double most = one.compilation->certificate.quantisation_gain.value() * one.device.description.encoder.step / 2;
  Conditions conditions;
  conditions.encoder_steps = true;
  conditions.rounding = random.chance(0.5) ? quantiser::floor : quantiser::round;
  conditions.friction = share * most;
  conditions.unpaid_force = std::max(1 - share, 0.0) * most;
  conditions.size = random.log_uniform(1e-4, 1e-2);
  return conditions;
}

// K Δ²/8, with which a flooring encoder starts.
double tension_at_start(const CompiledCase& one, const Conditions& conditions) {
  const double step = one.device.description.encoder.step;
  return conditions.rounding == quantiser::floor ? one.compilation->certificate.quantisation_gain.value() * step * step / 8 : 0;
}

// A certified law would give out more than the certificate states for an encoder with steps: nothing where friction pays,
// f_c ≥ K Δ/2, and else no more than (K Δ/2 − f_c) a metre. That the bound is about something: with a fiftieth of the
// friction some loops do give out energy.
TEST(CertifiedLoops, GiveOutNoMoreThanFrictionLeavesUnpaid) {
  int certified = 0, gave_out = 0;
  for (std::uint64_t seed = 1; certified < cases(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = random_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    ++certified;
    Random random(seed + 2'000'000);
    for (const simulated::brake_gain gain : {simulated::brake_gain::lowest, simulated::brake_gain::highest})
      for (const double share : {0.02, 1.0}) {
        Conditions conditions = with_encoder_steps(one, random, share);
        conditions.gain = gain;
        const RunOfLoop run = run_loop(one, random, conditions, 1500);
        EXPECT_GE(run.least_margin, -tension_at_start(one, conditions) - 1e-9 * run.largest_exchange) << "share " << share;
        if (share < 1 && run.least_energy < -tension_at_start(one, conditions) - 1e-3 * run.largest_exchange) ++gave_out;
      }
  }
  EXPECT_GE(gave_out, cases() / 40);
}

}  // namespace
}  // namespace dashpot::testing
