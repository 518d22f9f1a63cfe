// What a change of parameters may do to a law, and what not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "support/shrink.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

using Law = compiler::Evaluation<double>;

constexpr double period = 1e-3;  // [s]

std::size_t networks() { return repetitions(72, 20000); }

// V_k + T_k − V_{k−1} − T_{k−1} − f_k Δu_k at its worst, relative to the largest energy and work so far. The brake's
// part is at the true velocity, so that f is the whole force.
double worst_gain(const std::string& text, std::uint64_t seed) {
  const TunableLaw compiled(text);
  Random random(seed);
  Law law(compiled.law());
  std::vector<double> values = compiled.defaults();
  double stored = 0, last = 0, scale = 0, worst = 0, stiffest = 0;
  for (const compiler::TunableNumber& n : compiled.law().tunable->numbers) stiffest = std::max(stiffest, n.base);
  for (const compiler::Tunable& t : compiled.tunables()) stiffest = std::max(stiffest, t.range.max);
  for (double position : random_walk(random, 400)) {
    if (random.chance(0.3)) {
      values = next_values(compiled.tunables(), values, random);
      law.set(values);
      const double now = law.stored_energy();
      worst = std::max(worst, scale > 0 ? (now - stored) / scale : 0);
      stored = now;
    }
    const double change = position - last, velocity = change / period;
    const command<double> answer = law.step(position, velocity);
    const double work = (answer.damping * velocity + answer.force) * change, now = law.stored_energy();
    // An elongation is off by some 2⁻⁵² of the position: what that stores is rounding too, where nothing else is
    // stored.
    scale = std::max(scale, stiffest * position * position * 0x1p-64);
    scale = std::max(
        {scale, std::abs(work), now, std::abs(answer.damping * velocity * change), std::abs(answer.force * change)});
    worst = std::max(worst, (now - stored - work) / scale);
    stored = now;
    last = position;
  }
  return worst;
}

constexpr Kind all_kinds[] = {
    Kind::parallel_branches, Kind::tree,          Kind::graph,          Kind::slips,
    Kind::touched,           Kind::touched_slips, Kind::slips_in_graph, Kind::touched_slips_in_graph};

// A static spring, a Maxwell branch of 8 s, a Kelvin and a spring in series, all with a tunable.
const char* const pressed_network = R"({ "dashpot": 1, "name": "pressed",
  "parameters": { "K": { "value": 300, "tunable": true, "min": 0, "max": 1000 },
                  "K1": { "value": 12, "tunable": true, "min": 0, "max": 100 },
                  "B2": { "value": 5, "tunable": true, "min": 0.5, "max": 50 } },
  "network": { "parallel": [ { "spring": "K" },
    { "series": [ { "spring": "K1" }, { "damper": 100 } ] },
    { "series": [ { "spring": 200 }, { "parallel": [ { "spring": "K1" }, { "damper": "B2" } ] } ] } ] } })";

compiler::Choices feedthrough() {
  compiler::Choices choices;
  choices.decomposition = "velocity-free";
  return choices;
}

double whole_force(Law& law, double position, double last, double sample_period) {
  const double velocity = (position - last) / sample_period;
  const command<double> now = law.step(position, velocity);
  return now.damping * velocity + now.force;
}

// Of a change of all values while the tool is held, against the same law without; negative where there is no force. All
// have a spring between tool and ground.
double relative_jump(std::uint64_t seed, double rate) {
  compiler::Choices choices = feedthrough();
  choices.rate = rate;
  const TunableLaw compiled(tunable_network(seed, Kind::parallel_branches), choices);
  if (compiled.law().tunable->head.static_spring == compiler::no_index) return -1;
  Random random(seed);
  Law law(compiled.law()), unchanged(compiled.law());
  const auto walk = random_walk(random, 20);
  double last = 0;
  for (double position : walk)
    for (int n = 0; n < int(rate / 1e3); ++n) {
      law.step(position, 0);
      unchanged.step(position, 0);
      last = position;
    }
  // From somewhere in the range to somewhere else, twice: the tank is then as full as it is in use.
  for (int change = 0; change < 2; ++change) law.set(next_values(compiled.tunables(), compiled.defaults(), random));
  const double after = law.step(last, 0).force, before = unchanged.step(last, 0).force;
  return before == 0 ? -1 : std::abs(after - before) / std::abs(before);
}

// Some thousands of roundings of a step, each relative to the largest energy that has been.
constexpr double gain_rounding = 1e-12;

void expect_no_gain(Kind kind) {
  for (std::uint64_t seed = 1; seed <= networks(); ++seed) {
    const std::string text = tunable_network(seed, kind);
    ASSERT_LE(worst_gain(text, seed), gain_rounding) << "seed " << seed << ", " << text;
  }
}

// If this failed, a slider in a user's hand would drive the tool.
TEST(Set, InjectsNoEnergyIntoBranches) { expect_no_gain(Kind::parallel_branches); }
TEST(Set, InjectsNoEnergyIntoTrees) { expect_no_gain(Kind::tree); }
TEST(Set, InjectsNoEnergyIntoGraphs) { expect_no_gain(Kind::graph); }
TEST(Set, InjectsNoEnergyIntoSlips) { expect_no_gain(Kind::slips); }
TEST(Set, InjectsNoEnergyBehindAContact) { expect_no_gain(Kind::touched); }
TEST(Set, InjectsNoEnergyIntoSlipsBehindAContact) { expect_no_gain(Kind::touched_slips); }
TEST(Set, InjectsNoEnergyIntoSlipsOutsideTrees) { expect_no_gain(Kind::slips_in_graph); }
TEST(Set, InjectsNoEnergyIntoSlipsOutsideTreesBehindAContact) { expect_no_gain(Kind::touched_slips_in_graph); }

// Of a hand that presses while a spring is soft, lets it be made stiff, and goes back within the hold in which it is
// made soft again: what the force has given to it when all is over, with 0.6 N·s/m of damping beside the law. In every
// round, so that it adds up where it is below 0.
double taken_by_waiting_for_changes(bool holds_new_force) {
  const TunableLaw compiled(R"({ "dashpot": 1, "name": "spring",
    "parameters": { "K": { "value": 1000, "tunable": true, "min": 100, "max": 1000 } },
    "network": { "spring": "K" } })");
  constexpr double depth = 0.01, back = 0.0015, own_damping = 0.6;  // [m], [m], [N·s/m]
  Law law(compiled.law());
  double position = 0, held = 0, taken = 0;
  const auto sample = [&] { held = law.step(position, 0).force; };
  const auto go = [&](double to) {
    const double change = to - position;
    taken += held * change + own_damping * change * change / period;
    position = to;
    sample();
  };
  const auto set = [&](double stiffness) {
    law.set({stiffness});
    if (holds_new_force) held = law.output(position, 0).force;
  };
  sample();
  for (int round = 0; round < 12; ++round) {
    for (int k = 1; k <= 4000; ++k) go(depth * k / 4000);
    set(1000);
    for (int k = 0; k < 200; ++k) go(position);
    set(100);
    go(depth - back);
    for (int k = 1; k <= 4000; ++k) go((depth - back) * (1 - k / 4000.0));
    for (int k = 0; k < 200; ++k) go(position);
  }
  return taken;
}

// Fails if a change brings energy in although the force behind it is held at once, or if that is not needed: then the
// headers and compiler/theory.md ask for too much.
TEST(Set, PaysForTheHoldWhereTheNewForceIsHeldAtOnce) {
  EXPECT_GT(taken_by_waiting_for_changes(true), 0);
  EXPECT_LT(taken_by_waiting_for_changes(false), -0.05);
}

// If this failed, a change of parameters would spend what the tank holds back for forces that are still held: what is
// stored would fall below 0, and the next change would raise it again.
TEST(Set, NeverSpendsTheReserveForHeldForces) {
  compiler::Device device;
  device.name = "described";
  device.description.loop.sample_period = period;
  device.description.encoder.max_speed = 1;
  device.description.mechanics.damping = 5;
  std::size_t played = 0;
  for (std::uint64_t seed = 1; played < networks(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    device.description.loop.delay_samples = unsigned(random.index(3));
    compiler::Diagnostics diagnostics;
    const auto compiled = compiler::compile(
        compiler::SourceFile("random.json", tunable_network(seed, all_kinds[seed % 4])), {}, device, diagnostics);
    if (!compiled) continue;
    ++played;
    Law law(compiled->law);
    std::vector<double> values;
    for (const compiler::Tunable& t : compiled->law.tunable->tunables) values.push_back(t.range.value);
    double position = 0, largest = 0;
    for (int k = 0; k < 400; ++k) {
      const double speed = random.chance(0.3) ? 1 : random.log_uniform(1e-3, 1);
      position = std::clamp(position + (random.chance(0.5) ? speed : -speed) * period, -0.02, 0.02);
      law.step(position, 0);
      const double before = law.stored_energy();
      largest = std::max(largest, before);
      ASSERT_GE(before, -gain_rounding * largest) << k;
      if (!random.chance(0.2)) continue;
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = random.chance(0.5) ? compiled->law.tunable->tunables[i].range.max
                                       : compiled->law.tunable->tunables[i].range.min;
      law.set(values);
      ASSERT_LE(law.stored_energy(), before + gain_rounding * largest) << k;
    }
  }
}

// If this failed, what one spring's way home sets free or costs would be counted again for the next spring, and the
// tank would pay what it has not: this play, which a search found, took it to -0.3 mJ.
TEST(Set, PaysForEachSpringOnce) {
  compiler::Device device;
  device.name = "described";
  device.description.loop.sample_period = period;
  device.description.encoder.max_speed = 0.5;
  device.description.mechanics.damping = 5;
  compiler::Diagnostics diagnostics;
  const auto compiled =
      compiler::compile(compiler::SourceFile("three.json", R"({ "dashpot": 1, "name": "three", "parameters": {
        "K1": { "value": 200, "tunable": true, "min": 5, "max": 2000 },
        "K2": { "value": 600, "tunable": true, "min": 5, "max": 2000 },
        "K3": { "value": 600, "tunable": true, "min": 0, "max": 2000 } },
        "network": { "parallel": [ { "series": [ { "spring": "K1" }, { "spring": "K2" } ] },
                                   { "spring": "K3" } ] } })"),
                        {}, device, diagnostics);
  ASSERT_TRUE(compiled);
  Law law(compiled->law);
  double position = 0, largest = 0;
  const auto play = [&](double change, int samples) {
    for (int k = 0; k < samples; ++k) {
      law.step(position += change, 0);
      largest = std::max(largest, law.stored_energy());
      ASSERT_GE(law.stored_energy(), -gain_rounding * largest) << position;
    }
  };
  law.set({188.96, 7.7366, 0});
  play(1.5428e-4, 262);
  play(2.0457e-4, 290);
  law.set({5.0761, 5, 0});
  play(-2.6803e-4, 21);
  play(-3.7981e-5, 6);
  law.set({2000, 1102.3, 2000});
  play(-4.3933e-4, 18);
}

// If this failed, a sample that is late by the jitter, and the next one that is not, would leave the amplifier less
// time than is counted on, and a held force could give out more than the tank keeps back for it.
TEST(Set, KeepsBackWhatALaggingAmplifierHoldsUnderJitter) {
  compiler::Device device;
  device.name = "described";
  device.description.loop.sample_period = period;
  device.description.loop.jitter = 0.4 * period;
  device.description.motor.amplifier_lag = 2 * period;
  device.description.encoder.max_speed = 1;
  device.description.mechanics.damping = 5;
  compiler::Diagnostics diagnostics;
  const auto compiled =
      compiler::compile(compiler::SourceFile("pressed.json", pressed_network), {}, device, diagnostics);
  ASSERT_TRUE(compiled);
  const compiler::TunableHold& hold = compiled->law.tunable->head.hold;
  double most = 0;
  for (int sample = hold.samples - 1; sample < 200; ++sample)
    most += (period + 0.4 * period) * std::exp(-(sample * period - 0.4 * period) / (2 * period));
  EXPECT_GE(hold.rest, most);
  EXPECT_LE(hold.rest, most * (1 + 1e-12));
}

// A cycle of the stiffness [N/m] and of the tool's way from the sample before [m], which ends where it began but for
// rounding.
struct Cycle {
  double start;  // of the tool [m]
  std::vector<std::pair<double, double>> samples;
};

// Of a spring in a loop that is late by a sample, beside as much damping as its largest stiffness would ask for if it
// stayed as it is: what a cycle takes of the hand in 40 rounds, with the slow way to where it begins.
double taken_in_a_late_loop(const Cycle& cycle) {
  constexpr double own_damping = 1.5 * 800 * period;  // [N·s/m]
  compiler::Device device;
  device.name = "late";
  device.description.loop.sample_period = period;
  device.description.loop.delay_samples = 1;
  device.description.mechanics.damping = own_damping;
  compiler::Diagnostics diagnostics;
  const auto compiled = compiler::compile(compiler::SourceFile("spring.json", R"({ "dashpot": 1, "name": "spring",
    "parameters": { "K": { "value": 800, "tunable": true, "min": 50, "max": 800 } }, "network": { "spring": "K" } })"),
                                          {}, device, diagnostics);
  EXPECT_TRUE(compiled);
  if (!compiled) return 0;
  Law law(compiled->law);
  double position = 0, acting = 0, next = 0, taken = 0, drift = 0;
  const auto go = [&](double change) {
    taken += acting * change + own_damping * change * change / period;
    position += change;
    acting = std::exchange(next, law.step(position, 0).force);
  };
  for (const auto& [stiffness, change] : cycle.samples) drift += change / double(cycle.samples.size());
  for (int k = 0; k < 4000; ++k) go(cycle.start / 4000);
  for (int round = 0; round < 40; ++round)
    for (const auto& [stiffness, change] : cycle.samples) {
      law.set({stiffness});
      go(change - drift);
    }
  return taken;
}

// Fails if a spring that becomes softer in a late loop keeps more force than its elongation makes of it: larger forces
// of before the change still act then. A search found these cycles; with F √(k′/k) they gave out 14 and 28 mJ.
TEST(Set, PaysForForcesOfBeforeTheChangeThatStillAct) {
  const Cycle made_soft_in_steps = {
      -2.73e-3, {{800, -1.8e-4}, {800, -2.2e-4}, {800, -2.4e-4}, {800, -2.4e-4}, {800, -2.4e-4}, {800, -2.2e-4},
                 {800, -1.8e-4}, {800, -1.0e-4}, {313, 0.9e-4},  {313, 1.3e-4},  {313, 1.1e-4},  {313, 1.1e-4},
                 {313, 1.1e-4},  {313, 1.1e-4},  {313, 1.1e-4},  {313, 1.1e-4},  {313, 1.1e-4},  {313, 1.1e-4},
                 {313, 1.1e-4},  {366, 1.4e-4},  {50, 4.5e-4},   {50, 4.3e-4},   {50, 0.3e-4},   {800, -1.0e-4}}};
  const Cycle in_a_swing = {-4.17e-3,
                            {{800, -5.9e-4},
                             {800, -7.9e-4},
                             {800, -7.0e-4},
                             {800, -3.8e-4},
                             {349, 2.6e-4},
                             {349, 4.8e-4},
                             {349, 4.4e-4},
                             {349, 4.8e-4},
                             {349, 4.8e-4},
                             {349, 4.7e-4},
                             {349, 5.2e-4},
                             {50, 9.9e-4},
                             {50, 9.7e-4},
                             {50, 1.6e-4},
                             {50, 1.5e-4},
                             {606, -1.9e-4}}};
  EXPECT_GT(taken_in_a_late_loop(made_soft_in_steps), 0);
  EXPECT_GT(taken_in_a_late_loop(in_a_swing), 0);
}

// Fails if relaxations go on faster where the command is taken from a second output() of each sample.
TEST(Set, KeepsTheTimeWhereASampleIsPutOutTwice) {
  const TunableLaw compiled(pressed_network);
  Law once(compiled.law()), twice(compiled.law());
  std::vector<double> values = compiled.defaults();
  for (int k = 0; k < 2000; ++k) {
    const double position = 0.004 * std::sin(0.01 * k);
    const command<double> one = once.step(position, 0), other = twice.step(position, 0);
    ASSERT_EQ(one.force, other.force) << k;
    values[0] = 300 + 200 * std::sin(0.02 * k);
    once.set(values);
    twice.set(values);
    twice.output(position, 0);
  }
}

// If this failed, a slider that is not moved would be felt.
TEST(Set, ChangesNoBitWhereNothingChanges) {
  for (const Kind kind : all_kinds)
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const TunableLaw compiled(tunable_network(seed, kind));
      Random random(seed);
      Law law(compiled.law()), untouched(compiled.law());
      double last = 0;
      for (double position : random_walk(random, 200)) {
        ASSERT_EQ(law.set(compiled.defaults()), 0u);
        const auto here = law.step(position, (position - last) / period),
                   there = untouched.step(position, (position - last) / period);
        ASSERT_EQ(here.force, there.force) << "seed " << seed;
        ASSERT_EQ(here.damping, there.damping) << "seed " << seed;
        ASSERT_EQ(law.stored_energy(), untouched.stored_energy()) << "seed " << seed;
        last = position;
      }
    }
}

// If this failed, a NaN, or a value beyond the declared range, would reach the coefficients, or the caller not hear of
// it.
TEST(Set, ClampsAndSaysWhich) {
  const TunableLaw compiled(pressed_network);
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  Law law(compiled.law()), same(compiled.law());
  const auto expect_same_as = [&](std::vector<double> given, unsigned bits, std::vector<double> taken) {
    EXPECT_EQ(law.set(given), bits);
    EXPECT_EQ(same.set(taken), 0u);
    law.reset(), same.reset();
    for (double position : {1e-3, 5e-3, 4e-3}) EXPECT_EQ(law.step(position, 0.1).force, same.step(position, 0.1).force);
    EXPECT_EQ(law.step(0.01, 0).damping, same.step(0.01, 0).damping);
  };
  expect_same_as({300, 12, 5}, 0, {300, 12, 5});
  expect_same_as({nan, 13, 5}, 1, {300, 13, 5});
  expect_same_as({infinity, 13, -infinity}, 5, {1000, 13, 0.5});
  expect_same_as({-1, 1e6, 5}, 3, {0, 100, 5});
  expect_same_as({nan, nan, nan}, 7, {0, 100, 5});
}

// If this failed, a change would be felt as a knock. What is left is what relaxes within a sample, which goes with the
// period.
TEST(Set, LeavesTheForceWhereItWas) {
  double last_median = 0;
  for (const double rate : {1e3, 1e4, 1e5}) {
    std::vector<double> jumps;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      const double jump = relative_jump(seed, rate);
      if (jump >= 0) jumps.push_back(jump);
    }
    ASSERT_GE(jumps.size(), 100u);
    std::nth_element(jumps.begin(), jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2), jumps.end());
    const double median = jumps[jumps.size() / 2];
    EXPECT_LE(median, rate > 1e3 ? 0.15 * last_median + 1e-12 : 1) << rate;
    last_median = median;
  }
  EXPECT_LE(last_median, 1e-4);
}

// If this failed, a slider that trembles would let go of the tissue: displacements that shrink with every change lose
// all force in a second.
TEST(Set, KeepsTheForceWhileAValueTrembles) {
  const TunableLaw compiled(pressed_network);
  Law law(compiled.law()), still(compiled.law());
  std::vector<double> values = compiled.defaults();
  double last = 0;
  for (int n = 0; n < 1500; ++n) {
    const double position = std::min(5e-3, n * 1e-5);
    if (n >= 500)
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = compiled.defaults()[i] * (n % 2 == 0 ? 0.99 : 1);
    law.set(values);
    const double here = whole_force(law, position, last, period), there = whole_force(still, position, last, period);
    EXPECT_NEAR(here, there, 0.011 * there + 1e-12) << n;
    last = position;
  }
}

// If this failed, coefficients would depend on the way that led to them.
TEST(Set, HasTheCoefficientsOfTheLawCompiledAtItsValues) {
  for (const Kind kind : all_kinds)
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const TunableLaw compiled(tunable_network(seed, kind), feedthrough());
      Random random(seed);
      Law law(compiled.law());
      const std::vector<double> values = next_values(compiled.tunables(), compiled.defaults(), random);
      compiler::UpdateLaw other = compiled.law();
      for (std::size_t i = 0; i < values.size(); ++i) other.tunable->tunables[i].range.value = values[i];
      Law born(other);
      law.step(1e-3, 1);
      law.set(values);
      law.reset();
      for (double position : random_walk(random, 100))
        ASSERT_EQ(law.step(position, 1).force, born.step(position, 1).force) << seed;
    }
}

// If this failed, what a rise of stiffness owes would be owed for ever.
TEST(Set, DebtOfARiseEndsWhenTheToolHasLeft) {
  const TunableLaw compiled(pressed_network);
  Law changed(compiled.law()), born(compiled.law());
  const std::vector<double> values = {900, 100, 2};
  born.set(values);
  double last = 0;
  bool was_owing = false;
  for (int n = 0; n < 36000; ++n) {
    const double position = n < 1000 ? 5e-3 : n < 2000 ? 0 : n < 34000 ? 1e-3 : 2e-3;
    if (n == 500) changed.set(values);
    const double here = whole_force(changed, position, last, period), there = whole_force(born, position, last, period);
    was_owing = was_owing || (n > 500 && n < 1000 && here < 0.9 * there);
    EXPECT_NEAR(here, there, n >= 34000 ? 1e-9 : 10) << n;
    last = position;
  }
  EXPECT_TRUE(was_owing) << "the rise of stiffness was paid for by nobody";
}

}  // namespace
}  // namespace dashpot::testing
