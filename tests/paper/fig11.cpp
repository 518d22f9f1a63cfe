#include "fig11.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <laws.hpp>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"
#include "printed_needle.hpp"

namespace dashpot::paper {
namespace {

LawMaker printed(PrintedNeedle::Dampers dampers) {
  return law_with(PrintedNeedle(chosen("needle.stiffness"), chosen("needle.yield"), chosen("needle.B1"),
                                chosen("needle.B2"), dampers));
}

Experiment to_and_fro() {
  const device_description& plant = rig().description;
  Experiment experiment{plant, {}, chosen("fig11.strokes") / chosen("fig11.frequency"), {}};
  experiment.motion.user = grip();
  experiment.motion.intended = simulated::sine(chosen("fig11.amplitude"), chosen("fig11.frequency"));
  experiment.realisations = {{"(21) by the motor alone", printed(PrintedNeedle::Dampers::in_motor), plant.velocity, 0},
                             {"(21) by motor and brake", printed(PrintedNeedle::Dampers::in_brake), plant.velocity, 0},
                             {"(21) without its dampers", printed(PrintedNeedle::Dampers::left_out), plant.velocity, 0},
                             {by_papers_rule, law_of<laws::needle_by_rule>(), plant.velocity, 0},
                             {by_faithful_choice, law_of<laws::needle_own>(), plant.velocity, 0}};
  return experiment;
}

// The network itself under the true motion, by the law emitted for a single motor with a perfect velocity.
std::vector<double> truth_of(const Trace& trace) {
  laws::needle_ideal law;
  law.reset(trace.front().position);
  std::vector<double> force;
  for (const Sample& sample : trace) {
    const command<double> now = law.output(sample.position, sample.velocity);
    force.push_back(now.force + now.damping * sample.velocity);
    law.update();
  }
  return force;
}

std::vector<std::size_t> reversals_of(const Trace& trace) {
  std::vector<std::size_t> found;
  const double at_rest = chosen("fig11.at_rest");
  double direction = 0;
  for (std::size_t k = 0; k < trace.size(); ++k) {
    if (std::abs(trace[k].velocity) < at_rest) continue;
    const double now = trace[k].velocity > 0 ? 1 : -1;
    if (direction != 0 && now != direction) found.push_back(k);
    direction = now;
  }
  return found;
}

const Fig11::Part& nearest(const Fig11& fig11) {
  return *std::min_element(fig11.parts.begin(), fig11.parts.end(),
                           [](const Fig11::Part& a, const Fig11::Part& b) { return a.rms_error < b.rms_error; });
}

struct Largest {
  double value, delay;
};

// Mean over the reversals of the largest |value| from each until `duration` [s] after it, and of when that is.
template <class Value>
Largest mean_of_largest(const Trace& trace, double duration, Value value) {
  const double period = rig().description.loop.sample_period;
  const auto samples = static_cast<std::size_t>(duration / period);
  const std::vector<std::size_t> reversals = reversals_of(trace);
  Largest mean{0, 0};
  for (const std::size_t reversal : reversals) {
    std::size_t at = reversal;
    for (std::size_t k = reversal; k < std::min(reversal + samples, trace.size()); ++k)
      if (std::abs(value(k)) > std::abs(value(at))) at = k;
    mean.value += std::abs(value(at)) / static_cast<double>(reversals.size());
    mean.delay += static_cast<double>(at - reversal) * period / static_cast<double>(reversals.size());
  }
  return mean;
}

Fig11::Part part_of_fig11(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  Fig11::Part part{realisation.name, style, run(experiment, realisation), {}, 0, 0, 0, 0, realisation.law.maker, 0};
  part.truth = truth_of(part.trace);
  const double quarter = 0.25 / chosen("fig11.frequency");
  double sum = 0, count = 0;
  for (std::size_t k = 1; k < part.trace.size(); ++k) {
    part.toggles += part.trace[k].commanded.damping != part.trace[k - 1].commanded.damping;
    if (part.trace[k].time < quarter) continue;
    const double error = part.trace[k].felt() - part.truth[k];
    sum += error * error, ++count;
  }
  part.rms_error = std::sqrt(sum / count);
  part.spike = mean_of_largest(part.trace, chosen("fig11.after"), [&](std::size_t k) {
                 return part.trace[k].felt() - part.truth[k];
               }).value;
  const Largest jump = mean_of_largest(part.trace, quarter, [&](std::size_t k) {
    return part.trace[k].commanded.force - part.trace[k - 1].commanded.force;
  });
  part.jump = jump.value;
  part.jump_delay = jump.delay;
  return part;
}

// What is beyond the network's own force under the same motion [mN].
template <class Value>
std::vector<double> residual(const Fig11::Part& part, Value value) {
  std::vector<double> left;
  for (std::size_t k = 0; k < part.trace.size(); ++k) left.push_back(1e3 * (value(part.trace[k]) - part.truth[k]));
  return left;
}

Figure figure_of(const Fig11& fig11) {
  constexpr std::size_t drawn[] = {0, 1, 3, 4};
  const auto all = [&](auto value) {
    std::vector<Curve> curves;
    for (const std::size_t i : drawn)
      curves.push_back(
          curve_of(fig11.parts[i].name, fig11.parts[i].style, fig11.parts[i].trace, value, fig11.parts[i].maker));
    return curves;
  };
  const auto residuals = [&](auto value) {
    std::vector<Curve> curves;
    for (const std::size_t i : drawn) {
      const Fig11::Part& part = fig11.parts[i];
      curves.push_back(curve_of(part.name, part.style, part.trace, residual(part, value), part.maker));
    }
    return curves;
  };
  const auto motor = [](const Sample& s) { return s.commanded.force; };
  const auto commanded = [](const Sample& s) { return s.commanded_force(); };
  const auto felt = [](const Sample& s) { return s.felt(); };
  const auto damping = [](const Sample& s) { return s.commanded.damping; };
  const double instant = fig11.reversals.at(2);
  const Interval around{instant, instant + chosen("fig11.shown")}, whole{0, fig11.parts[0].trace.back().time};
  std::vector<Curve> felt_around = {
      curve_of("network under the same motion", ideal, fig11.parts[1].trace, fig11.parts[1].truth)};
  for (const Curve& curve : all(felt)) felt_around.push_back(curve);
  return {"Fig. 11: a needle that sticks and slides, led to and fro",
          {fmt::format("K = {} N/m, Y = {} N, B1 = {}, B2 = {} N·s/m on the rig at 10 kHz.", chosen("needle.stiffness"),
                       chosen("needle.yield"), chosen("needle.B1"), chosen("needle.B2")),
           "Residuals: less the force of the network itself under the same true motion.",
           "Commanded: the motor’s command, and the brake’s times the true velocity."},
          {{"Motor’s command", "time [s]", "force [N]", all(motor), whole},
           {"Felt force, after a reversal", "time [s]", "force [N]", felt_around, around},
           {"Commanded: residual after a reversal", "time [s]", "force [mN]", residuals(commanded), around,
            Interval{-30, 30}},
           {"Felt: residual after a reversal", "time [s]", "force [mN]", residuals(felt), around, Interval{-30, 30}},
           {"Motor’s command, after a reversal", "time [s]", "force [N]", all(motor), around},
           {"Brake’s command, after a reversal", "time [s]", "damping [N·s/m]", all(damping), around}}};
}

std::vector<std::string> words_of(const Fig11& fig11) {
  const Fig11::Part &alone = fig11.parts[0], &both = fig11.parts[1], &bare = fig11.parts[2], &rule = fig11.parts[3],
                    &faithful = fig11.parts[4];
  constexpr double milli = 1e3;
  const double step = chosen("needle.stiffness") * rig().description.encoder.step * rig().description.arm_radius;
  const bool has_spikes = alone.jump > 3 * step && both.jump < 1.5 * step,
             is_better = both.rms_error < alone.rms_error / 2;
  return {fmt::format(
              "By the motor alone, (21) jumps by {:.0f} mN {:.0f} ms after each reversal, when sliding begins and B2 "
              "times the late estimate comes on: the residual shows it. Motor and brake together jump by {:.1f} mN, "
              "where an encoder’s step of the spring is {:.1f}. “Transient spikes with a delay after each velocity "
              "reversal” that "
              "the brake eliminates: that {}.",
              alone.jump * milli, alone.jump_delay * milli, both.jump * milli, step * milli, outcome(has_spikes)),
          fmt::format(
              "The brake’s command of (21) changes {} times in {:g} strokes, where {:g} changes would do: in steady "
              "sliding an encoder’s step can look like sticking for a sample, and B2 u̇ goes and comes, in the motor "
              "alone as a spike. The paper does not mention it. dashpot’s laws change theirs {} times (the paper’s "
              "rule) and {} times (faithful).",
              both.toggles, chosen("fig11.strokes"), 2.0 * static_cast<double>(fig11.reversals.size()), rule.toggles,
              faithful.toggles),
          fmt::format(
              "“Improves the fidelity considerably” {}: felt, the force is off by {:.1f} mN rms by the motor alone, "
              "{:.1f} by both; without any dampers it would be {:.0f} mN. Right after a reversal, where velocities "
              "are small, the motor alone is off by {:.1f} mN, both by {:.1f}.",
              outcome(is_better), alone.rms_error * milli, both.rms_error * milli, bare.rms_error * milli,
              alone.spike * milli, both.spike * milli),
          fmt::format(
              "dashpot’s law is off by {:.1f} mN rms by the paper’s rule, {:.1f} by its default, `faithful`, which "
              "takes the largest brake, {:.2f} N·s/m, that keeps within its tolerance. {} is nearest to the network.",
              rule.rms_error * milli, faithful.rms_error * milli, faithful.trace.back().commanded.damping,
              nearest(fig11).name)};
}

}  // namespace

Fig11 measure_fig11() {
  const Experiment experiment = to_and_fro();
  const Style styles[] = {single_motor, dual_channel, bound, third, fourth};
  Fig11 fig11;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig11.parts.push_back(part_of_fig11(experiment, experiment.realisations[i], styles[i]));
  for (const std::size_t k : reversals_of(fig11.parts[0].trace))
    fig11.reversals.push_back(fig11.parts[0].trace[k].time);
  return fig11;
}

Section show(const Fig11& fig11) {
  Table table{"Force errors against the network under the same motion",
              {"realisation", "rms error [mN]", "largest error after a reversal [mN]",
               "jump of the motor’s command [mN]", "changes of the brake"},
              {}};
  for (const Fig11::Part& part : fig11.parts)
    table.rows.push_back({part.name, fmt::format("{:.2f}", part.rms_error * 1e3),
                          fmt::format("{:.1f}", part.spike * 1e3), fmt::format("{:.1f}", part.jump * 1e3),
                          fmt::format("{}", part.toggles)});
  return {"fig11", "Fig. 11: a needle that sticks and slides", words_of(fig11), {figure_of(fig11)}, {table}};
}

}  // namespace dashpot::paper
