// Emitted code of random networks with slips against evaluate(), bit for bit.
#include <gtest/gtest.h>

#include <cstddef>

#include "slip_laws.hpp"
#include "slip_laws_emitted.hpp"

namespace dashpot::testing {
namespace {

template <class Law>
void expect_same_bits(std::uint64_t seed) {
  using Scalar = typename Law::scalar;
  const compiler::Compilation compilation = slip_law(seed);
  compiler::Evaluation<Scalar> simulated(compilation.law);
  Law emitted;
  simulated.reset(0);
  emitted.reset(0);
  Scalar last = 0;
  for (double u : random_motion(compilation.network, seed, 300)) {
    const auto position = static_cast<Scalar>(u);
    const Scalar velocity = (position - last) / Law::sample_period;
    const auto here = emitted.step(position, velocity), there = simulated.step(position, velocity);
    ASSERT_EQ(here.force, there.force) << compilation.network.name;
    ASSERT_EQ(here.damping, there.damping) << compilation.network.name;
    ASSERT_EQ(emitted.stored_energy(), simulated.stored_energy()) << compilation.network.name;
    last = position;
  }
}

}  // namespace

// If this failed, what `simulate` shows would not be what runs in the loop.
TEST(SlipEmission, IsWhatSimulateRuns) {
  std::size_t laws = 0;
  generated::for_each_slip_law([&]<class Law>(std::uint64_t seed) {
    expect_same_bits<Law>(seed);
    ++laws;
  });
  EXPECT_GE(laws, 36u);
}

}  // namespace dashpot::testing
