// Recordings of networks that are known.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "fit/problem.hpp"

namespace dashpot::compiler::fitting {

// Three ramps, a thousandfold apart in speed, each with a hold, and the way back: rows follow each other densely where
// something happens. About 700 of them.
inline Recording probing_motion() {
  Recording recording;
  double time = 0, position = 0;
  const auto add = [&](double t, double u) {
    recording.time.push_back(t);
    recording.position.push_back(u);
  };
  add(0, 0);
  const auto ramp_and_hold = [&](double to, double ramp, double hold) {
    const double from = position, begin = time;
    constexpr int ramp_rows = 40, hold_rows = 80;
    for (int i = 1; i <= ramp_rows; ++i) add(begin + ramp * i / ramp_rows, from + (to - from) * i / ramp_rows);
    const double first = 0.004;
    for (int i = 0; i < hold_rows; ++i)
      add(begin + ramp + first * std::pow(hold / first, double(i) / (hold_rows - 1)), to);
    time = begin + ramp + hold;
    position = to;
  };
  ramp_and_hold(1e-3, 0.02, 3);
  ramp_and_hold(2e-3, 0.5, 10);
  ramp_and_hold(3e-3, 5, 40);
  ramp_and_hold(1.5e-3, 0.05, 10);
  ramp_and_hold(2.5e-3, 1, 20);
  ramp_and_hold(0, 2, 40);
  recording.force.assign(recording.time.size(), 0.0);
  return recording;
}

enum class Noise { white, autoregressive };

// Of standard deviation `size`; autoregressive: each row keeps 0.95 of the one before.
inline std::vector<double> noise(std::size_t count, double size, Noise kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(count);
  double last = normal(random);
  for (double& value : values) {
    last = kind == Noise::white ? normal(random) : 0.95 * last + std::sqrt(1 - 0.95 * 0.95) * normal(random);
    value = size * last;
  }
  return values;
}

// With noise of a share of the greatest force.
inline Recording answered(const Model& network, double share, Noise kind, std::uint64_t seed) {
  Recording recording = probing_motion();
  const std::vector<Recording> alone{recording};
  const Problem problem(alone, Form::stiffness, Weighting::uniform, 1'000'000);
  const Eigen::VectorXd force = problem.columns(network.terms) * network.weights;
  const std::vector<double> added = noise(recording.time.size(), share * force.cwiseAbs().maxCoeff(), kind, seed);
  for (std::size_t i = 0; i < added.size(); ++i) recording.force[i] = force[static_cast<Eigen::Index>(i)] + added[i];
  return recording;
}

inline Model network_of(double spring, double damper, const std::vector<std::pair<double, double>>& branches) {
  Model model;
  std::vector<double> weights;
  const auto add = [&](TermKind kind, double time, double weight) {
    if (weight == 0) return;
    model.terms.push_back({kind, time, 0, 0, 0});
    weights.push_back(weight);
  };
  add(TermKind::spring, 0, spring);
  add(TermKind::damper, 0, damper);
  for (const auto& [stiffness, time] : branches) add(TermKind::maxwell, time, stiffness);
  model.weights = Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
  model.gains = {1.0};
  return model;
}

// One to four relaxations, with and without spring and damper.
inline std::vector<Model> sample_networks() {
  return {network_of(100, 0, {{200, 0.3}}), network_of(0, 0, {{300, 2}}), network_of(150, 2, {{120, 0.1}, {180, 4}}),
          network_of(200, 0, {{150, 0.08}, {120, 1}, {90, 12}}),
          network_of(80, 0, {{200, 0.03}, {150, 0.3}, {120, 3}, {100, 30}})};
}

}  // namespace dashpot::compiler::fitting
