#include "fig9.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <laws.hpp>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"

namespace dashpot::paper {
namespace {

double settling() { return chosen("fig9.settling"); }

// The hand intends to go on to twice the obstacle's depth, and so presses against it.
Experiment into_the_obstacle(const device_description& plant) {
  const double approach = chosen("fig9.approach");
  const double speed = chosen("fig9.speed"), obstacle = chosen("fig9.obstacle"), way = approach + 2 * obstacle;
  Experiment experiment{plant, {}, (approach + obstacle) / speed + chosen("fig9.hold"), {}};
  experiment.motion.user = grip();
  experiment.motion.initial_position = -approach;
  experiment.motion.intended = simulated::through({{0, -approach}, {way / speed, 2 * obstacle}});
  experiment.motion.high = simulated::end_stop{obstacle};
  return experiment;
}

double instant_at(const Trace& trace, double position) {
  for (const Sample& sample : trace)
    if (sample.position >= position) return sample.time;
  return trace.back().time;
}

std::size_t sample_at(const Trace& trace, double time) {
  std::size_t k = 0;
  while (k + 1 < trace.size() && trace[k].time < time) ++k;
  return k;
}

Fig9::Part part_of_fig9(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  Fig9::Part part{realisation.name, style, run(experiment, realisation), 0, 0, 0, 0, 0, realisation.law.maker};
  const double stop = instant_at(part.trace, chosen("fig9.obstacle") * (1 - 1e-6));
  const Sample& before = part.trace[sample_at(part.trace, stop - 2 * experiment.plant.loop.sample_period)];
  part.before_stop = before.commanded.force;
  part.speed = before.velocity;
  part.after_stop = part.trace[sample_at(part.trace, stop + settling())].commanded.force;
  return part;
}

double peak_of(const Trace& trace) {
  double peak = 0;
  for (const Sample& sample : trace) peak = std::max(peak, std::abs(sample.commanded.force));
  return peak;
}

// Of two motors' commands from `settling` after the stop to the end, relative to the peak of the first.
double difference_after(const Trace& first, const Trace& second, double stop) {
  double largest = 0;
  for (std::size_t k = sample_at(first, stop + settling()); k < first.size(); ++k)
    largest = std::max(largest, std::abs(first[k].commanded.force - second[k].commanded.force));
  return largest / peak_of(first);
}

void compare_what_is_felt(const Fig9& fig9, Fig9::Part& part) {
  const Trace& truth = fig9.parts[0].trace;
  const double peak = peak_of(truth), period = rig().description.loop.sample_period;
  for (std::size_t k = sample_at(truth, fig9.touch); truth[k].time < fig9.stop + settling(); ++k) {
    const double error = std::abs(part.trace[k].felt() - truth[k].felt());
    part.felt_error = std::max(part.felt_error, error);
    if (error > peak / 5) part.felt_error_time += period;
  }
}

Figure figure_of(const Fig9& fig9) {
  const auto all = [&](auto value) {
    std::vector<Curve> curves;
    for (const Fig9::Part& part : fig9.parts)
      curves.push_back(curve_of(part.name, part.style, part.trace, value, part.maker));
    return curves;
  };
  const auto position = [](const Sample& s) { return s.position * 1e3; };
  const auto motor = [](const Sample& s) { return s.commanded.force; };
  const auto felt = [](const Sample& s) { return s.felt(); };
  const Interval around{fig9.touch - 0.05, fig9.stop + 0.1}, whole{0, fig9.parts[0].trace.back().time};
  return {"Fig. 9: a 2nd-order Maxwell solid, stopped by a rigid obstacle",
          {"A quarter of Fig. 5’s solid, met at 0 mm; the obstacle stands at 10 mm.",
           "Felt: motor and brake together, as they act."},
          {{"Motor’s command", "time [s]", "force [N]", all(motor), whole},
           {"Motor’s command, contact to stop", "time [s]", "force [N]", all(motor), around},
           {"Position", "time [s]", "position [mm]", all(position), whole},
           {"Felt force, contact to stop", "time [s]", "force [N]", all(felt), around}}};
}

std::vector<std::string> words_of(const Fig9& fig9) {
  const Fig9::Part &single = fig9.parts[1], &dual = fig9.parts[2];
  const double jump = dual.after_stop - dual.before_stop, other_jump = single.after_stop - single.before_stop;
  const bool is_alike = fig9.relaxation_difference<0.05, is_felt = dual.felt_error> fig9.peak / 5;
  const bool takes_back = dual.before_stop < 0 && single.before_stop > 0;
  return {fmt::format(
              "“An almost identical relaxation” {}: single motor and dual channel differ by at most {:.2f} % of the "
              "peak, dual channel and ideal by {:.2f} %. Their states are driven by the estimate, which enters the "
              "object with what it remembers of free motion and leaves it 3.5 ms late.",
              outcome(is_alike), 100 * fig9.relaxation_difference, 100 * fig9.relaxation_error),
          fmt::format(
              "During compression the single motor’s command has the shape of Fig. 5’s total force, the dual "
              "channel’s that of the motor’s part, below zero: that {} ({:+.3f} and {:+.3f} N just before the "
              "obstacle). When it stops the arm, the brake’s part ends at once and the dual channel’s command jumps "
              "by {:+.3f} N, the single motor’s by {:+.3f} N.",
              outcome(takes_back), single.before_stop, dual.before_stop, jump, other_jump),
          fmt::format(
              "The paper says that these transients are not felt, because the brake acts at the same time. That {}: "
              "felt is a force that is off by up to {:.2f} N, by more than a fifth of the solid’s peak of {:.2f} N "
              "for {:.0f} ms together{}. The single motor is off by {:.3f} N.",
              outcome(!is_felt), dual.felt_error, fig9.peak, dual.felt_error_time * 1e3,
              is_felt ? ", since at contact the motor takes back at once what the coil needs its 2 ms to build up, and "
                        "at the stop the brake’s part is gone 3.5 ms before the estimate knows"
                      : "",
              single.felt_error)};
}

}  // namespace

Fig9 measure_fig9() {
  const device_description& plant = rig().description;
  const Experiment experiment = into_the_obstacle(plant), ideally = into_the_obstacle(ideal_rig());
  Fig9 fig9;
  fig9.parts = {part_of_fig9(ideally, {"ideal", law_of<WhileInside<laws::solid_ideal>>(), true_velocity(), 0}, ideal),
                part_of_fig9(experiment, {"single motor", law_of<WhileInside<laws::solid_single>>(), plant.velocity, 0},
                             single_motor),
                part_of_fig9(experiment, {"dual channel", law_of<WhileInside<laws::solid_dual>>(), plant.velocity, 0},
                             dual_channel)};
  const Trace &truth = fig9.parts[0].trace, &single = fig9.parts[1].trace, &dual = fig9.parts[2].trace;
  fig9.touch = instant_at(dual, 0);
  fig9.stop = instant_at(dual, chosen("fig9.obstacle") * (1 - 1e-6));
  fig9.relaxation_difference = difference_after(single, dual, fig9.stop);
  fig9.relaxation_error = difference_after(truth, dual, fig9.stop);
  fig9.peak = peak_of(truth);
  for (Fig9::Part& part : fig9.parts) compare_what_is_felt(fig9, part);
  return fig9;
}

Section show(const Fig9& fig9) {
  Table table{"The motor’s command at the obstacle",
              {"realisation", "speed before [mm/s]", "just before [N]", "50 ms after [N]", "jump [N]",
               "felt, off by at most [N]", "off by a fifth for [ms]"},
              {}};
  for (const Fig9::Part& part : fig9.parts)
    table.rows.push_back({part.name, fmt::format("{:.2f}", part.speed * 1e3), fmt::format("{:+.4f}", part.before_stop),
                          fmt::format("{:+.4f}", part.after_stop),
                          fmt::format("{:+.4f}", part.after_stop - part.before_stop),
                          fmt::format("{:.4f}", part.felt_error), fmt::format("{:.1f}", part.felt_error_time * 1e3)});
  return {"fig9",
          "Fig. 9: a 2nd-order Maxwell solid, stopped by a rigid obstacle",
          words_of(fig9),
          {figure_of(fig9)},
          {table}};
}

}  // namespace dashpot::paper
