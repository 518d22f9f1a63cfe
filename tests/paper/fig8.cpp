#include "fig8.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include <laws.hpp>

#include "chosen.hpp"
#include "curves.hpp"

namespace dashpot::paper {
namespace {

// Instants in strokes of the hand: in, rest, out, rest, in, rest, let go.
constexpr double in = 1, withdraw = 1.5, out = 2.5, again = 3, deep = 4, let_go = 4.5, end = 6.5;

double instant(double strokes) { return strokes * chosen("fig8.stroke"); }

Experiment press_and_release() {
  const device_description& plant = rig().description;
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
  experiment.realisations = {
      {"wall of the literature, single motor", law_of<WhileInside<laws::kelvin_single>>(), plant.velocity, 0},
      {"wall of the literature, dual channel", law_of<WhileInside<laws::kelvin_dual>>(), plant.velocity, 0},
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
    if (!passed && force <= 0) release.point = sample.position, passed = true;
  }
  return release;
}

Fig8::Part part_of(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  Fig8::Part part{realisation.name, style, run(experiment, realisation), {}, {}};
  part.withdrawn = release_within(part.trace, instant(withdraw), instant(again));
  part.let_go = release_within(part.trace, instant(let_go), instant(end));
  return part;
}

Figure figure_of(const Fig8& fig8) {
  const auto all = [&](auto value) {
    std::vector<Curve> curves;
    for (const Fig8::Part& part : std::span(fig8.parts).first(4))
      curves.push_back(curve_of(part.name, part.style, part.trace, value));
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
       "Forces push the tool out where they are positive. Felt: motor and brake."},
      {{"Position", "time [s]", "position [mm]", all(position), whole},
       {"Motor’s command", "time [s]", "force [N]", all(motor), whole},
       {"Felt force, withdrawn", "time [s]", "force [N]", all(felt), around},
       {"Motor’s command, withdrawn", "time [s]", "force [N]", all(motor), around}}};
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
  const Experiment experiment = press_and_release();
  Experiment prompt = experiment;
  prompt.plant.brake.coil_lag = prompt.plant.brake.slew = 0;
  const Style styles[] = {single_motor, dual_channel, {"#e08e0b", 1.4, "6 3"}, {"#1a1a1a", 1.4, "2 3"}};
  Fig8 fig8;
  for (std::size_t i = 0; i < experiment.realisations.size(); ++i)
    fig8.parts.push_back(part_of(experiment, experiment.realisations[i], styles[i]));
  fig8.parts.push_back(part_of(prompt, experiment.realisations.back(), plain));
  fig8.parts.back().name = "contact, dual channel, coil without lag";
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
  return {"fig8",
          "Fig. 8: contact with a Kelvin element, and release",
          {fmt::format(
               "Withdrawn by the hand, the wall of the literature pulls: {:.1f} mN·s by the single motor, {:.1f} mN·s "
               "by the dual "
               "channel. The paper’s panels show the motor’s command alone, and there the dual channel’s spike is gone "
               "indeed ({:.3f} mN·s); but the brake resists the withdrawal in its place, and the hand feels the same.",
               fig8.parts[0].withdrawn.impulse * 1e3, fig8.parts[1].withdrawn.impulse * 1e3,
               fig8.parts[1].withdrawn.motor_impulse * 1e3),
           fmt::format("With a contact the tissue is left where it would begin to pull. The single motor pulls {:.3f} "
                       "mN·s, the dual channel "
                       "{:.3f}: not none, but {:.0f} times less than the wall. What is left is the brake after it has "
                       "been told to let "
                       "go: without the coil’s lag it is {:.3f} mN·s in {} releases, each of which may cost b times an "
                       "encoder step, "
                       "0.012 mN·s.",
                       fig8.parts[2].withdrawn.impulse * 1e3, fig8.parts[3].withdrawn.impulse * 1e3,
                       fig8.parts[1].withdrawn.impulse / fig8.parts[3].withdrawn.impulse,
                       fig8.parts[4].withdrawn.impulse * 1e3, fig8.parts[4].withdrawn.releases),
           fmt::format("Let go, the tool recovers with the tissue and touches it again and again: the dual channel’s "
                       "brake is told to let go "
                       "{} times within 0.8 s, and pulls {:.2f} mN·s by its lag.",
                       fig8.parts[3].let_go.releases, fig8.parts[3].let_go.impulse * 1e3)},
          {figure_of(fig8)},
          {table}};
}

}  // namespace dashpot::paper
