#include "fig11.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <laws.hpp>

#include "chosen.hpp"
#include "curves.hpp"
#include "printed_needle.hpp"

namespace dashpot::paper {
namespace {

constexpr double strokes = 3;     // of the hand's sine [periods]
constexpr double at_rest = 1e-3;  // below, the arm has no direction: friction holds it for a while [m/s]
constexpr double after = 0.015;   // a reversal: four delays of the filter [s]

LawMaker printed(PrintedNeedle::Dampers dampers) {
  return [dampers] {
    return std::make_unique<LawOf<PrintedNeedle>>(PrintedNeedle(chosen("needle.stiffness"), chosen("needle.yield"),
                                                                chosen("needle.B1"), chosen("needle.B2"), dampers));
  };
}

Experiment to_and_fro() {
  const device_description& plant = rig().description;
  Experiment experiment{plant, {}, strokes / chosen("fig11.frequency"), {}};
  experiment.motion.user = grip();
  experiment.motion.intended = simulated::sine(chosen("fig11.amplitude"), chosen("fig11.frequency"));
  experiment.realisations = {{"(21) by the motor alone", printed(PrintedNeedle::Dampers::in_motor), plant.velocity, 0},
                             {"(21) by motor and brake", printed(PrintedNeedle::Dampers::in_brake), plant.velocity, 0},
                             {"(21) without its dampers", printed(PrintedNeedle::Dampers::left_out), plant.velocity, 0},
                             {"dashpot’s choice for this device", law_of<laws::needle_own>(), plant.velocity, 0}};
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
  double direction = 0;
  for (std::size_t k = 0; k < trace.size(); ++k) {
    if (std::abs(trace[k].velocity) < at_rest) continue;
    const double now = trace[k].velocity > 0 ? 1 : -1;
    if (direction != 0 && now != direction) found.push_back(k);
    direction = now;
  }
  return found;
}

// Mean over the reversals of the largest |value| from each until `duration` [s] after it.
template <class Value>
double mean_of_largest(const Trace& trace, double duration, Value value) {
  const auto samples = static_cast<std::size_t>(duration / rig().description.loop.sample_period);
  const std::vector<std::size_t> reversals = reversals_of(trace);
  double sum = 0;
  for (const std::size_t reversal : reversals) {
    double largest = 0;
    for (std::size_t k = reversal; k < std::min(reversal + samples, trace.size()); ++k)
      largest = std::max(largest, std::abs(value(k)));
    sum += largest;
  }
  return sum / static_cast<double>(reversals.size());
}

Fig11::Part part_of(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  Fig11::Part part{realisation.name, style, run(experiment, realisation), {}, 0, 0, 0, 0};
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
  part.spike = mean_of_largest(part.trace, after, [&](std::size_t k) { return part.trace[k].felt() - part.truth[k]; });
  part.jump = mean_of_largest(part.trace, quarter, [&](std::size_t k) {
    return part.trace[k].commanded.force - part.trace[k - 1].commanded.force;
  });
  return part;
}

Figure figure_of(const Fig11& fig11) {
  const auto all = [&](auto value) {
    std::vector<Curve> curves;
    for (const std::size_t i : {0U, 1U, 3U})
      curves.push_back(curve_of(fig11.parts[i].name, fig11.parts[i].style, fig11.parts[i].trace, value));
    return curves;
  };
  const auto motor = [](const Sample& s) { return s.commanded.force; };
  const auto felt = [](const Sample& s) { return s.felt(); };
  const auto damping = [](const Sample& s) { return s.commanded.damping; };
  const double instant = fig11.reversals.at(2);
  const Interval around{instant, instant + 0.16}, whole{0, fig11.parts[0].trace.back().time};
  std::vector<Curve> felt_around = {
      curve_of("network under the same motion", ideal, fig11.parts[1].trace, fig11.parts[1].truth)};
  for (const Curve& curve : all(felt)) felt_around.push_back(curve);
  return {"Fig. 11: a needle that sticks and slides, led to and fro",
          {fmt::format("K = {} N/m, Y = {} N, B1 = {}, B2 = {} N·s/m on the rig at 10 kHz.", chosen("needle.stiffness"),
                       chosen("needle.yield"), chosen("needle.B1"), chosen("needle.B2"))},
          {{"Motor’s command", "time [s]", "force [N]", all(motor), whole},
           {"Motor’s command, after a reversal", "time [s]", "force [N]", all(motor), around},
           {"Brake’s command, after a reversal", "time [s]", "damping [N·s/m]", all(damping), around},
           {"Felt force, after a reversal", "time [s]", "force [N]", felt_around, around}}};
}

}  // namespace

Fig11 measure_fig11() {
  const Experiment experiment = to_and_fro();
  const Style styles[] = {single_motor, dual_channel, bound, third};
  Fig11 fig11;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig11.parts.push_back(part_of(experiment, experiment.realisations[i], styles[i]));
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
  return {
      "fig11",
      "Fig. 11: a needle that sticks and slides",
      {fmt::format("By the motor alone, (21) jumps by {:.0f} mN some 90 ms after each reversal, when sliding begins "
                   "and B2 times the late "
                   "estimate comes on: the paper’s spikes. Motor and brake together jump by {:.1f} mN, an encoder’s "
                   "step of the spring. "
                   "That comes out as in the paper’s panels. So does a toggling that the paper does not mention: in "
                   "steady sliding an "
                   "encoder’s step can look like sticking for a sample, and B2 u̇ goes and comes, in the motor alone as "
                   "a spike.",
                   fig11.parts[0].jump * 1e3, fig11.parts[1].jump * 1e3),
       fmt::format("Felt, the errors are small: {:.1f} mN rms by the motor alone, {:.1f} by both, {:.1f} by dashpot’s "
                   "law, which leaves B2 to "
                   "the spring and slip that it stands behind and never switches its brake. Without any dampers it "
                   "would be {:.0f} mN. Right "
                   "after a reversal, where velocities are small, the motor alone is off by {:.1f} mN, both by {:.1f}.",
                   fig11.parts[0].rms_error * 1e3, fig11.parts[1].rms_error * 1e3, fig11.parts[3].rms_error * 1e3,
                   fig11.parts[2].rms_error * 1e3, fig11.parts[0].spike * 1e3, fig11.parts[1].spike * 1e3)},
      {figure_of(fig11)},
      {table}};
}

}  // namespace dashpot::paper
