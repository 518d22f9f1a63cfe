#include "fig12.hpp"

#include <fmt/format.h>

#include <cmath>

#include <laws.hpp>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"
#include "zero_phase.hpp"

namespace dashpot::paper {
namespace {

constexpr double cutoff = 200;      // [Hz], as printed
constexpr std::size_t window = 20;  // samples, as printed

Experiment led_by_hand() {
  const device_description& plant = rig().description;
  Experiment experiment{plant, {}, chosen("fig12.duration"), {}};
  experiment.motion.user = grip();
  experiment.motion.intended = simulated::sine(chosen("fig12.amplitude"), chosen("fig12.frequency"));
  experiment.realisations = {{"single motor", law_of<laws::maxwell_single>(), plant.velocity, 0},
                             {"dual channel", law_of<laws::maxwell_dual>(), plant.velocity, 0},
                             {by_papers_rule, law_of<laws::maxwell_by_rule>(), plant.velocity, 0},
                             {by_faithful_choice, law_of<laws::maxwell_own>(), plant.velocity, 0}};
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

double rms_of_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::size_t reversal_after(const std::vector<double>& velocity, std::size_t first) {
  std::size_t k = first;
  while (k + 1 < velocity.size() && (velocity[k] > 0) == (velocity[first] > 0)) ++k;
  return k;
}

Fig12::Part part_of_fig12(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  const double period = experiment.plant.loop.sample_period;
  Fig12::Part part{realisation.name, style, run(experiment, realisation), {}, {}, {}, 0, 0, 0, 0, {}, {}, 0};
  part.velocity = offline_velocity(part.trace, period);
  part.ideal = ideal_force(part.velocity, period);
  std::vector<double> felt, true_velocity;
  for (std::size_t k = 0; k < part.trace.size(); ++k) {
    const Sample& sample = part.trace[k];
    part.force.push_back(sample.commanded.force + sample.commanded.damping * part.velocity[k]);
    felt.push_back(sample.felt());
    true_velocity.push_back(sample.velocity);
  }
  part.reversal = reversal_after(part.velocity, static_cast<std::size_t>(chosen("fig12.settled") / period));
  const auto stroke = static_cast<std::size_t>(0.25 / chosen("fig12.frequency") / period);
  part.returned = returned_energy(energy_of(part.force, part.velocity, period), part.reversal, stroke);
  part.ideal_returned = returned_energy(energy_of(part.ideal, part.velocity, period), part.reversal, stroke);
  part.readings = readings_of(part.force, part.velocity, period, part.reversal, stroke);
  part.ideal_readings = readings_of(part.ideal, part.velocity, period, part.reversal, stroke);
  part.rms_error = rms_of_difference(felt, ideal_force(true_velocity, period));
  part.felt_returned = returned_energy(energy_of(felt, true_velocity, period), part.reversal, stroke);
  return part;
}

// Of `force`, by either reading of (20), in `unit` [1/J].
Curve energy_curve(const std::string& name, const Style& style, const Fig12::Part& part,
                   const std::vector<double>& force, bool summed, Maker maker) {
  const double period = rig().description.loop.sample_period, unit = summed ? 1e3 : 1e9;
  std::vector<double> energy =
      summed ? energy_of(force, part.velocity, period) : increments_of(force, part.velocity, period);
  const double origin = summed ? energy[part.reversal] : 0;
  for (double& e : energy) e = (e - origin) * unit;
  return curve_of(name, style, part.trace, energy, maker);
}

Figure figure_of(const Fig12& fig12) {
  const Fig12::Part &single = fig12.parts[0], &dual = fig12.parts[1];
  const double instant = dual.trace[dual.reversal].time;
  const Interval around{instant - 0.02, instant + 0.12}, whole{0, chosen("fig12.duration")};
  const auto velocity = [](const Sample& s) { return s.velocity * 1e3; };
  const auto energies = [&](bool summed) {
    std::vector<Curve> curves = {energy_curve("ideal", ideal, dual, dual.ideal, summed, Maker::offline)};
    for (const Fig12::Part& part : fig12.parts)
      curves.push_back(energy_curve(part.name, part.style, part, part.force, summed, Maker::emitted));
    return curves;
  };
  std::vector<Curve> force = {curve_of("ideal", ideal, dual.trace, dual.ideal, Maker::offline)}, residual;
  for (const Fig12::Part& part : fig12.parts) {
    force.push_back(curve_of(part.name, part.style, part.trace, part.force));
    std::vector<double> left = part.force;
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = 1e3 * (left[k] - part.ideal[k]);
    residual.push_back(curve_of(part.name, part.style, part.trace, left));
  }
  return {"Fig. 12: energy of a Maxwell element at a reversal",
          {fmt::format("K = {} N/m, B = {} N·s/m on the rig at 10 kHz, led by a stiff grasp.",
                       chosen("tissue.stiffness"), chosen("tissue.damping")),
           "Force: the motor’s command, and b times the velocity computed offline, as in the paper.",
           "Ideal: the emitted exact law under that velocity."},
          {{"(20) summed since the reversal", "time [s]", "energy [mJ]", energies(true), around},
           {"(20) as printed: f u̇ Δt", "time [s]", "energy a sample [nJ]", energies(false), around},
           {"Force", "time [s]", "force [N]", force, around},
           {"Force beyond the ideal", "time [s]", "force [mN]", residual, around},
           {"Velocity", "time [s]", "velocity [mm/s]", {curve_of("", plain, single.trace, velocity)}, whole},
           {"Force, whole run", "time [s]", "force [N]", force, whole}}};
}

bool comes_out(const Fig12& fig12, Fall Readings::*reading) {
  const Fig12::Part &single = fig12.parts[0], &dual = fig12.parts[1];
  return (single.readings.*reading).depth > (single.ideal_readings.*reading).depth &&
         (dual.readings.*reading).depth < (dual.ideal_readings.*reading).depth;
}

std::vector<std::string> words_of(const Fig12& fig12) {
  const Fig12::Part &single = fig12.parts[0], &dual = fig12.parts[1], &rule = fig12.parts[2], &own = fig12.parts[3];
  const auto excess = [](const Fig12::Part& part) {
    return fmt::format("{:.1f} % {}", 100 * std::abs(part.excess()), more_or_less(part.excess(), 0));
  };
  const auto lowest = [](const Fall& fall) { return -fall.depth * 1e9; };
  return {
      fmt::format(
          "(20) summed: the single motor returns {} than the element under the same motion, the dual channel {}. "
          "The paper’s order {}.",
          excess(single), excess(dual), outcome(comes_out(fig12, &Readings::sum))),
      fmt::format("(20) as printed, in one sample: the single motor goes down to {:.0f} nJ where the element goes to "
                  "{:.0f}, the dual channel to {:.0f} where the element goes to {:.0f}. Read so, the paper’s order {}.",
                  lowest(single.readings.increment), lowest(single.ideal_readings.increment),
                  lowest(dual.readings.increment), lowest(dual.ideal_readings.increment),
                  outcome(comes_out(fig12, &Readings::increment))),
      fmt::format(
          "dashpot returns {} by the paper’s rule, and {} by its default, `faithful`, which gives the brake "
          "{:.3f} N·s/m. The felt force is off by {:.1f} mN rms by the single motor, {:.1f} by the dual channel, "
          "{:.1f} by dashpot with the paper’s rule and {:.1f} faithfully: the default is {} to the element than "
          "the paper’s dual law.",
          excess(rule), excess(own), own.trace.back().commanded.damping, single.rms_error * 1e3, dual.rms_error * 1e3,
          rule.rms_error * 1e3, own.rms_error * 1e3, own.rms_error < dual.rms_error ? "nearer" : "no nearer")};
}

}  // namespace

Fig12 measure_fig12() {
  const Experiment experiment = led_by_hand();
  const Style styles[] = {single_motor, dual_channel, third, fourth};
  Fig12 fig12;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig12.parts.push_back(part_of_fig12(experiment, experiment.realisations[i], styles[i]));
  return fig12;
}

Section show(const Fig12& fig12) {
  Table table{
      "Energy returned after the reversal",
      {"realisation", "returned [mJ]", "ideal, same motion [mJ]", "excess [%]", "by the true force and velocity [mJ]",
       "(20) as printed, lowest [nJ]", "ideal [nJ]", "felt force, rms error [mN]"},
      {}};
  for (const Fig12::Part& part : fig12.parts)
    table.rows.push_back({part.name, fmt::format("{:.4f}", part.returned * 1e3),
                          fmt::format("{:.4f}", part.ideal_returned * 1e3), fmt::format("{:+.1f}", 100 * part.excess()),
                          fmt::format("{:.4f}", part.felt_returned * 1e3),
                          fmt::format("{:.1f}", -part.readings.increment.depth * 1e9),
                          fmt::format("{:.1f}", -part.ideal_readings.increment.depth * 1e9),
                          fmt::format("{:.2f}", part.rms_error * 1e3)});
  return {"fig12", "Fig. 12: energy of a Maxwell element at a reversal", words_of(fig12), {figure_of(fig12)}, {table}};
}

}  // namespace dashpot::paper
