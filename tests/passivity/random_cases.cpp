#include "random_cases.hpp"

#include "support/random_network.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {

using namespace dashpot::compiler;

namespace {

std::string with_contact(std::string text) { return text.insert(1, "\n  \"contact\": { \"at\": 0 },"); }

void compile_again(CompiledCase& one) {
  Diagnostics diagnostics;
  one.compilation = compile(*one.source, one.choices, one.device, diagnostics);
}

}  // namespace

CompiledCase slip_case(std::uint64_t seed, bool lags, const char* law) {
  Random random(seed);
  CompiledCase one;
  one.device = random_device(random);
  device_description& d = one.device.description;
  d.motor.amplifier_lag = lags ? random.log_uniform(0.05, 2) * d.loop.sample_period : 0;
  d.velocity.estimator = random.chance(0.5) ? estimator_kind::backward_difference : estimator_kind::butterworth;
  d.brake.coil_lag = lags || random.chance(0.5) ? 0 : random.log_uniform(0.1, 10) * d.loop.sample_period;
  const bool touches = !lags && random.chance(0.3);
  if (touches) d.loop.delay_samples = random.chance(0.7) ? 0 : 1;
  d.mechanics.damping = touches ? 1e7 : d.mechanics.damping;
  NetworkRecipe recipe;
  recipe.topology = random.chance(0.7) ? Topology::tree : Topology::graph;
  recipe.most_nodes = 6;
  recipe.most_slips = recipe.topology == Topology::tree ? 6 : 5;
  recipe.smallest_value = 1e-1;
  recipe.largest_value = 1e3;
  const std::string text = json_text(random_network(seed, recipe));
  one.source = std::make_unique<SourceFile>("random.json", touches ? with_contact(text) : text);
  const char* laws[] = {"faithful", "paper", "velocity-free", "gated", "steady", "ramped", "virtual"};
  const char* const any = laws[random.index(7)];
  one.choices.decomposition = law != nullptr ? law : any;
  one.choices.scheme = random.chance(0.7) ? Scheme::exact : Scheme::backward_euler;
  compile_again(one);
  return one;
}

CompiledCase contact_case(std::uint64_t seed, double share) {
  Random random(seed);
  CompiledCase one;
  one.device = random_device(random);
  device_description& d = one.device.description;
  d.loop.delay_samples = 0;
  d.motor.amplifier_lag = 0;
  d.velocity.estimator = random.chance(0.5) ? estimator_kind::backward_difference : estimator_kind::butterworth;
  d.mechanics.damping = 1e7;
  NetworkRecipe recipe;
  recipe.topology = random.chance(0.7) ? Topology::tree : Topology::graph;
  recipe.most_nodes = 5;
  recipe.most_slips = random.chance(0.5) ? 3 : 0;
  recipe.smallest_value = 1e-1;
  recipe.largest_value = 1e3;
  one.source = std::make_unique<SourceFile>("random.json", with_contact(json_text(random_network(seed, recipe))));
  one.choices.scheme = random.chance(0.7) ? Scheme::exact : Scheme::backward_euler;
  compile_again(one);
  if (!one.compilation) return one;
  d.mechanics.damping = share * one.compilation->certificate.bound.needed * (1 + 1e-9);
  compile_again(one);
  return one;
}

CompiledCase tunable_case(std::uint64_t seed) {
  Random random(seed);
  CompiledCase one;
  one.device = random_device(random);
  one.device.description.brake.max_damping = random.log_uniform(1e3, 1e9);
  const Kind shapes[] = {Kind::parallel_branches, Kind::slips, Kind::tree, Kind::slips, Kind::graph, Kind::slips};
  one.source = std::make_unique<SourceFile>("random.json", tunable_network(seed, shapes[seed % 6]));
  one.choices.scheme = random.chance(0.7) ? Scheme::exact : Scheme::backward_euler;
  compile_again(one);
  return one;
}

}  // namespace dashpot::testing
