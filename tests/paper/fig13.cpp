#include "fig13.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <laws.hpp>

#include "chosen.hpp"
#include "curves.hpp"
#include "evaluated_law.hpp"

namespace dashpot::paper {
namespace {

constexpr double release_speed = 1.8;  // [rad/s], as printed
constexpr double settled = 0.05;       // of the speed at release: the usual band
constexpr double watched = 0.8;        // after the release [s]

// A line at the printed speed; the hand lets go on it.
Experiment drag_and_release(const device_description& plant) {
  Experiment experiment{plant, {}, chosen("fig13.drag") + watched, {}};
  const double speed = release_speed * plant.arm_radius, start = chosen("fig13.start");
  experiment.motion.user = grip();
  experiment.motion.user.release_time = chosen("fig13.drag");
  experiment.motion.initial_position = start;
  experiment.motion.intended = simulated::through({{0, start}, {1, start + speed}});
  return experiment;
}

double extreme(const Trace& trace, std::size_t first, bool lowest) {
  double extreme = trace[first].velocity;
  for (std::size_t k = first; k < trace.size(); ++k)
    extreme = lowest ? std::min(extreme, trace[k].velocity) : std::max(extreme, trace[k].velocity);
  return extreme;
}

std::size_t where(const Trace& trace, std::size_t first, double velocity) {
  std::size_t k = first;
  while (k + 1 < trace.size() && trace[k].velocity != velocity) ++k;
  return k;
}

Fig13::Part part_of(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  const double arm = experiment.plant.arm_radius, period = experiment.plant.loop.sample_period;
  Fig13::Part part{realisation.name, style, run(experiment, realisation), 0, 0, 0, 0};
  const auto release = static_cast<std::size_t>(std::lround(chosen("fig13.drag") / period));
  const double lowest = extreme(part.trace, release, true);
  part.release_velocity = part.trace[release].velocity / arm;
  part.undershoot = lowest / arm;
  part.overshoot = extreme(part.trace, where(part.trace, release, lowest), false) / arm;
  std::size_t last = part.trace.size() - 1;
  while (last > release && std::abs(part.trace[last].velocity) < settled * std::abs(part.trace[release].velocity))
    --last;
  part.settling = part.trace[last].time - part.trace[release].time;
  return part;
}

// The laws that the paper prints, for a single motor or with b = B.
LawMaker printed_law(double stiffness, const char* decomposition) {
  compiler::Choices choices;
  choices.rate = 1 / rig().description.loop.sample_period;
  choices.scheme = compiler::Scheme::backward_euler;
  choices.state_input = compiler::StateInput::velocity;
  choices.decomposition = decomposition;
  return law_of(compiled(maxwell_element(stiffness, chosen("tissue.damping")), choices));
}

Fig13::Variation variation_of(const Experiment& experiment, double stiffness) {
  const velocity_description& velocity = experiment.plant.velocity;
  return {stiffness, part_of(experiment, {"", printed_law(stiffness, "virtual"), velocity, 0}, plain).undershoot,
          part_of(experiment, {"", printed_law(stiffness, "most-dissipative"), velocity, 0}, plain).undershoot};
}

Figure figure_of(const Fig13& fig13) {
  const double arm = rig().description.arm_radius;
  const auto velocity = [&](const Sample& s) { return s.velocity / arm; };
  const auto motor = [](const Sample& s) { return s.commanded.force; };
  const auto torque = [&](const Sample& s) { return s.felt() * arm * 1e3; };
  const auto angle = [&](const Sample& s) { return s.position / arm; };
  const auto all = [&](auto value) {
    std::vector<Curve> curves;
    for (const Fig13::Part& part : fig13.parts) curves.push_back(curve_of(part.name, part.style, part.trace, value));
    return curves;
  };
  const Interval shown{0, chosen("fig13.drag") + watched};
  return {"Fig. 13: a Maxwell element is dragged at 1.8 rad/s and let go",
          {fmt::format("K = {} N/m, B = {} N·s/m at 50 mm, 0.1 g·m² of inertia; let go at {} s.",
                       chosen("tissue.stiffness"), chosen("tissue.damping"), fig13.release)},
          {{"Velocity", "time [s]", "velocity [rad/s]", all(velocity), shown},
           {"Angle", "time [s]", "angle [rad]", all(angle), shown},
           {"Torque of motor and brake", "time [s]", "torque [mN·m]", all(torque), shown},
           {"Motor’s command", "time [s]", "force [N]", all(motor), shown}}};
}

}  // namespace

Fig13 measure_fig13() {
  const device_description& plant = rig().description;
  const Experiment experiment = drag_and_release(plant), ideally = drag_and_release(ideal_rig());
  Fig13 fig13;
  fig13.release = chosen("fig13.drag");
  fig13.parts = {
      part_of(ideally, {"ideal", law_of<laws::maxwell_ideal>(), true_velocity(), 0}, ideal),
      part_of(experiment, {"single motor", law_of<laws::maxwell_single>(), plant.velocity, 0}, single_motor),
      part_of(experiment, {"dual channel", law_of<laws::maxwell_dual>(), plant.velocity, 0}, dual_channel),
      part_of(experiment, {"dashpot’s choice for this device", law_of<laws::maxwell_own>(), plant.velocity, 0}, third)};
  for (const double factor : {1, 2, 4, 8})
    fig13.variations.push_back(variation_of(experiment, factor * chosen("tissue.stiffness")));
  return fig13;
}

Section show(const Fig13& fig13) {
  Table table{"After the release",
              {"realisation", "let go at [rad/s]", "first undershoot [rad/s]", "overshoot after it [rad/s]",
               "settled after [s]"},
              {}};
  for (const Fig13::Part& part : fig13.parts)
    table.rows.push_back({part.name, fmt::format("{:.3f}", part.release_velocity),
                          fmt::format("{:.3f}", part.undershoot), fmt::format("{:.3f}", part.overshoot),
                          fmt::format("{:.3f}", part.settling)});
  Table variations{"The same with stiffer springs: what the ratio depends on",
                   {"K [N/m]", "single motor [rad/s]", "dual channel [rad/s]", "ratio"},
                   {}};
  for (const Fig13::Variation& v : fig13.variations)
    variations.rows.push_back({fmt::format("{}", v.stiffness), fmt::format("{:.2f}", v.single),
                               fmt::format("{:.2f}", v.dual), fmt::format("{:.2f}", v.single / v.dual)});
  const double ratio = fig13.parts[1].undershoot / fig13.parts[2].undershoot;
  return {"fig13",
          "Fig. 13: drag and release",
          {fmt::format("First undershoot: single motor {:.2f}, dual channel {:.2f} rad/s, a ratio of {:.2f}; the paper "
                       "has −3.8 and −2, a "
                       "ratio of 1.9. The ideal element, on the same arm without delay and quantisation, has {:.2f}: "
                       "the single motor exceeds it, the "
                       "dual channel stays below.",
                       fig13.parts[1].undershoot, fig13.parts[2].undershoot, ratio, fig13.parts[0].undershoot),
           "That the size does not come out has a reason. With Z_d the element’s impedance and τ the delay, both "
           "realisations lose the "
           "same damping to first order, ωτ·|Im Z_d|, because the brake’s b is real; what the dual channel gains is an "
           "apparent "
           "inertia bτ, which slows the swing, and damping to second order. The ratio grows with the stiffness (second "
           "table). "
           "Which stiffness and inertia the paper’s rig had is not printed.",
           fmt::format("Settling does not come out either: {:.0f} ms by the single motor, {:.0f} ms by the dual "
                       "channel, {:.0f} ms ideally. "
                       "The assumed friction of 20 mN stops the arm after one swing in each case, and the dual "
                       "channel’s is slower.",
                       fig13.parts[1].settling * 1e3, fig13.parts[2].settling * 1e3, fig13.parts[0].settling * 1e3)},
          {figure_of(fig13)},
          {table, variations}};
}

}  // namespace dashpot::paper
