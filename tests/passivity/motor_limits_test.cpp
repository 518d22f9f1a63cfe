// What is said of the motor's limit and slew, against motions that take as much energy as they can: from sample to
// sample the tool may go anywhere, often to where it takes most, and the brake takes what a constant damping takes at a
// constant speed over a hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <deque>
#include <vector>

#include "certify/motor_limits.hpp"
#include "law/evaluate.hpp"
#include "lower/begun_at_rest.hpp"
#include "lower/shed.hpp"
#include "random_cases.hpp"
#include "support/random_network.hpp"
#include "support/repetitions.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

int runs() { return static_cast<int>(repetitions(48, 10'000)); }

// A motor that gives little of what is asked for, behind a lag or, with a chance of `prompt`, not.
void limit(CompiledCase& one, Random& random, double prompt = 0.7) {
  device_description& d = one.device.description;
  d.motor.amplifier_lag = random.chance(prompt) ? 0 : random.log_uniform(0.05, 2) * d.loop.sample_period;
  d.motor.max_torque = random.log_uniform(1e-3, 1e1);
  Diagnostics diagnostics;
  one.compilation = compile(*one.source, one.choices, one.device, diagnostics);
}

CompiledCase linear_case(std::uint64_t seed, const char* decomposition) {
  CompiledCase one;
  Random random(seed);
  one.device = random_device(random);
  NetworkRecipe recipe;
  recipe.most_nodes = 6;
  recipe.smallest_value = 1e-1;
  recipe.largest_value = 1e3;
  one.source = std::make_unique<SourceFile>("random.json", json_text(random_network(seed, recipe)));
  one.choices.decomposition = decomposition;
  one.choices.state_input = StateInput::position;
  one.choices.scheme = random.chance(0.7) ? Scheme::exact : Scheme::backward_euler;
  limit(one, random);
  return one;
}

void set_at_random(Evaluation<double>& law, const TunableTables& tables, Random& random) {
  std::vector<double> values;
  for (const Tunable& t : tables.tunables) values.push_back(random.uniform(t.range.min, t.range.max));
  law.set(values);
}

// Least energy that has gone in, over the largest exchanged in a period, while a hold takes `damping` [N·s/m].
struct Balance {
  double least = 0;
  int limited = 0;  // samples at which the limit was felt
};

Balance balance_of(const CompiledCase& one, double damping, Random random, int samples) {
  const device_description& d = one.device.description;
  const UpdateLaw& update = one.compilation->law;
  Evaluation<double> law(update);
  law.reset(0);
  any_estimator<double> estimator(d.velocity, d.loop.sample_period, d.encoder.step);
  estimator.reset(0);
  std::deque<double> late(d.loop.delay_samples, 0);
  const double lag = d.motor.amplifier_lag, limit = one.compilation->certificate.loop.max_force;
  double energy = 0, least = 0, largest = 0, position = 0, pace = 1e-3, made = 0, told = 0;
  int way = 3;
  Balance balance;
  // The next motion, for so long, while the motor is told `told`.
  const auto move = [&](double duration, bool rests) {
    const double kept = lag > 0 ? std::exp(-duration / lag) : 0, mean = lag > 0 ? lag / duration * (1 - kept) : 0;
    const double force = told + (made - told) * mean;  // over the motion, at a constant speed
    made = told + (made - told) * kept;
    const double most = damping > 0 ? -force * duration / (2 * damping) * random.uniform(0.5, 1.5) : 0;
    const double wild = random.chance(0.5) ? most : random.chance(0.2) ? 0 : pace * random.uniform(-1, 1);
    // Pressed, held, or slowly let go of in between.
    double change = way == 0 ? -0.02 * position : way == 1 ? pace / 20 : way == 2 ? 0 : wild;
    if (rests) change = 0;
    const double work = force * change + damping / duration * change * change;
    energy += work;
    least = std::min(least, energy);
    largest = std::max(largest, std::abs(work));
    position += change;
  };
  for (int k = 0; k < samples; ++k) {
    device_sample sample{};
    sample.position = position;
    late.push_back(law.step(position, estimator.update(sample)).force);
    const double wanted = late.front();
    late.pop_front();
    const double next = std::clamp(wanted, -limit, limit);
    balance.limited += next != wanted || (law.kept_share() < 1) ? 1 : 0;
    const double hold = d.loop.sample_period + (lag == 0 && random.chance(0.5) ? d.loop.jitter : 0);
    if (random.chance(0.05)) pace = random.log_uniform(1e-6, 1e2);
    if (random.chance(0.02)) way = static_cast<int>(random.index(4));
    const double wait = lag == 0 && random.chance(0.5) ? d.loop.write_earliest : d.loop.write_latest;
    if (wait > 0) move(wait, false);
    told = next;
    const bool changes = update.tunable && random.chance(0.02);
    if (changes) set_at_random(law, *update.tunable, random);
    move(hold - wait, changes);  // moving, the command that is held would be of a force that is no more
  }
  balance.least = largest > 0 ? least / largest : 0;
  return balance;
}

const MotorLimits& limits_of(const CompiledCase& one) { return one.compilation->certificate.limits; }

// If this failed, a spring pressed beyond what the motor gives would give out energy, or ask for more damping than one
// that never is.
TEST(MotorLimits, ClippedLinearLawsGiveOutNoEnergy) {
  int covered = 0, late = 0, lagging = 0, limited = 0;
  for (std::uint64_t seed = 1; covered < runs(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = linear_case(seed, "velocity-free");
    if (!one.compilation || limits_of(one).rule != LimitRule::clamps || limits_of(one).needed == 0) continue;
    ++covered;
    late += one.device.description.loop.delay_samples > 0 ? 1 : 0;
    lagging += one.device.description.motor.amplifier_lag > 0 ? 1 : 0;
    EXPECT_FALSE(one.compilation->law.sheds());
    const Balance balance = balance_of(one, limits_of(one).needed, Random(seed), 1000);
    limited += balance.limited > 0 ? 1 : 0;
    EXPECT_GE(balance.least, -1e-9);
  }
  EXPECT_GT(late, covered / 20);
  EXPECT_GT(lagging, covered / 20);
  EXPECT_GT(limited, covered / 2);
}

// If this failed, the statement would not depend on what is proved: the same far below the damping that it asks for
// gives out energy.
TEST(MotorLimits, ClippedLinearLawsNeedTheirDamping) {
  int tried = 0, gained = 0;
  for (std::uint64_t seed = 1; tried < runs() / 4; ++seed) {
    const CompiledCase one = linear_case(seed, "velocity-free");
    if (!one.compilation || limits_of(one).rule != LimitRule::clamps || !(limits_of(one).needed > 0)) continue;
    if (one.device.description.loop.delay_samples > 0 || one.device.description.motor.amplifier_lag > 0) continue;
    ++tried;
    gained += balance_of(one, 0.3 * limits_of(one).needed, Random(seed), 1000).least < -1e-6 ? 1 : 0;
  }
  EXPECT_GT(gained, tried / 3);
}

// If this failed, a law that follows an estimate of the velocity would give out energy where it sheds.
TEST(MotorLimits, SheddingLawsWithAnEstimateGiveOutNoEnergy) {
  int covered = 0, late = 0, limited = 0;
  for (std::uint64_t seed = 1; covered < runs(); ++seed) {
    SCOPED_TRACE(seed);
    const CompiledCase one = linear_case(seed, seed % 2 == 0 ? "virtual" : "paper");
    if (!one.compilation || limits_of(one).rule != LimitRule::sheds || !(limits_of(one).needed > 0)) continue;
    ++covered;
    EXPECT_TRUE(one.compilation->law.sheds());
    late += one.device.description.loop.delay_samples > 0 ? 1 : 0;
    const Balance balance = balance_of(one, limits_of(one).needed, Random(seed), 1000);
    limited += balance.limited > 0 ? 1 : 0;
    EXPECT_GE(balance.least, -1e-9);
  }
  EXPECT_GT(late, covered / 20);
  EXPECT_GT(limited, covered / 2);
}

// If this failed, a slip that yields, or a contact, beyond what the motor gives would give out energy.
TEST(MotorLimits, SheddingSlipsAndContactsGiveOutNoEnergy) {
  int covered = 0, touching = 0, late = 0, limited = 0;
  for (std::uint64_t seed = 1; covered < runs(); ++seed) {
    SCOPED_TRACE(seed);
    CompiledCase one = slip_case(seed);
    if (!one.compilation) continue;
    Random random(seed);
    limit(one, random);
    if (!one.compilation || limits_of(one).rule != LimitRule::sheds || !(limits_of(one).needed > 0)) continue;
    if (one.compilation->law.brake_changes() && !one.compilation->network.contact) continue;  // the brake's own excess
    ++covered;
    touching += one.compilation->network.contact ? 1 : 0;
    late += one.device.description.loop.delay_samples > 0 ? 1 : 0;
    const Balance balance = balance_of(one, limits_of(one).needed, Random(seed), 1000);
    limited += balance.limited > 0 ? 1 : 0;
    EXPECT_GE(balance.least, -1e-9);
  }
  EXPECT_GT(touching, covered / 20);
  EXPECT_GT(late, covered / 20);
  EXPECT_GT(limited, covered / 2);
}

// If this failed, parameters that change while the motor is at its limit would give out energy, or what was shed would
// come back.
TEST(MotorLimits, SheddingTunablesGiveOutNoEnergy) {
  int covered = 0, slipping = 0, limited = 0;
  for (std::uint64_t seed = 1; covered < runs() / 4; ++seed) {
    SCOPED_TRACE(seed);
    CompiledCase one = tunable_case(seed);
    if (!one.compilation || !one.compilation->certificate.certified) continue;
    Random random(seed);
    one.device.description.loop.delay_samples = 0;
    limit(one, random, 1);
    if (!one.compilation || limits_of(one).rule != LimitRule::sheds || !limits_of(one).is_covered) continue;
    ++covered;
    slipping += one.compilation->form.has_slips() ? 1 : 0;
    const Balance balance = balance_of(one, limits_of(one).needed, Random(seed), 1000);
    limited += balance.limited > 0 ? 1 : 0;
    EXPECT_GE(balance.least, -1e-9);
  }
  EXPECT_GT(slipping, covered / 20);
  EXPECT_GT(limited, covered / 2);
}

// If this failed, shedding would be free: the same far below the damping that it asks for gives out energy, where slips
// do not take it up.
TEST(MotorLimits, SheddingSlipsNeedTheirDamping) {
  int tried = 0, gained = 0;
  for (std::uint64_t seed = 1; tried < runs() / 4; ++seed) {
    CompiledCase one = slip_case(seed);
    if (!one.compilation) continue;
    Random random(seed);
    limit(one, random);
    if (!one.compilation || limits_of(one).rule != LimitRule::sheds || !(limits_of(one).needed > 0)) continue;
    if (one.compilation->law.brake_changes() || one.device.description.motor.amplifier_lag > 0) continue;
    ++tried;
    gained += balance_of(one, 0.2 * limits_of(one).needed, Random(seed), 1000).least < -1e-9 ? 1 : 0;
  }
  EXPECT_GT(gained, tried / 10) << gained << " of " << tried;
}

// A law with these limits of a motor, where there are any.
UpdateLaw with_limits(UpdateLaw law, const std::optional<MotorReach>& reach) {
  if (!reach) return law;
  return begun_at_rest(with_shedding(told_of_motor(std::move(law), *reach), *reach, motion::translation));
}

// A network on an ideal device, without an estimate of the velocity.
UpdateLaw velocity_free_law(const std::string& structure) {
  const SourceFile source("structure.json", R"({ "dashpot": 1, "name": "structure", )" + structure + " }");
  Diagnostics diagnostics;
  Choices choices;
  choices.decomposition = std::string("velocity-free");
  return compile(source, choices, std::nullopt, diagnostics).value().law;
}

// 1 kN/m on a motor of limited slew, by a law that sheds or by one that does not know: pressed fast, held, and slowly
// let go of. The motor goes to what it is told as fast as it can. Out: the energy that has gone in [J].
double pressed_and_let_go(const std::string& structure, bool sheds) {
  const double period = 1e-3, slew = 2000;
  const auto reach = sheds ? std::optional(MotorReach{0, slew * period}) : std::nullopt;
  const UpdateLaw update = with_limits(velocity_free_law(structure), reach);
  Evaluation<double> law(update);
  law.reset(0);
  double energy = 0, position = 0, made = 0;
  const auto move_by = [&](double change) {
    const double told = law.step(position, 0).force,
                 reached = std::clamp(told, made - slew * period, made + slew * period);
    const double ramp = std::abs(told - made) / slew, share = std::min(ramp / period, 1.0);
    energy += (reached * (1 - share) + (made + reached) / 2 * share) * change + 1e-3 / period * change * change;
    made = reached;
    position += change;
  };
  for (int k = 0; k < 4; ++k) move_by(0.01);
  for (int k = 0; k < 100; ++k) move_by(0);
  for (int k = 0; k < 400; ++k) move_by(-position / (400 - k));
  return energy;
}

// If this failed, what the motor cannot follow would be given back: a spring that is pressed while the motor is late
// takes nothing, and gives all of ½ K u² back.
TEST(MotorLimits, SlewGivesNothingBackThatItDidNotTake) {
  for (const char* structure : {R"("network": { "spring": "1 kN/m" })",
                                R"("network": { "series": [{ "spring": "1 kN/m" }, { "damper": "1 kN s/m" }] })",
                                R"("network": { "series": [{ "spring": "1 kN/m" }, { "slip": "100 N" }] })",
                                R"("contact": { "at": 0 }, "network": { "spring": "1 kN/m" })",
                                R"("parameters": { "K": { "value": "1 kN/m", "tunable": true, "min": 10, "max": 1e4 } },
                                   "network": { "spring": "K" })",
                                R"("parameters": { "K": { "value": "1 kN/m", "tunable": true, "min": 10, "max": 1e4 } },
                                   "contact": { "at": 0 }, "network": { "spring": "K" })",
                                R"("parameters": { "B": { "value": 1e3, "tunable": true, "min": 10, "max": 1e4 } },
                                   "network": { "series": [{ "spring": "1 kN/m" }, { "damper": "B" }] })",
                                R"("parameters": { "B": { "value": 1e3, "tunable": true, "min": 10, "max": 1e4 } },
                                   "network": { "series": [{ "spring": "1 kN/m" },
                                                           { "parallel": [{ "damper": "B" }, { "spring": 1e3 }] }] })"}) {
    EXPECT_LT(pressed_and_let_go(structure, false), -0.3) << structure;
    EXPECT_GE(pressed_and_let_go(structure, true), 0) << structure;
  }
}

// 1 kN/m on a motor of 2 N: pressed in by 100 mm, made ten times softer there, and let go of until nothing pushes any
// more, before offsets are home. Out: the energy that has gone in [J].
double pressed_softened_and_let_go(const std::string& structure, bool sheds) {
  const double limit = 2;
  const auto reach = sheds ? std::optional(MotorReach{limit, 0}) : std::nullopt;
  const UpdateLaw update = with_limits(velocity_free_law(structure), reach);
  Evaluation<double> law(update);
  law.reset(0);
  double energy = 0, position = 0, force = 0, beta = 500;
  const auto move_by = [&](double change) {
    force = std::clamp(law.step(position, 0).force, -limit, limit);
    energy += (force + beta * change) * change;
    position += change;
  };
  for (int k = 0; k < 400; ++k) move_by(2.5e-4);
  move_by(0);
  law.set({100});
  beta = 50;
  move_by(0);
  for (int k = 0; k < 4000 && (force > 0 || k == 0); ++k) move_by(-2e-3);
  return energy;
}

// If this failed, what the motor never took in would be kept as the force of a softer spring, and come out over a
// longer way.
TEST(MotorLimits, SofteningGivesNothingBackThatWasShed) {
  const std::string of_spring = R"("parameters": { "K": { "value": 1e3, "tunable": true, "min": 100, "max": 1e3 } }, )";
  for (const std::string& structure : {of_spring + R"("network": { "spring": "K" })",
                                       of_spring + R"("contact": { "at": 0 }, "network": { "spring": "K" })"}) {
    EXPECT_LT(pressed_softened_and_let_go(structure, false), -0.1) << structure;
    EXPECT_GE(pressed_softened_and_let_go(structure, true), 0) << structure;
  }
}

// If this failed, commands of a law that sheds would be beyond what the motor can follow, or a law would be changed
// where it can.
TEST(MotorLimits, CommandsStayWithinLimitAndSlew) {
  int shed = 0;
  for (std::uint64_t seed = 1; seed <= std::uint64_t(runs()); ++seed) {
    SCOPED_TRACE(seed);
    CompiledCase one = seed % 3 == 0   ? slip_case(seed)
                       : seed % 3 == 1 ? tunable_case(seed)
                                       : linear_case(seed, "virtual");
    if (!one.compilation || one.compilation->law.sheds()) continue;
    Random random(seed);
    const UpdateLaw& plain = one.compilation->law;
    const MotorReach reach = {random.log_uniform(1e-3, 1), random.chance(0.5) ? random.log_uniform(1e-4, 1) : 0};
    const UpdateLaw wide = with_limits(plain, MotorReach{1e300, reach.step > 0 ? 1e300 : 0});
    const UpdateLaw narrow = with_limits(plain, reach);
    Evaluation<double> alone(plain), free(wide), held(narrow);
    for (Evaluation<double>* law : {&alone, &free, &held}) law->reset(0);
    double position = 0, last = 0;
    for (int k = 0; k < 300; ++k) {
      const double velocity = random.uniform(-1, 1);
      const command<double> expected = alone.step(position, velocity), same = free.step(position, velocity);
      ASSERT_EQ(expected.force, same.force) << k;
      ASSERT_EQ(alone.stored_energy(), free.stored_energy()) << k;
      const double force = held.step(position, velocity).force;
      ASSERT_LE(std::abs(force), reach.limit);
      if (reach.step > 0) {
        ASSERT_LE(std::abs(force - last), reach.step * (1 + 1e-12));
      }
      shed += held.kept_share() < 1 ? 1 : 0;
      last = force;
      position += random.log_uniform(1e-6, 1e-1) * random.uniform(-1, 1);
    }
  }
  EXPECT_GT(shed, runs());
}

// If this failed, a puncture would cost more than the spring held, or the largest that is told would not be the
// largest: the motor falls by ρT a period and the tool takes from every hold what it can, e²T/4x.
TEST(MotorLimits, PuncturesWithinTheSlewCostNoMoreThanTheyRelease) {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= std::uint64_t(runs()); ++seed) {
    Random random(seed);
    const double stiffness = random.log_uniform(10, 1e4), slew = random.log_uniform(10, 1e5),
                 spare = random.log_uniform(0.1, 100), period = random.log_uniform(1e-5, 1e-3);
    const double most = covered_discontinuity(slew, spare, stiffness, period);
    if (most < slew * period) continue;
    ++tried;
    const auto cost_over_release = [&](double force) {
      double cost = 0;
      for (double left = force; left > 0; left -= slew * period) cost += left * left * period / (4 * spare);
      return cost / (force * force / (2 * stiffness));
    };
    EXPECT_LE(cost_over_release(most * (1 - 1e-9)), 1 + 1e-9) << seed;
    EXPECT_GT(cost_over_release(most * 1.5), 1) << seed;
  }
  EXPECT_GT(tried, runs() / 10);
  // 1000 N/m, 2000 N/s, x = 2: 24 N for an analogue slew, which short periods come near.
  EXPECT_NEAR(covered_discontinuity(2000, 2, 1000, 1e-6), 24, 0.01);
}

}  // namespace
}  // namespace dashpot::testing
