#include "fig8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <laws.hpp>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"

namespace dashpot::paper {
namespace {

// Of the hand, as fig8.instants lists them.
enum Event : unsigned char { in, withdraw, out, again, deep, let_go, end };

double instant(Event event) { return chosen_list("fig8.instants").at(event) * chosen("fig8.stroke"); }

Experiment press_and_release(const device_description& plant) {
  const double clear = chosen("fig8.approach"), depth = chosen("fig8.depth");
  Experiment experiment{plant, {}, instant(end), {}};
  experiment.motion.user = grip();
  experiment.motion.user.release_time = instant(let_go);
  experiment.motion.initial_position = clear;
  experiment.motion.intended = simulated::smoothly_through({{0, clear},
                                                            {instant(in), depth},
                                                            {instant(withdraw), depth},
                                                            {instant(out), clear},
                                                            {instant(again), clear},
                                                            {instant(deep), depth}});
  experiment.realisations = {{"wall (9), single motor", law_of<WhileInside<laws::kelvin_single>>(), plant.velocity, 0},
                             {"wall (9), dual channel", law_of<WhileInside<laws::kelvin_dual>>(), plant.velocity, 0},
                             {"contact, single motor", law_of<laws::contact_single>(), plant.velocity, 0},
                             {"contact, dual channel", law_of<laws::contact_dual>(), plant.velocity, 0}};
  return experiment;
}

// Of the tissue: what motor and brake make beyond the brake's residual, which is the device's own [N].
double tissue_force(const Sample& sample, double residual) {
  return sample.motor + (sample.damping - residual) * sample.velocity;
}

Fig8::Release release_within(const Trace& trace, double from, double to) {
  const device_description& plant = rig().description;
  const double residual = plant.brake.residual_damping / (plant.arm_radius * plant.arm_radius);
  constexpr double rounding = 1e-9;  // where motor and residual cancel [N]
  Fig8::Release release;
  bool passed = false;
  double told = 0;  // damping, one sample before
  for (const Sample& sample : trace) {
    if (sample.time < from || sample.time >= to) continue;
    const double force = tissue_force(sample, residual), period = plant.loop.sample_period;
    release.impulse += std::max(0.0, -force) * period;
    release.motor_impulse += std::max(0.0, -sample.motor) * period;
    release.largest_pull = std::max(release.largest_pull, -force);
    if (told > 0 && sample.commanded.damping == 0) ++release.releases;
    told = sample.commanded.damping;
    if (!passed && force < rounding) release.point = sample.position, passed = true;
  }
  return release;
}

Fig8::Part part_of_fig8(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  Fig8::Part part{realisation.name, style, run(experiment, realisation), {}, {}, realisation.law.maker};
  part.withdrawn = release_within(part.trace, instant(withdraw), instant(again));
  part.let_go = release_within(part.trace, instant(let_go), instant(end));
  return part;
}

Figure figure_of(const Fig8& fig8) {
  const auto drawn = [&](std::initializer_list<std::size_t> which, auto value) {
    std::vector<Curve> curves;
    for (const std::size_t i : which) {
      const Fig8::Part& part = fig8.parts[i];
      curves.push_back(curve_of(part.name, part.style, part.trace, value, part.maker));
    }
    return curves;
  };
  const auto position = [](const Sample& s) { return s.position * 1e3; };
  const auto motor = [](const Sample& s) { return s.commanded.force; };
  const auto felt = [](const Sample& s) { return s.felt(); };
  double release = 0;
  for (const Sample& sample : fig8.parts[0].trace)
    if (sample.time < instant(again) && sample.position > 0) release = sample.time;
  const Interval around{release - 0.1, release + 0.05}, whole{0, instant(end)};
  return {
      "Fig. 8: contact with a Kelvin element, and release",
      {fmt::format("K = {} N/m, B = {} N·s/m. Pressed and withdrawn by the hand, pressed again and let go at {:.1f} s.",
                   chosen("tissue.stiffness"), chosen("tissue.damping"), instant(let_go)),
       "Forces push the tool out where they are positive. Felt: motor and brake.",
       "Ideal: the same arm under a true velocity, without delay, quantisation and lags."},
      {{"Position", "time [s]", "position [mm]", drawn({5, 0, 1}, position), whole},
       {"Motor’s command", "time [s]", "force [N]", drawn({5, 0, 1}, motor), whole},
       {"Wall (9) withdrawn: motor’s command", "time [s]", "force [N]", drawn({5, 0, 1}, motor), around},
       {"Wall (9) withdrawn: felt", "time [s]", "force [N]", drawn({5, 0, 1}, felt), around},
       {"Contact withdrawn: motor’s command", "time [s]", "force [N]", drawn({6, 2, 3}, motor), around},
       {"Contact withdrawn: felt", "time [s]", "force [N]", drawn({6, 2, 3}, felt), around}}};
}

std::vector<std::string> words_of(const Fig8& fig8) {
  const auto withdrawn = [&](std::size_t i) { return fig8.parts[i].withdrawn.impulse * 1e3; };
  const double single = withdrawn(0), dual = withdrawn(1), truth = fig8.ideal_wall().withdrawn.impulse * 1e3;
  const bool is_of_the_model = truth > single / 2;
  const bool motor_is_smooth = fig8.parts[1].withdrawn.motor_impulse < 0.01 * fig8.parts[0].withdrawn.motor_impulse;
  const double step = rig().description.encoder.step * rig().description.arm_radius * chosen("tissue.damping");
  const Fig8::Release& loose = fig8.parts[3].let_go;
  return {
      fmt::format("Withdrawn by the hand, the wall (9) pulls: {:.1f} mN·s by the single motor, {:.1f} mN·s by the dual "
                  "channel, and {:.1f} mN·s on an ideal device. So the “stickiness” of this wall is {}: delay and "
                  "quantisation {} {:.1f} mN·s.",
                  single, dual, truth,
                  is_of_the_model ? "that of (9) itself, whose damper pulls on the way out, rather than an artifact of "
                                    "the delay"
                                  : "an artifact of the delay rather than of (9)",
                  single > truth ? "add to it" : "take from it", std::abs(single - truth)),
      fmt::format("The paper’s panels show the motor’s command alone, and there its claim that brakes remove the spike "
                  "{} ({:.3f} mN·s by the dual channel’s motor, {:.3f} by the single one). Felt it {}: {}.",
                  outcome(motor_is_smooth), fig8.parts[1].withdrawn.motor_impulse * 1e3,
                  fig8.parts[0].withdrawn.motor_impulse * 1e3, outcome(dual < single / 2),
                  dual < single / 2 ? "the hand is pulled less than half as much"
                                    : "the brake resists the withdrawal in the motor’s place"),
      fmt::format(
          "With a contact the tissue is left where it would begin to pull: {:.3f} mN·s by the single motor, {:.3f} "
          "by the dual channel, {:.3f} ideally; {:.0f} times less than the wall by the dual channel. What is left "
          "there is the brake after it has been told to let go: without the coil’s lag it is {:.3f} mN·s in {} "
          "releases, each of which may cost b times an encoder step, {:.3f} mN·s.",
          withdrawn(2), withdrawn(3), fig8.ideal_contact().withdrawn.impulse * 1e3, dual / withdrawn(3), withdrawn(4),
          fig8.parts[4].withdrawn.releases, step * 1e3),
      fmt::format(
          "Let go, “the recovery states look similar” {}: single motor and dual channel differ by at most {:.2f} "
          "mm of {:g}. With the contact the tool recovers with the tissue and touches it again and again: the "
          "dual channel’s brake is told to let go {} times within {:.1f} s, and pulls {:.2f} mN·s by its lag.",
          outcome(fig8.recovery_difference < 0.1 * chosen("fig8.depth")), fig8.recovery_difference * 1e3,
          chosen("fig8.depth") * 1e3, loose.releases, instant(end) - instant(let_go), loose.impulse * 1e3)};
}

std::vector<std::string> row(const std::string& name, const char* event, const Fig8::Release& release) {
  return {name,
          event,
          fmt::format("{:.3f}", release.impulse * 1e3),
          fmt::format("{:.3f}", release.motor_impulse * 1e3),
          fmt::format("{:.3f}", release.largest_pull),
          fmt::format("{:.2f}", release.point * 1e3),
          fmt::format("{}", release.releases)};
}

}  // namespace

Fig8 measure_fig8() {
  const Experiment experiment = press_and_release(rig().description), ideally = press_and_release(ideal_rig());
  Experiment prompt = experiment;
  prompt.plant.brake.coil_lag = prompt.plant.brake.slew = 0;
  const Style styles[] = {single_motor, dual_channel, single_motor, dual_channel};
  Fig8 fig8;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig8.parts.push_back(part_of_fig8(experiment, experiment.realisations[i], styles[i]));
  fig8.parts.push_back(part_of_fig8(prompt, experiment.realisations.back(), plain));
  fig8.parts.back().name = "contact, dual channel, coil without lag";
  fig8.parts.push_back(
      part_of_fig8(ideally, {"ideal wall (9)", law_of<WhileInside<laws::kelvin_ideal>>(), true_velocity(), 0}, ideal));
  fig8.parts.push_back(
      part_of_fig8(ideally, {"ideal contact", law_of<laws::contact_single>(), true_velocity(), 0}, ideal));
  const Trace &single = fig8.parts[0].trace, &dual = fig8.parts[1].trace;
  for (std::size_t k = 0; k < single.size(); ++k)
    if (single[k].time >= instant(let_go))
      fig8.recovery_difference = std::max(fig8.recovery_difference, std::abs(single[k].position - dual[k].position));
  return fig8;
}

Section show(const Fig8& fig8) {
  Table table{"How much the tissue pulls the tool inwards",
              {"realisation", "way out", "impulse, felt [mN·s]", "impulse, motor alone [mN·s]", "largest pull [N]",
               "felt force zero at [mm]", "releases"},
              {}};
  for (const Fig8::Part& part : fig8.parts) {
    table.rows.push_back(row(part.name, "withdrawn", part.withdrawn));
    table.rows.push_back(row(part.name, "let go", part.let_go));
  }
  return {"fig8", "Fig. 8: contact with a Kelvin element, and release", words_of(fig8), {figure_of(fig8)}, {table}};
}

}  // namespace dashpot::paper
