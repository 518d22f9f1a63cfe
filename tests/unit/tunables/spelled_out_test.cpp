// A law whose calls of the runtime are spelled out as statements against the same law with its calls.
#include "lower/spell_out.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "lower/shed.hpp"
#include "support/shrink.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

bool is_same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Every other one on a motor that gives little of what is asked for, some of them by steps.
compiler::UpdateLaw limited(const compiler::UpdateLaw& law, std::uint64_t seed) {
  if (seed % 2 == 0) return law;
  return compiler::with_shedding(law,
                                 {seed % 3 == 0 ? 0 : 0.05, seed % 4 == 1   ? 2e-3
                                                            : seed % 3 == 0 ? 1e-2
                                                                            : 0},
                                 motion::translation);
}

// As if it were behind a static curve, in front of which the tool moves by 0.1 mm from sample to sample.
compiler::UpdateLaw behind_map(compiler::UpdateLaw law) {
  double stiffest = 0;
  if (const int spring = law.tunable->head.static_spring; spring != no_index) {
    const compiler::TunableNumber& number =
        law.tunable->numbers[std::size_t(law.tunable->springs[std::size_t(spring)])];
    stiffest = number.base;
    for (const compiler::TunableTerm& term : number.terms)
      stiffest += term.share * law.tunable->tunables[term.tunable].range.max;
  }
  const auto nearest = [&](double value) {
    return law.scalar == compiler::ScalarType::float32 ? double(float(value)) : value;
  };
  law.tunable->head.map = {true, nearest(1e-4), nearest(stiffest)};
  return law;
}

template <class Scalar>
void expect_same_bits(const TunableLaw& compiled, std::uint64_t seed, bool is_behind_map) {
  const compiler::UpdateLaw called = limited(is_behind_map ? behind_map(compiled.law()) : compiled.law(), seed);
  const compiler::UpdateLaw spelled = compiler::spelled_out(called, motion::translation);
  compiler::Evaluation<Scalar> here(called), there(spelled);
  Random random(seed);
  std::vector<double> values = compiled.defaults();
  Scalar last = 0;
  int n = 0;
  for (const double walked : random_walk(random, 400)) {
    const auto position = static_cast<Scalar>(walked);
    if (random.chance(0.02)) {
      here.reset(position);
      there.reset(position);
    }
    if (random.chance(0.3)) {
      values = next_values(compiled.tunables(), values, random);
      const std::vector<Scalar> wanted(values.begin(), values.end());
      ASSERT_EQ(here.set(wanted), there.set(wanted)) << "seed " << seed << ", sample " << n;
      if (random.chance(0.2)) {
        const std::vector<double> others = next_values(compiled.tunables(), values, random);
        const std::vector<Scalar> again(others.begin(), others.end());
        ASSERT_EQ(here.set(again), there.set(again)) << "seed " << seed << ", sample " << n;
      }
    }
    const Scalar velocity = random.chance(0.01) ? Scalar(INFINITY) : (position - last) * Scalar(1000);
    const command<Scalar> a = here.step(position, velocity), b = there.step(position, velocity);
    ASSERT_TRUE(is_same(a.force, b.force) && is_same(a.damping, b.damping))
        << "seed " << seed << ", sample " << n << ": " << a.force << " and " << b.force;
    ASSERT_TRUE(is_same(here.stored_energy(), there.stored_energy()))
        << "seed " << seed << ", sample " << n << ": " << here.stored_energy() << " J and " << there.stored_energy();
    ASSERT_EQ(here.kept_share(), there.kept_share()) << "seed " << seed << ", sample " << n;
    last = position;
    ++n;
  }
}

void expect_same_bits(Kind kind, bool is_behind_map = false) {
  for (std::uint64_t seed = 1; seed <= repetitions(100, 5000); ++seed) {
    compiler::Choices choices;
    if (seed % 5 == 0) choices.scalar = compiler::ScalarType::float32;
    if (seed % 7 == 0) choices.scheme = compiler::Scheme::backward_euler;
    const TunableLaw compiled(tunable_network(seed, kind), choices);
    seed % 5 == 0 ? expect_same_bits<float>(compiled, seed, is_behind_map)
                  : expect_same_bits<double>(compiled, seed, is_behind_map);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

// A law in constant time, or one of many points, would be another one than the class that calls the runtime.
TEST(SpelledOut, branches_keep_their_bits) { expect_same_bits(Kind::parallel_branches); }
TEST(SpelledOut, trees_keep_their_bits) { expect_same_bits(Kind::tree); }
TEST(SpelledOut, meshes_keep_their_bits) { expect_same_bits(Kind::graph); }
TEST(SpelledOut, contacts_keep_their_bits) { expect_same_bits(Kind::touched); }
TEST(SpelledOut, branches_behind_a_curve_keep_their_bits) { expect_same_bits(Kind::parallel_branches, true); }
TEST(SpelledOut, meshes_behind_a_curve_keep_their_bits) { expect_same_bits(Kind::graph, true); }

// Slips would be solved by what takes as long as their values have it.
TEST(SpelledOut, is_nothing_for_slips) {
  const TunableLaw rubbing(R"({ "dashpot": 1, "name": "rubbing",
    "parameters": { "K": { "value": 200, "tunable": true, "min": 50, "max": 800 } },
    "network": { "parallel": [ { "spring": "K" }, { "series": [ { "spring": 900 }, { "slip": 0.5 } ] } ] } })");
  EXPECT_FALSE(compiler::can_be_spelled_out(rubbing.law()));
}

}  // namespace
}  // namespace dashpot::testing
