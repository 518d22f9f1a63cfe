#include "certified_loop.hpp"

#include <algorithm>
#include <cmath>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/simulated/simulated_device.hpp>

#include <gtest/gtest.h>

#include "law/evaluate.hpp"
#include "support/random_network.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {

compiler::Device random_device(Random& random) {
  compiler::Device device;
  device.name = "random";
  device_description& d = device.description;
  d.loop.sample_period = random.log_uniform(2e-4, 4e-3);
  d.loop.delay_samples = random.chance(0.6) ? 0 : unsigned(random.between(1, 3));
  d.loop.jitter = random.chance(0.5) ? 0 : random.uniform(0, 0.5) * d.loop.sample_period;
  d.motor.amplifier_lag = random.chance(0.6) ? 0 : random.log_uniform(0.05, 2) * d.loop.sample_period;
  const estimator_kind estimators[] = {estimator_kind::backward_difference,
                                       estimator_kind::least_squares,
                                       estimator_kind::butterworth,
                                       estimator_kind::kalman,
                                       estimator_kind::foaw,
                                       estimator_kind::interval_difference};
  d.velocity.estimator = estimators[random.index(std::size(estimators))];
  d.velocity.window = unsigned(random.between(1, 20));
  d.velocity.order = random.chance(0.5) ? 2 : 4;
  d.velocity.cutoff = random.uniform(0.02, 0.3) / d.loop.sample_period;
  d.velocity.acceleration = random.log_uniform(0.1, 100);
  d.encoder.step = 1e-6;
  d.brake.kind = brake_kind::eddy_current;
  d.brake.max_damping = random.log_uniform(1, 1e6);
  d.brake.tolerance = random.chance(0.3) ? 0 : random.uniform(0, 0.2);
  d.mechanics.inertia = random.log_uniform(0.02, 1);
  d.mechanics.damping = random.chance(0.5) ? 0 : random.log_uniform(1e-3, 1);
  Random apart = random;  // what is drawn next is of the network
  if (apart.chance(0.3)) {
    d.loop.write_latest = apart.uniform(0, 1) * (d.loop.sample_period - d.loop.jitter);
    d.loop.write_earliest = apart.chance(0.5) ? d.loop.write_latest : apart.uniform(0, 1) * d.loop.write_latest;
  }
  return device;
}

CompiledCase random_case(std::uint64_t seed) {
  Random random(seed);
  CompiledCase one;
  one.device = random_device(random);
  NetworkRecipe recipe;
  recipe.topology = random.chance(0.8) ? Topology::tree : Topology::graph;
  recipe.most_nodes = 6;
  recipe.smallest_value = 1e-1;
  recipe.largest_value = 1e3;
  one.source = std::make_unique<compiler::SourceFile>("random.json", json_text(random_network(seed, recipe)));
  const char* names[] = {"faithful", "paper", "zero-frequency", "quietest-passive", "velocity-free", "virtual"};
  one.choices.decomposition = names[random.index(6)];
  one.choices.scheme = random.chance(0.7) ? compiler::Scheme::exact : compiler::Scheme::backward_euler;
  compiler::Diagnostics diagnostics;
  one.compilation = compile(*one.source, one.choices, one.device, diagnostics);
  return one;
}

simulated::hand random_hand(Random& random, double inertia, double frequency) {
  const double omega = 2 * 3.14159265358979 * frequency;
  switch (random.index(4)) {
    case 0: return simulated::no_hand();
    case 1: return simulated::mass_spring_damper(random.log_uniform(1e-3, 1e-1), 0, random.log_uniform(1, 100));
    case 2:
      return simulated::mass_spring_damper(0, random.chance(0.5) ? 0 : random.log_uniform(0.1, 10),
                                           random.log_uniform(100, 1e5));
    default: return simulated::mass_spring_damper(0, 0, inertia * omega * omega * random.uniform(0.8, 1.25));
  }
}

// The certificate speaks of a brake that is on: with a delay the first command is late, and the tool waits for it.
simulated::trajectory after(double begin, simulated::trajectory motion) {
  return [=](double time) { return time < begin ? simulated::motion_point{} : motion(time - begin); };
}

namespace {

// The device as it is described, apart from what the conditions say.
device_description simulated_description(const CompiledCase& one, const Conditions& conditions) {
  device_description d = one.device.description;
  if (one.compilation->certificate.bound.constant_period_only) {
    d.loop.jitter = 0;
    d.loop.write_earliest = d.loop.write_latest;
  }
  if (!conditions.encoder_steps) d.encoder.step = 0;
  d.encoder.rounding = conditions.rounding;
  d.mechanics.coulomb_friction = conditions.friction;
  return d;
}

simulated::scenario random_scenario(const CompiledCase& one, Random& random, const Conditions& conditions,
                                    const device_description& d) {
  const double brake_on = d.loop.delay_samples * (d.loop.sample_period + d.loop.jitter) + d.loop.write_latest;
  simulated::scenario scene;
  scene.user = random_hand(random, d.mechanics.inertia, std::max(one.compilation->certificate.bound.frequency, 1.0));
  const double depth = conditions.size * random.uniform(0, 0.02),
               frequency = random.log_uniform(0.5, 0.2 / d.loop.sample_period);
  scene.intended = after(brake_on, simulated::sine(depth, frequency));
  scene.initial_velocity = brake_on > 0 ? 0 : conditions.size * random.uniform(-0.2, 0.2);
  scene.gain = conditions.gain;
  scene.seed = random.index(1u << 30);
  return scene;
}

void look_at(const simulated::energy_ledger& ledger, const Conditions& conditions, RunOfLoop& run) {
  const double energy = ledger.brake + ledger.damping + ledger.friction - ledger.motor;
  const double travel = conditions.friction > 0 ? ledger.friction / conditions.friction : 0;
  run.least_energy = std::min(run.least_energy, energy);
  run.least_margin = std::min(run.least_margin, energy + conditions.unpaid_force * travel + run.jumps);
  run.largest_exchange = std::max({run.largest_exchange, ledger.brake, std::abs(ledger.motor), std::abs(ledger.hand)});
}

// What the law has been through, to ask what it would have done otherwise.
class History {
 public:
  explicit History(const compiler::UpdateLaw& law) : law_(law) {}

  void set(const std::vector<double>& values) { events_.push_back({true, 0, 0, values}); }
  void step(double position, double velocity) { events_.push_back({false, position, velocity, {}}); }

  // How far the force of a tool that rests would jump if the parameters became these [N].
  double jump_to(const std::vector<double>& values) const {
    const double position = events_.back().position;
    compiler::Evaluation<double> as_it_is(law_), changed(law_);
    for (compiler::Evaluation<double>* law : {&as_it_is, &changed}) {
      law->reset(0);
      for (const Event& event : events_)
        if (event.is_set) law->set(event.values);
        else law->step(event.position, event.velocity);
    }
    changed.set(values);
    return std::abs(as_it_is.step(position, 0).force - changed.step(position, 0).force);
  }

 private:
  struct Event {
    bool is_set;
    double position, velocity;
    std::vector<double> values;
  };

  const compiler::UpdateLaw& law_;
  std::vector<Event> events_;
};

struct Jump {
  double force;  // [N]
  int holds;     // that it is still held for
};

// The old force is held until a command of the new parameters acts: over one hold, the loop's delay and ten lags of the
// amplifier.
int holds_of_a_jump(const device_description& d) {
  return 1 + int(d.loop.delay_samples) + (d.loop.write_latest > 0 ? 1 : 0) +
         int(std::ceil(10 * d.motor.amplifier_lag / d.loop.sample_period));
}

}  // namespace

RunOfLoop run_loop(const CompiledCase& one, Random& random, const Conditions& conditions, int samples) {
  const device_description description = simulated_description(one, conditions);
  any_estimator<double> estimator(description.velocity, description.loop.sample_period,
                                  one.device.description.encoder.step);
  simulated_device device(description, random_scenario(one, random, conditions, description));
  compiler::Evaluation<double> law(one.compilation->law);
  law.reset(0);
  estimator.reset(0);
  RunOfLoop run;
  device_sample sample;
  const std::vector<compiler::Tunable> tunables = one.compilation->law.parameters();
  std::vector<double> values;
  for (const compiler::Tunable& tunable : tunables) values.push_back(tunable.range.value);
  History history(one.compilation->law);
  std::vector<Jump> jumps;
  double last_position = 0;
  const auto change = [&] {
    values = next_values(tunables, values, random);
    law.set(values);
    history.set(values);
  };
  if (!values.empty()) change();  // at rest
  for (int k = 0; k < samples && run.largest_exchange < 1e12; ++k) {
    device.read(sample);
    for (Jump& jump : jumps)
      if (jump.holds-- > 0) run.jumps += jump.force * std::abs(sample.position - last_position);
    last_position = sample.position;
    look_at(device.ledger(), conditions, run);
    const double velocity = estimator.update(sample);
    const command<double> now = law.step(sample.position, velocity);
    device.write({-now.force, now.damping});
    if (conditions.changes == 0) continue;
    history.step(sample.position, velocity);
    if (!random.chance(conditions.changes)) continue;
    Random same = random;
    jumps.push_back({history.jump_to(next_values(tunables, values, same)), holds_of_a_jump(description)});
    change();
  }
  return run;
}

bool expect_no_energy_given_out(const CompiledCase& one, Random random, double changes) {
  bool holds_anyhow = true;
  for (const simulated::brake_gain gain : {simulated::brake_gain::lowest, simulated::brake_gain::highest}) {
    Conditions conditions;
    conditions.gain = gain;
    conditions.changes = changes;
    const RunOfLoop run = run_loop(one, random, conditions, 1500);
    EXPECT_GE(run.least_margin, -1e-9 * run.largest_exchange);
    holds_anyhow = holds_anyhow && run.least_energy >= -1e-9 * run.largest_exchange;
  }
  return holds_anyhow;
}

namespace {

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
  return conditions.rounding == quantiser::floor
             ? one.compilation->certificate.quantisation_gain.value() * step * step / 8
             : 0;
}

}  // namespace

bool gives_out_no_more_than_unpaid(const CompiledCase& one, Random& random, double share) {
  bool gave_out = false;
  for (const simulated::brake_gain gain : {simulated::brake_gain::lowest, simulated::brake_gain::highest}) {
    Conditions conditions = with_encoder_steps(one, random, share);
    conditions.gain = gain;
    const RunOfLoop run = run_loop(one, random, conditions, 1500);
    EXPECT_GE(run.least_margin, -tension_at_start(one, conditions) - 1e-9 * run.largest_exchange) << "share " << share;
    gave_out = gave_out || run.least_energy < -tension_at_start(one, conditions) - 1e-3 * run.largest_exchange;
  }
  return gave_out;
}

}  // namespace dashpot::testing
