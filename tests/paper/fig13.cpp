#include "fig13.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <laws.hpp>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"
#include "evaluated_law.hpp"

namespace dashpot::paper {
namespace {

constexpr double release_speed = 1.8;  // as printed [rad/s]
constexpr double printed_ratio = 1.9;  // of the undershoots, −3.8 and −2 rad/s as printed

// A line at `speed` [rad/s] of the hand's intention; the hand lets go on it.
Experiment drag_and_release(const device_description& plant, double hand, double speed) {
  const double drag = chosen("fig13.drag"), start = chosen("fig13.start");
  Experiment experiment{plant, {}, drag + chosen("fig13.watched"), {}};
  experiment.motion.user = simulated::mass_spring_damper(0, chosen("grip.damping"), hand);
  experiment.motion.user.release_time = drag;
  experiment.motion.initial_position = start;
  experiment.motion.intended = simulated::through({{0, start}, {1, start + speed * plant.arm_radius}});
  return experiment;
}

Experiment drag_and_release(const device_description& plant) {
  return drag_and_release(plant, chosen("grip.stiffness"), release_speed);
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

Fig13::Part part_of_fig13(const Experiment& experiment, const Realisation& realisation, const Style& style) {
  const double arm = experiment.plant.arm_radius, period = experiment.plant.loop.sample_period;
  Fig13::Part part{realisation.name, style, run(experiment, realisation), 0, 0, 0, 0, 0};
  const auto release = static_cast<std::size_t>(std::lround(chosen("fig13.drag") / period));
  const double lowest = extreme(part.trace, release, true);
  part.release_velocity = part.trace[release].velocity / arm;
  part.undershoot = lowest / arm;
  part.overshoot = extreme(part.trace, where(part.trace, release, lowest), false) / arm;
  const double settled = chosen("fig13.settled");
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

// The hand's intention at which a law is let go at the printed velocity: the loop is linear but for friction.
Fig13::Part released_as_printed(const device_description& plant, double hand, const LawMaker& law) {
  const Realisation realisation{"", law, plant.velocity, 0};
  double speed = release_speed;
  for (int round = 0; round < 2; ++round) {
    Experiment drag = drag_and_release(plant, hand, speed);
    drag.duration = chosen("fig13.drag");
    speed *= release_speed * plant.arm_radius / run(drag, realisation).back().velocity;
  }
  Experiment drag = drag_and_release(plant, hand, speed);
  drag.duration = chosen("fig13.drag") + chosen("fig13.watched_in_sweep");
  return part_of_fig13(drag, realisation, plain);
}

Fig13::Variation variation_of(double inertia, double hand, double tissue) {
  device_description plant = rig().description;
  plant.mechanics.inertia = inertia * 1e-3;
  const Fig13::Part single = released_as_printed(plant, hand, printed_law(tissue, "virtual")),
                    dual = released_as_printed(plant, hand, printed_law(tissue, "paper"));
  return {inertia,
          hand,
          tissue,
          single.undershoot,
          dual.undershoot,
          single.settling,
          dual.settling,
          single.release_velocity,
          dual.release_velocity};
}

std::vector<double> swept_values(const char* name, bool thinned) {
  const std::vector<double> all = chosen_list(name);
  return thinned ? std::vector<double>{all.front(), all.back()} : all;
}

std::vector<Fig13::Variation> all_variations(bool thinned) {
  std::vector<Fig13::Variation> all;
  for (const double tissue : swept_values("fig13.tissues", thinned))
    for (const double hand : swept_values("fig13.hands", thinned))
      for (const double inertia : swept_values("fig13.inertias", thinned))
        all.push_back(variation_of(inertia, hand, tissue));
  return all;
}

double distance(const Trace& trace, const Trace& truth, double from) {
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < std::min(trace.size(), truth.size()); ++k)
    if (truth[k].time >= from) {
      const double error = trace[k].velocity - truth[k].velocity;
      sum += error * error, ++count;
    }
  return std::sqrt(sum / count) / rig().description.arm_radius;
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
  const Interval shown{0.2, 0.9};  // from the drag on until all is at rest [s]
  return {"Fig. 13: a Maxwell element is dragged at 1.8 rad/s and let go",
          {fmt::format("K = {} N/m, B = {} N·s/m at 50 mm, {:g} g·m² of inertia; let go at {} s.",
                       chosen("tissue.stiffness"), chosen("tissue.damping"), 1e3 * rig().description.mechanics.inertia,
                       fig13.release),
           "Ideal: the emitted exact law on the same arm under a true velocity, without delay and quantisation."},
          {{"Velocity", "time [s]", "velocity [rad/s]", all(velocity), shown},
           {"Angle", "time [s]", "angle [rad]", all(angle), shown},
           {"Torque of motor and brake", "time [s]", "torque [mN·m]", all(torque), shown},
           {"Motor’s command", "time [s]", "force [N]", all(motor), shown}}};
}

constexpr Style of_tissue[] = {{"#c1440e", 1.6}, {"#0b5fa5", 1.6}, {"#2f8f5b", 1.6}, {"#8a4fa8", 1.6}};

// A curve for each element, under the softest hand; dashed under the stiffest.
template <class Value>
Panel swept(const Fig13& fig13, const char* title, const char* label, Value value, const Curve& mark) {
  Panel panel{title, "inertia of the arm [g·m²]", label, {}};
  const std::vector<double> hands = chosen_list("fig13.hands"), tissues = chosen_list("fig13.tissues");
  panel.x_range = Interval{mark.x.front(), mark.x.back()};
  panel.wide = true;
  for (const bool stiffest : {false, true})
    for (std::size_t i = 0; i < tissues.size(); ++i) {
      Style style = of_tissue[i % std::size(of_tissue)];
      if (stiffest) style.dashes = "3 3";
      Curve curve{stiffest ? "" : fmt::format("element of {} N/m", tissues[i]), style, {}, {}, Maker::evaluated};
      for (const Fig13::Variation& v : fig13.variations)
        if (v.hand == (stiffest ? hands.back() : hands.front()) && v.tissue == tissues[i])
          curve.x.push_back(v.inertia), curve.y.push_back(value(v));
      if (!curve.x.empty()) panel.curves.push_back(curve);
    }
  panel.curves.push_back(mark);
  return panel;
}

Figure swept_figure(const Fig13& fig13) {
  const std::vector<double> inertias = chosen_list("fig13.inertias"), hands = chosen_list("fig13.hands");
  const std::vector<double> ends = {inertias.front(), inertias.back()};
  const Curve ratio{"the paper’s ratio, −3.8/−2 rad/s", bound, ends, {printed_ratio, printed_ratio}, Maker::mark},
      sooner{"", bound, ends, {0, 0}, Maker::mark};
  return {"Fig. 13 over what the paper does not print: arm, hand, element",
          {fmt::format("Solid: dragged by a hand of {} N/m; dashed: of {} N/m. Each lets go at 1.8 rad/s.",
                       hands.front(), hands.back()),
           "The paper says that the dual channel settles sooner: above zero in the lower panel."},
          {swept(
               fig13, "Undershoot, single over dual channel", "ratio [1]",
               [](const Fig13::Variation& v) { return v.ratio(); }, ratio),
           swept(
               fig13, "How much sooner the dual channel settles", "time [ms]",
               [](const Fig13::Variation& v) { return 1e3 * v.advantage(); }, sooner)}};
}

// "0.03: 12 of 12, 0.04: …": for how many of the others the claim holds, by one of the parameters.
template <class Claim>
std::string by(const Fig13& fig13, const char* name, double Fig13::Variation::*parameter, Claim claim) {
  std::string list;
  for (const double value : chosen_list(name)) {
    int holds = 0, all = 0;
    for (const Fig13::Variation& v : fig13.variations)
      if (v.*parameter == value) ++all, holds += claim(v);
    list += fmt::format("{}{:g}: {} of {}", list.empty() ? "" : ", ", value, holds, all);
  }
  return list;
}

std::string verdict(const Fig13& fig13, bool (*claim)(const Fig13::Variation&)) {
  const auto holds = std::count_if(fig13.variations.begin(), fig13.variations.end(), claim);
  if (holds == 0) return "agrees with the paper nowhere in that range";
  if (holds == std::ptrdiff_t(fig13.variations.size())) return "agrees with the paper in all of that range";
  return fmt::format(
      "agrees with the paper in part of that range: by inertia in g·m², {}; by the hand’s stiffness in "
      "N/m, {}; by the element’s in N/m, {}",
      by(fig13, "fig13.inertias", &Fig13::Variation::inertia, claim),
      by(fig13, "fig13.hands", &Fig13::Variation::hand, claim),
      by(fig13, "fig13.tissues", &Fig13::Variation::tissue, claim));
}

bool swings_back_less(const Fig13::Variation& v) { return v.ratio() > 1; }
bool has_the_ratio(const Fig13::Variation& v) { return v.ratio() >= printed_ratio; }
bool settles_sooner(const Fig13::Variation& v) { return v.advantage() > 0; }

std::vector<std::string> words_of(const Fig13& fig13) {
  const Fig13::Part &truth = fig13.parts[0], &single = fig13.parts[1], &dual = fig13.parts[2], &rule = fig13.parts[3],
                    &own = fig13.parts[4];
  const Range ratio = range_of(fig13.variations, [](const auto& v) { return v.ratio(); });
  const Range advantage = range_of(fig13.variations, [](const auto& v) { return 1e3 * v.advantage(); });
  const auto nearer = [](double a, double b) { return a < b ? "nearer" : "no nearer"; };
  return {
      fmt::format(
          "With the values of the other figures the first undershoot is {:.2f} rad/s by the single motor and "
          "{:.2f} by the dual channel, a ratio of {:.2f}, where the paper has −3.8 and −2, a ratio of {}. The "
          "ideal element on the same arm has {:.2f}. The single motor {} it, the dual channel {} it: the paper’s "
          "order {}.",
          single.undershoot, dual.undershoot, single.undershoot / dual.undershoot, printed_ratio, truth.undershoot,
          single.undershoot < truth.undershoot ? "exceeds" : "stays below",
          dual.undershoot < truth.undershoot ? "exceeds" : "stays below", outcome(single.undershoot < dual.undershoot)),
      fmt::format("The paper does not print the arm’s inertia, the hand’s stiffness or the element. Over {:g} to {:g} "
                  "g·m², {:g} to {:g} N/m and {:g} to {:g} N/m the ratio is {:.2f} to {:.2f}: that the dual channel "
                  "swings back less {}; a ratio of {} or more {}.",
                  chosen_list("fig13.inertias").front(), chosen_list("fig13.inertias").back(),
                  chosen_list("fig13.hands").front(), chosen_list("fig13.hands").back(),
                  chosen_list("fig13.tissues").front(), chosen_list("fig13.tissues").back(), ratio.low, ratio.high,
                  verdict(fig13, swings_back_less), printed_ratio, verdict(fig13, has_the_ratio)),
      fmt::format("Over the same range the dual channel settles between {:.0f} ms later and {:.0f} ms sooner than the "
                  "single motor. “A faster settling time” {}. With the values of the other figures it {}: {:.0f} ms by "
                  "the single motor, {:.0f} ms by the dual channel, {:.0f} ms ideally. The assumed friction of 20 mN "
                  "stops the arm after a swing or two.",
                  std::max(0.0, -advantage.low), std::max(0.0, advantage.high), verdict(fig13, settles_sooner),
                  outcome(dual.settling < single.settling), single.settling * 1e3, dual.settling * 1e3,
                  truth.settling * 1e3),
      "Why the ratio is small with a soft element: with Z_d its impedance and τ the delay, both realisations lose the "
      "same "
      "damping to first order, ωτ·|Im Z_d|, because the brake’s b is real; what the dual channel gains is an apparent "
      "inertia bτ, which slows the swing, and damping to second order.",
      fmt::format(
          "dashpot by the paper’s rule swings back to {:.2f} rad/s, by its default, `faithful`, to {:.2f}. From "
          "the release on their velocity is off the ideal’s by {:.3f} and {:.3f} rad/s rms, the paper’s dual law "
          "by {:.3f}, the single motor by {:.3f}: the default is {} to the ideal than the paper’s dual law.",
          rule.undershoot, own.undershoot, rule.distance, own.distance, dual.distance, single.distance,
          nearer(own.distance, dual.distance))};
}

}  // namespace

Fig13 measure_fig13(bool thinned) {
  const device_description& plant = rig().description;
  const Experiment experiment = drag_and_release(plant), ideally = drag_and_release(ideal_rig());
  Fig13 fig13;
  fig13.release = chosen("fig13.drag");
  fig13.parts = {
      part_of_fig13(ideally, {"ideal", law_of<laws::maxwell_ideal>(), true_velocity(), 0}, ideal),
      part_of_fig13(experiment, {"single motor", law_of<laws::maxwell_single>(), plant.velocity, 0}, single_motor),
      part_of_fig13(experiment, {"dual channel", law_of<laws::maxwell_dual>(), plant.velocity, 0}, dual_channel),
      part_of_fig13(experiment, {by_papers_rule, law_of<laws::maxwell_by_rule>(), plant.velocity, 0}, third),
      part_of_fig13(experiment, {by_faithful_choice, law_of<laws::maxwell_own>(), plant.velocity, 0}, fourth)};
  for (Fig13::Part& part : fig13.parts) part.distance = distance(part.trace, fig13.parts[0].trace, fig13.release);
  fig13.variations = all_variations(thinned);
  return fig13;
}

Section show(const Fig13& fig13) {
  Table table{"After the release",
              {"realisation", "let go at [rad/s]", "first undershoot [rad/s]", "overshoot after it [rad/s]",
               "settled after [s]", "velocity off the ideal’s, rms [rad/s]"},
              {}};
  for (const Fig13::Part& part : fig13.parts)
    table.rows.push_back({part.name, fmt::format("{:.3f}", part.release_velocity),
                          fmt::format("{:.3f}", part.undershoot), fmt::format("{:.3f}", part.overshoot),
                          fmt::format("{:.3f}", part.settling), fmt::format("{:.3f}", part.distance)});
  std::vector<std::string> headings = {"hand [N/m]", "element [N/m]"};
  for (const Fig13::Variation& v : fig13.variations)
    if (v.hand == fig13.variations.front().hand && v.tissue == fig13.variations.front().tissue)
      headings.push_back(fmt::format("{} g·m²", v.inertia));
  Table variations{
      "Ratio of the undershoots / how much sooner the dual channel settles [ms], by the arm’s inertia", headings, {}};
  for (const Fig13::Variation& v : fig13.variations) {
    if (v.inertia == fig13.variations.front().inertia)
      variations.rows.push_back({fmt::format("{}", v.hand), fmt::format("{}", v.tissue)});
    variations.rows.back().push_back(fmt::format("{:.2f} / {:+.0f}", v.ratio(), 1e3 * v.advantage()));
  }
  return {"fig13",
          "Fig. 13: drag and release",
          words_of(fig13),
          {figure_of(fig13), swept_figure(fig13)},
          {table, variations}};
}

}  // namespace dashpot::paper
