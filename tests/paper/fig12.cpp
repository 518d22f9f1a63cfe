#include "fig12.hpp"

#include <fmt/format.h>

#include <laws.hpp>

#include "chosen.hpp"
#include "curves.hpp"
#include "energy.hpp"
#include "zero_phase.hpp"

namespace dashpot::paper {
namespace {

constexpr double duration = 2;      // [s]
constexpr double settled = 1.0;     // the reversal after this is shown [s]
constexpr double cutoff = 200;      // [Hz], as printed
constexpr std::size_t window = 20;  // samples, as printed

Experiment led_by_hand() {
  const device_description& plant = rig().description;
  Experiment experiment{plant, {}, duration, {}};
  experiment.motion.user = grip();
  experiment.motion.intended = simulated::sine(chosen("fig12.amplitude"), chosen("fig12.frequency"));
  experiment.realisations = {{"single motor", law_of<laws::maxwell_single>(), plant.velocity, 0},
                             {"dual channel", law_of<laws::maxwell_dual>(), plant.velocity, 0},
                             {"dashpot’s choice for this device", law_of<laws::maxwell_own>(), plant.velocity, 0}};
  return experiment;
}

// Differences of the recorded positions, smoothed without delay.
std::vector<double> offline_velocity(const Trace& trace, double period) {
  std::vector<double> velocity(trace.size());
  for (std::size_t k = 1; k < trace.size(); ++k) velocity[k] = (trace[k].measured - trace[k - 1].measured) / period;
  const auto order = static_cast<unsigned>(chosen("fig12.butterworth_order"));
  return both_ways(centred_average(velocity, window), order, cutoff, period);
}

// The element itself, by the emitted exact law, under the motion whose velocity that is.
std::vector<double> ideal_force(const std::vector<double>& velocity, double period) {
  laws::maxwell_ideal law;
  law.reset(0);
  std::vector<double> force;
  double position = 0;
  for (const double v : velocity) {
    position += v * period;
    force.push_back(law.output(position, v).force);
    law.update();
  }
  return force;
}

std::size_t reversal_after(const std::vector<double>& velocity, std::size_t first) {
  std::size_t k = first;
  while (k + 1 < velocity.size() && (velocity[k] > 0) == (velocity[first] > 0)) ++k;
  return k;
}

Fig12::Part part_of(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  const double period = experiment.plant.loop.sample_period;
  Fig12::Part part{realisation.name, style, run(experiment, realisation), {}, {}, {}, 0, 0, 0, 0};
  part.velocity = offline_velocity(part.trace, period);
  part.ideal = ideal_force(part.velocity, period);
  std::vector<double> felt, true_velocity;
  for (std::size_t k = 0; k < part.trace.size(); ++k) {
    const Sample& sample = part.trace[k];
    part.force.push_back(sample.commanded.force + sample.commanded.damping * part.velocity[k]);
    felt.push_back(sample.felt());
    true_velocity.push_back(sample.velocity);
  }
  part.reversal = reversal_after(part.velocity, static_cast<std::size_t>(settled / period));
  const auto stroke = static_cast<std::size_t>(0.25 / chosen("fig12.frequency") / period);
  part.returned = returned_energy(energy_of(part.force, part.velocity, period), part.reversal, stroke);
  part.ideal_returned = returned_energy(energy_of(part.ideal, part.velocity, period), part.reversal, stroke);
  part.felt_returned = returned_energy(energy_of(felt, true_velocity, period), part.reversal, stroke);
  return part;
}

Curve energy_curve(const std::string& name, const Style& style, const Fig12::Part& part,
                   const std::vector<double>& force) {
  const double period = rig().description.loop.sample_period;
  std::vector<double> energy = energy_of(force, part.velocity, period);
  const double origin = energy[part.reversal];
  for (double& e : energy) e = (e - origin) * 1e3;
  return curve_of(name, style, part.trace, energy);
}

Figure figure_of(const Fig12& fig12) {
  const Fig12::Part &single = fig12.parts[0], &dual = fig12.parts[1];
  const double instant = dual.trace[dual.reversal].time;
  const Interval around{instant - 0.02, instant + 0.12}, whole{0, duration};
  const auto velocity = [](const Sample& s) { return s.velocity * 1e3; };
  std::vector<Curve> energy = {energy_curve("ideal, offline", ideal, dual, dual.ideal)};
  std::vector<Curve> force = {curve_of("", ideal, dual.trace, dual.ideal)};
  for (const Fig12::Part& part : fig12.parts) {
    energy.push_back(energy_curve(part.name, part.style, part, part.force));
    force.push_back(curve_of("", part.style, part.trace, part.force));
  }
  return {"Fig. 12: energy of a Maxwell element at a reversal",
          {fmt::format("K = {} N/m, B = {} N·s/m on the rig at 10 kHz, led by a stiff grasp.",
                       chosen("tissue.stiffness"), chosen("tissue.damping")),
           "Force: the motor’s command, and b times the velocity computed offline, as in the paper."},
          {{"Energy since the reversal", "time [s]", "energy [mJ]", energy, around},
           {"Force", "time [s]", "force [N]", force, around},
           {"Velocity", "time [s]", "velocity [mm/s]", {curve_of("", plain, single.trace, velocity)}, whole},
           {"Force, whole run", "time [s]", "force [N]", force, whole}}};
}

}  // namespace

Fig12 measure_fig12() {
  const Experiment experiment = led_by_hand();
  const Style styles[] = {single_motor, dual_channel, third};
  Fig12 fig12;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig12.parts.push_back(part_of(experiment, experiment.realisations[i], styles[i]));
  return fig12;
}

Section show(const Fig12& fig12) {
  Table table{
      "Energy returned after the reversal",
      {"realisation", "returned [mJ]", "ideal, same motion [mJ]", "excess [%]", "by the true force and velocity [mJ]"},
      {}};
  for (const Fig12::Part& part : fig12.parts)
    table.rows.push_back({part.name, fmt::format("{:.4f}", part.returned * 1e3),
                          fmt::format("{:.4f}", part.ideal_returned * 1e3), fmt::format("{:+.1f}", 100 * part.excess()),
                          fmt::format("{:.4f}", part.felt_returned * 1e3)});
  return {
      "fig12",
      "Fig. 12: energy of a Maxwell element at a reversal",
      {fmt::format(
          "The single motor returns {:.1f} % more than the element under the same motion, the dual channel {:.1f} % "
          "less: the order of the paper.",
          100 * fig12.parts[0].excess(), -100 * fig12.parts[1].excess())},
      {figure_of(fig12)},
      {table}};
}

}  // namespace dashpot::paper
