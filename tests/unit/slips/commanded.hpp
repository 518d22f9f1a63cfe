// Commands of laws with slips along written motions, for devices that are given here.
#pragma once

#include <dashpot/brake_coil.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "discretise/discretise.hpp"
#include "slip_run.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"

namespace dashpot::testing {

// The second slip holds below 0.4 N and the damper of 2 N·s/m is alone; beyond, that of 3 N·s/m is in series with it.
inline const char* const two_slips = R"({"series": [
    {"parallel": [{"damper": 2}, {"series": [{"spring": 300}, {"slip": 1}]}]},
    {"parallel": [{"slip": 0.4}, {"damper": 3}]}]})";

// A linear device at 1 kHz with the difference of two samples for a velocity, everything else exact.
inline compiler::Device device_with(double encoder_step) {
  compiler::Device device;
  device.name = "written";
  device_description& d = device.description;
  d.loop.sample_period = slip_period;
  d.encoder.step = encoder_step;
  d.brake.kind = brake_kind::eddy_current;
  d.brake.max_damping = 1000;
  return device;
}

inline compiler::Compilation decided(const compiler::Network& network, const std::string& law,
                                     const compiler::Device* device = nullptr) {
  compiler::Choices choices;
  choices.decomposition = law;
  return compiled(network, choices, device);
}

inline std::vector<command<double>> commands_along(const compiler::UpdateLaw& law, const std::vector<double>& motion) {
  compiler::Evaluation<double> evaluation(law);
  evaluation.reset(0);
  std::vector<command<double>> commands;
  double last = 0;
  for (double position : motion) {
    commands.push_back(evaluation.step(position, (position - last) / slip_period));
    last = position;
  }
  return commands;
}

inline std::vector<double> slide(double speed, std::size_t samples) {
  std::vector<double> motion;
  for (std::size_t i = 1; i <= samples; ++i) motion.push_back(speed * slip_period * double(i));
  return motion;
}

// For 2,000 samples away, for 2,000 back, and away again, as an encoder of this step reads it.
inline std::vector<double> there_and_back(double speed, double step) {
  std::vector<double> motion;
  for (int i = 1; i <= 6000; ++i) {
    const int within = i % 4000;
    const double u = speed * slip_period * (within < 2000 ? within : 4000 - within);
    motion.push_back(std::floor(u / step) * step);
  }
  return motion;
}

// The difference of N samples, N from the device; positions before the first are 0.
inline double difference(const std::vector<double>& motion, std::size_t i, std::size_t window) {
  return (motion[i] - (i >= window ? motion[i - window] : 0)) / (double(window) * slip_period);
}

inline std::size_t toggles(const std::vector<command<double>>& commands, std::size_t first, std::size_t last) {
  std::size_t count = 0;
  for (std::size_t i = first + 1; i < last; ++i)
    if (commands[i].damping != commands[i - 1].damping) ++count;
  return count;
}

// A coil that lags, a brake that is weaker than it says, an estimate of five samples.
struct SlowBrake {
  compiler::Device device = device_with(0);

  SlowBrake() {
    device.description.velocity.window = 5;
    device.description.brake.coil_lag = 0.02;
    device.description.brake.tolerance = 0.1;
  }

  // The least of V and of what has gone in, Σ (m + b v) Δu, over the motion: below zero, energy was made.
  // The coil begins at `root`, √b, and the count behind `begin` samples.
  double least_balance(const compiler::UpdateLaw& law, const std::vector<double>& motion, double root = 0,
                       std::size_t begin = 0) const {
    compiler::Evaluation<double> evaluation(law);
    evaluation.reset(0);
    brake_coil<double> coil(device.description.brake);
    coil.reset(root);
    double work = 0, last = 0, least = 0, start = 0;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const double change = motion[i] - last;
      last = motion[i];
      const command<double> now = evaluation.step(motion[i], difference(motion, i, device.description.velocity.window));
      const double before = coil.damping();
      coil.advance(std::sqrt(now.damping), slip_period);
      const double certain = (1 - device.description.brake.tolerance) * std::min(before, coil.damping());
      work += (now.force + certain * change / slip_period) * change;
      if (i < begin) start = work - evaluation.stored_energy();
      least = std::min(least, work - evaluation.stored_energy() - start);
    }
    return least;
  }
};

// V_k − V_{k−1} ≤ m_k Δu_k whatever the brake does: it takes no part, but is commanded no more than `most_damping`.
// Returns where that fails; empty if nowhere. Rounding: 1e-13 of the largest energy, `shared(damping, change)` [J]
// among them, and `rounding` [N/m] Δu².
template <class SharedEnergy>
std::string energy_from_motor(const compiler::Compilation& compilation, const std::vector<double>& motion,
                              double most_damping, SharedEnergy shared, double rounding) {
  if (compilation.decomposition.choice().velocity_gain != 0)
    return "";  // what reaches ground without a slip asks for an estimate
  compiler::Evaluation<double> evaluation(compilation.law);
  evaluation.reset(0);
  double stored = 0, last = 0, scale = 0;
  for (double position : motion) {
    const double change = position - last;
    last = position;
    const command<double> now = evaluation.step(position, change / slip_period);
    if (now.damping < 0 || now.damping > most_damping * (1 + 1e-12)) return fmt::format("a damping of {}", now.damping);
    const double work = now.force * change, after = evaluation.stored_energy();
    scale = std::max({scale, std::abs(work), after, shared(now.damping, change)});
    if (!(after - stored - work <= 1e-13 * scale + rounding * change * change))
      return fmt::format("energy rose by {} for {} at a scale of {}", after - stored, work, scale);
    stored = after;
  }
  return "";
}

// The same split, but with a ramp that takes its whole way at once, and without allowing for a coil or for the
// estimate's memory.
inline compiler::UpdateLaw bold(compiler::Compilation c) {
  c.decomposition.slips.ramp = 1;
  c.decomposition.slips.memory = 0;
  c.decomposition.slips.coil_share = 1;
  return compiler::discretise(c.network, c.form, c.decomposition, {}, c.rate);
}

inline NetworkRecipe coupled_recipe(Topology topology) {
  NetworkRecipe recipe;
  recipe.topology = topology;
  recipe.most_nodes = 8;
  recipe.most_slips = topology == Topology::tree ? 6 : 4;
  return recipe;
}

// energy_from_motor() of slips that are solved together. What the brake takes is capped, to be of another regime now
// and then, and led to where the coil can be.
inline std::string gain_of_coupled(const compiler::Network& network, const char* law,
                                   const std::vector<double>& motion) {
  compiler::Device device = device_with(1e-5);
  device.description.brake.max_damping = 0.5;
  device.description.brake.coil_lag = 0.01;
  device.description.velocity.estimator = estimator_kind::super_twisting;  // so that nothing is made up
  compiler::Choices choices;
  choices.decomposition = law;
  choices.state_input = compiler::StateInput::position;
  // f′ is what is left of a force that is rounded as a whole; outside a tree ends of stiff elements are, and these
  // answer that.
  const auto whole = [](double, double change) { return 0.5 * change * change / slip_period; };
  return energy_from_motor(compiled(network, choices, &device), motion, 0.5, whole, 0x1p-48 * stiffest(network));
}

// To and fro by many times what makes the slip give way, at a pace that changes.
inline std::vector<double> adversarial_motion(std::uint64_t seed) {
  Random random(seed);
  std::vector<double> motion;
  double u = 0, velocity = 0;
  for (int i = 0; i < 400; ++i) {
    if (i % 7 == 0) velocity = random.chance(0.3) ? 0 : (random.uniform() - 0.5) * random.log_uniform(0.1, 10);
    u += velocity * slip_period;
    motion.push_back(u);
  }
  return motion;
}

}  // namespace dashpot::testing
