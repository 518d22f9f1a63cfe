#include "limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chosen.hpp"
#include "claims.hpp"
#include "curves.hpp"

namespace dashpot::paper {
namespace {

// (9) without its spring, by the motor alone.
struct VirtualDamper {
  double damping;  // [N·s/m]

  void reset(double) noexcept {}
  command<double> output(double, double velocity) noexcept { return {0, damping * velocity}; }
  void update() noexcept {}
};

device_description rig_with(const Limits::Faults& faults) {
  device_description plant = rig().description;
  plant.motor.noise = faults.noise * 1e-3;
  plant.mechanics.inertia = faults.inertia * 1e-3;
  if (faults.mode == 0) return plant;
  plant.mechanics.mode = {faults.mode, chosen("limits.mode_damping"),
                          chosen("limits.mode_share") * plant.mechanics.inertia};
  plant.mechanics.backlash = faults.backlash * 1e-3;
  return plant;
}

velocity_description filter(double cutoff) {
  velocity_description velocity = rig().description.velocity;
  velocity.cutoff = cutoff;
  return velocity;
}

velocity_description one_sample() {
  velocity_description velocity;
  velocity.estimator = estimator_kind::backward_difference;
  velocity.window = 1;
  return velocity;
}

// A hand leads the arm at a constant speed against `damping` [mN·m·s].
Trace led(const device_description& plant, const velocity_description& velocity, double damping) {
  const double speed = chosen("limits.speed") * plant.arm_radius;
  Experiment experiment{plant, {}, chosen("limits.duration"), {}};
  experiment.motion.user = grip();
  experiment.motion.initial_velocity = speed;
  experiment.motion.intended = simulated::through({{0, 0}, {1, speed}});
  const double at_tool = damping * 1e-3 / (plant.arm_radius * plant.arm_radius);
  return run(experiment, {"", law_with(VirtualDamper{at_tool}), velocity, 0});
}

// rms of the motor's torque about its mean at the end of the run [N·m].
double ripple(const Trace& trace) {
  double sum = 0, squares = 0, count = 0;
  const auto judged =
      static_cast<std::size_t>(std::lround(chosen("limits.judged") / rig().description.loop.sample_period));
  for (std::size_t k = trace.size() - judged; k < trace.size(); ++k)
    sum += trace[k].motor, squares += trace[k].motor * trace[k].motor, ++count;
  return rig().description.arm_radius * std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count)));
}

double largest_smooth_damping(const device_description& plant, const velocity_description& velocity) {
  const auto is_smooth = [&](double damping) {
    return ripple(led(plant, velocity, damping)) < plant.mechanics.coulomb_friction;
  };
  const double least = chosen_list("limits.dampings").front(), most = chosen_list("limits.dampings").back();
  const double factor = std::pow(10, 1 / chosen("limits.steps"));
  double low = 0, high = least;
  while (high <= most && is_smooth(high)) low = high, high *= factor;
  if (high > most) return most;
  for (int round = 0; round < 3 && low > 0; ++round) {
    const double middle = std::sqrt(low * high);
    (is_smooth(middle) ? low : high) = middle;
  }
  return low;
}

Limits::Bound bound_of(const device_description& plant, const velocity_description& velocity) {
  device_description stepless = plant;
  stepless.encoder.step = stepless.motor.noise = stepless.loop.jitter = 0;
  return {largest_smooth_damping(plant, velocity), largest_smooth_damping(stepless, velocity)};
}

std::vector<double> cutoffs(bool thinned) {
  const std::vector<double> all = chosen_list("limits.cutoffs");
  return thinned ? std::vector<double>{all.front(), all.back()} : all;
}

Limits::Row row_of(const Limits::Faults& faults, const std::vector<double>& over) {
  const device_description plant = rig_with(faults);
  Limits::Row row{faults, bound_of(plant, one_sample()), bound_of(plant, rig().description.velocity), over, {}};
  for (const double cutoff : over) row.by_cutoff.push_back(bound_of(plant, filter(cutoff)));
  return row;
}

Limits::Faults all_faults(double mode, double inertia) {
  return {"mode, backlash and noise", mode, chosen("limits.backlash"), chosen("limits.noise"), inertia};
}

Curve over_cutoff(const Limits::Row& row, const char* name, double Limits::Bound::*bound, const Style& style) {
  Curve curve{name, style, {}, {}, Maker::by_hand};
  for (std::size_t i = 0; i < row.cutoffs.size(); ++i)
    curve.x.push_back(row.cutoffs[i]), curve.y.push_back(row.by_cutoff[i].*bound);
  return curve;
}

Curve over_mode(const Limits& limits, double inertia, const char* name, Limits::Bound Limits::Row::*estimator,
                const Style& style) {
  Curve curve{fmt::format("{}, {} g·m²", name, inertia), style, {}, {}, Maker::by_hand};
  for (const Limits::Row& row : limits.modes)
    if (row.faults.inertia == inertia) curve.x.push_back(row.faults.mode), curve.y.push_back((row.*estimator).smooth);
  return curve;
}

Curve level(const char* name, const Interval& range, double value, const Style& style) {
  return {name, style, {range.low, range.high}, {value, value}, Maker::mark};
}

Panel wide(const char* title, const char* x, std::vector<Curve> curves, const Interval& range) {
  Panel panel{title, x, "virtual damping [mN·m·s]", std::move(curves), range, Interval{0.9, 200}};
  panel.x_scale = panel.y_scale = Scale::logarithmic;
  panel.wide = true;
  return panel;
}

Figure limits_figure(const Limits& limits) {
  const Limits::Row &rigid = limits.rows.front(), &all = limits.rows.back();
  const Interval cutoffs{chosen_list("limits.cutoffs").front(), chosen_list("limits.cutoffs").back()},
      modes{chosen_list("limits.modes").front(), chosen_list("limits.modes").back()};
  const Style grey{"#7f7f7f", 1.4, "5 3"};
  Panel over_cutoffs = wide("Over the cutoff of a 4th-order filter", "cutoff [Hz]",
                            {over_cutoff(rigid, "rigid, smooth", &Limits::Bound::smooth, ideal),
                             over_cutoff(all, "all faults, smooth", &Limits::Bound::smooth, single_motor),
                             over_cutoff(all, "all faults, loop stable", &Limits::Bound::stable, dual_channel),
                             {"all faults, without a filter, smooth",
                              grey,
                              {cutoffs.low, cutoffs.high},
                              {all.raw.smooth, all.raw.smooth},
                              Maker::by_hand},
                             level("the brake’s, 7 mN·m·s as printed", cutoffs, printed_damping, bound)},
                            cutoffs);
  Panel over_modes = wide("Over the frequency of the mode", "frequency of the mode [Hz]", {}, modes);
  constexpr Style of_inertia[][2] = {{{"#2f8f5b", 1.6, "6 3"}, {"#8a6d3b", 1.6}},
                                     {{"#2f8f5b", 1.6, "1 3"}, {"#8a6d3b", 1.6, "1 3"}}};
  const std::vector<double> inertias = chosen_list("limits.inertias");
  for (std::size_t i = 0; i < inertias.size(); ++i) {
    over_modes.curves.push_back(over_mode(limits, inertias[i], "no filter", &Limits::Row::raw, of_inertia[i % 2][0]));
    over_modes.curves.push_back(
        over_mode(limits, inertias[i], "120 Hz filter", &Limits::Row::filtered, of_inertia[i % 2][1]));
  }
  over_modes.curves.push_back(level("the brake’s, 7 mN·m·s as printed", modes, printed_damping, bound));
  const auto torque = [](const Sample& s) { return 1e3 * rig().description.arm_radius * s.motor; };
  const auto run = [&](std::size_t i) {
    return curve_of(limits.runs[i].name, limits.runs[i].style, limits.runs[i].trace, torque, Maker::by_hand);
  };
  const double end = chosen("limits.duration");
  return {"Limits: virtual damping by a motor, before its torque is rough",
          {fmt::format("Led by a hand at {:g} rad/s. Smooth: the motor’s torque ripples by no more than the arm’s own",
                       chosen("limits.speed")),
           fmt::format("friction, {:g} mN·m rms.", 1e3 * rig().description.mechanics.coulomb_friction),
           "Loop stable: the same without encoder steps, noise and jitter: the loop’s own oscillation.",
           fmt::format("All faults: mode of {:g} Hz, backlash of {:g} mrad, noise of {:g} mN·m.", chosen("limits.mode"),
                       chosen("limits.backlash"), chosen("limits.noise"))},
          {over_cutoffs,
           over_modes,
           {"7 mN·m·s: motor’s torque", "time [s]", "torque [mN·m]", {run(0), run(1)}, Interval{end - 0.01, end}},
           {"Half as much again as is stable", "time [s]", "torque [mN·m]", {run(2)}, Interval{0, end}}}};
}

double best_smooth(const Limits::Row& row) {
  double best = std::max(row.raw.smooth, row.filtered.smooth);
  for (const Limits::Bound& each : row.by_cutoff) best = std::max(best, each.smooth);
  return best;
}

// Cutoffs at which the printed damping is smooth.
std::string sufficient_cutoffs(const Limits::Row& row) {
  std::string list;
  for (std::size_t i = 0; i < row.cutoffs.size(); ++i)
    if (row.by_cutoff[i].smooth >= printed_damping)
      list += fmt::format("{}{:g}", list.empty() ? "" : ", ", row.cutoffs[i]);
  return list.empty() ? "no cutoff" : list + " Hz";
}

// Whether the filter is needed for the printed damping; the search resolves 5 %.
std::string necessity(const Limits::Row& row) {
  if (std::abs(row.raw.smooth / printed_damping - 1) < 0.1) return "is undecided";
  return outcome(row.raw.smooth < printed_damping && row.filtered.smooth >= printed_damping);
}

std::vector<std::string> words_of(const Limits& limits) {
  const Limits::Row &rigid = limits.rows.front(), &all = limits.rows.back();
  const double gain = all.filtered.smooth / all.raw.smooth;
  const bool filter_suffices = all.filtered.smooth >= printed_damping;
  const auto ends = [](double value) { return value < chosen_list("limits.dampings").back(); };
  const bool always_ends = std::all_of(limits.modes.begin(), limits.modes.end(), [&](const Limits::Row& row) {
    return ends(row.raw.smooth) && ends(row.filtered.smooth);
  });
  const Range raw = range_of(limits.modes, [](const Limits::Row& row) { return row.raw.smooth; });
  const Range filtered = range_of(limits.modes, [](const Limits::Row& row) { return row.filtered.smooth; });
  const auto nearest = std::min_element(limits.modes.begin(), limits.modes.end(), [](const auto& a, const auto& b) {
    return std::abs(std::log(a.filtered.smooth / printed_damping)) <
           std::abs(std::log(b.filtered.smooth / printed_damping));
  });
  return {
      fmt::format(
          "§2.2: filters raise the viscosity “by an order of magnitude, roughly”. With mode, backlash and noise "
          "the motor’s torque stays smooth up to {:.1f} mN·m·s without a filter and {:.1f} with the paper’s, "
          "{:.1f} times as much; on the rigid rig {:.1f} and {:.1f}. That {} (3 to 30 times). “There is always "
          "a point where limit cycles occur”: that {}; the lower right panel shows one, half as much again as "
          "is stable.",
          all.raw.smooth, all.filtered.smooth, gain, rigid.raw.smooth, rigid.filtered.smooth,
          outcome(gain > 3 && gain < 30), outcome(always_ends)),
      fmt::format("§6.2: the 120 Hz filter is necessary for a virtual damping of the brake’s 7 mN·m·s. That {}: {:.1f} "
                  "are smooth without a filter, in proportion to the assumed friction that smooth is measured by, and "
                  "the filter {} for it; of 4th-order filters so do {}. What ends it without a filter is the encoder’s "
                  "steps, not the loop: that is stable up to {:.0f} mN·m·s.",
                  necessity(all), all.raw.smooth, filter_suffices ? "suffices" : "does not suffice",
                  sufficient_cutoffs(all), all.raw.stable),
      fmt::format(
          "A limit of virtual damping near 7 mN·m·s {} with the paper’s filter: over modes of {:g} to {:g} Hz and "
          "inertias of {:g} to {:g} g·m² it is {:.1f} to {:.1f} mN·m·s ({:.1f} to {:.1f} without a filter), "
          "nearest with a mode of {:g} Hz and {:g} g·m². The mode lowers it where it is below some 200 Hz; noise "
          "and backlash of these sizes change it by {:.0f} and {:.0f} %, where the search resolves 5 %.",
          outcome(std::abs(nearest->filtered.smooth / printed_damping - 1) < 0.3), chosen_list("limits.modes").front(),
          chosen_list("limits.modes").back(), chosen_list("limits.inertias").back(),
          chosen_list("limits.inertias").front(), filtered.low, filtered.high, raw.low, raw.high, nearest->faults.mode,
          nearest->faults.inertia, 100 * std::abs(limits.rows[1].filtered.smooth / rigid.filtered.smooth - 1),
          100 * std::abs(limits.rows[3].filtered.smooth / limits.rows[2].filtered.smooth - 1))};
}

}  // namespace

Limits measure_limits(bool thinned) {
  const double mode = chosen("limits.mode");
  Limits limits;
  const std::vector<double> inertias = chosen_list("limits.inertias");
  const double own = inertias.front(), noise = chosen("limits.noise"), backlash = chosen("limits.backlash");
  const Limits::Faults rigid{"rigid, as in the other figures", 0, 0, 0, own};
  limits.rows = {row_of(rigid, cutoffs(thinned)), row_of({"noise", 0, 0, noise, own}, {}),
                 row_of({"mode", mode, 0, 0, own}, {}), row_of({"mode and backlash", mode, backlash, 0, own}, {}),
                 row_of(all_faults(mode, own), cutoffs(thinned))};
  std::vector<double> modes = chosen_list("limits.modes");
  if (thinned) modes = {modes.front(), modes.back()};
  for (const double inertia : inertias)
    for (const double each : modes) limits.modes.push_back(row_of(all_faults(each, inertia), {}));
  const device_description plant = rig_with(all_faults(mode, own));
  const velocity_description& paper = rig().description.velocity;
  const double too_much = 1.5 * limits.rows.back().filtered.stable;
  limits.runs = {
      {"difference of one sample", single_motor, led(plant, one_sample(), printed_damping)},
      {"4th order, 120 Hz", dual_channel, led(plant, paper, printed_damping)},
      {fmt::format("4th order, 120 Hz, {:.0f} mN·m·s", too_much), {"#8a4fa8", 1.2}, led(plant, paper, too_much)}};
  return limits;
}

Section show(const Limits& limits) {
  Table table{"Largest virtual damping [mN·m·s] with smooth torque / with a stable loop",
              {"rig", "mode [Hz]", "inertia [g·m²]", "no filter", "4th order, 120 Hz", "best of all cutoffs, smooth"},
              {}};
  const auto text = [](const Limits::Bound& each) { return fmt::format("{:.1f} / {:.1f}", each.smooth, each.stable); };
  for (const auto* rows : {&limits.rows, &limits.modes})
    for (const Limits::Row& row : *rows)
      table.rows.push_back({row.faults.name, row.faults.mode > 0 ? fmt::format("{}", row.faults.mode) : "",
                            fmt::format("{}", row.faults.inertia), text(row.raw), text(row.filtered),
                            row.cutoffs.empty() ? "" : fmt::format("{:.1f}", best_smooth(row))});
  return {"limits", "Limits: virtual damping, and what ends it", words_of(limits), {limits_figure(limits)}, {table}};
}

}  // namespace dashpot::paper
