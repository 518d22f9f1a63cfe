#include "fig7.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "chosen.hpp"
#include "claims.hpp"
#include "compared_estimators.hpp"
#include "zero_phase.hpp"

namespace dashpot::paper {
namespace {

using std::numbers::pi;
constexpr std::size_t average = 100;      // centred samples, as printed
constexpr double printed_quantum = 0.95;  // as printed [rad/s]
constexpr double printed_delay = 5e-3;    // “approximately”, as printed [s]

std::size_t settled() {
  return static_cast<std::size_t>(std::lround(chosen("fig7.settled") / rig().description.loop.sample_period));
}

// Only the velocity is wanted: no brake, no motor.
struct NoLaw {
  void reset(double) noexcept {}
  command<double> output(double, double) noexcept { return {0, 0}; }
  void update() noexcept {}
};

Experiment slow_motion() {
  Experiment experiment{rig().description, {}, chosen("fig7.duration"), {}};
  experiment.plant.loop.jitter = 0;  // the figure is about the encoder
  const double arm = experiment.plant.arm_radius, frequency = chosen("fig7.frequency");
  experiment.motion.prescribed = true;
  experiment.motion.intended = simulated::sine(arm * chosen("fig7.speed") / (2 * pi * frequency), frequency, -pi / 2);
  return experiment;
}

// rms of v̂_k − v(t_k − delay), the truth between samples on straight lines.
double error_at(const std::vector<double>& estimate, const std::vector<double>& truth, double delay) {
  const auto back = static_cast<std::size_t>(std::floor(delay));
  const double part = delay - static_cast<double>(back);
  const std::size_t first = settled();
  double sum = 0;
  for (std::size_t k = first; k < truth.size(); ++k) {
    const double then = truth[k - back] + part * (truth[k - back - 1] - truth[k - back]);
    sum += (estimate[k] - then) * (estimate[k] - then);
  }
  return std::sqrt(sum / static_cast<double>(truth.size() - first));
}

// The delay [samples], to a hundredth of one, at which the truth is nearest.
double best_delay(const std::vector<double>& estimate, const std::vector<double>& truth) {
  double best = 0;
  for (double step = 10; step >= 0.01; step /= 10) {
    const double from = std::max(0.0, best - 10 * step), to = best + 20 * step;
    for (double delay = from; delay < std::min(to, 500.0); delay += step)
      if (error_at(estimate, truth, delay) < error_at(estimate, truth, best)) best = delay;
  }
  return best;
}

Fig7::Estimate estimate_of(const NamedEstimator& which, const Experiment& experiment, Fig7& fig7) {
  const double arm = experiment.plant.arm_radius, period = experiment.plant.loop.sample_period;
  const Trace trace = run(experiment, {which.name, law_of<NoLaw>(), which.velocity, 0});
  Fig7::Estimate estimate{which.name, {}, 0, 0, 0, 0};
  fig7.time.clear(), fig7.position.clear(), fig7.velocity.clear();
  for (const Sample& sample : trace) {
    fig7.time.push_back(sample.time);
    fig7.position.push_back(sample.measured / arm);
    fig7.velocity.push_back(sample.velocity / arm);
    estimate.velocity.push_back(sample.estimate / arm);
  }
  const double delay = best_delay(estimate.velocity, fig7.velocity);
  estimate.delay = delay * period;
  estimate.rms_error = error_at(estimate.velocity, fig7.velocity, 0);
  estimate.noise = error_at(estimate.velocity, fig7.velocity, delay);
  for (std::size_t k = settled(); k < fig7.velocity.size(); ++k)
    estimate.worst = std::max(estimate.worst, std::abs(estimate.velocity[k] - fig7.velocity[k]));
  return estimate;
}

// Instants of the sign changes, between samples on a straight line [s].
std::vector<double> crossings(const std::vector<double>& time, const std::vector<double>& values) {
  std::vector<double> instants;
  for (std::size_t k = settled(); k < values.size(); ++k)
    if ((values[k - 1] < 0) != (values[k] < 0))
      instants.push_back(time[k - 1] + (time[k] - time[k - 1]) * values[k - 1] / (values[k - 1] - values[k]));
  return instants;
}

// How much later the filtered velocity crosses zero. Where noise makes it cross more than once, the mean of these.
double crossing_delay(const Fig7& fig7) {
  const std::vector<double> truth = crossings(fig7.time, fig7.velocity);
  const std::vector<double> late = crossings(fig7.time, fig7.estimates[1].velocity);
  double sum = 0, count = 0;
  for (const double instant : truth)
    for (const double other : late)
      if (std::abs(other - instant) < 0.05) sum += other - instant, ++count;
  return sum / count;
}

double smallest_step(const std::vector<double>& values) {
  double least = 1e9;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double step = std::abs(values[k] - values[k - 1]);
    if (step > 1e-9) least = std::min(least, step);
  }
  return least;
}

Curve curve(const char* name, const Style& style, const Fig7& fig7, const std::vector<double>& values, Maker maker,
            double scale = 1) {
  Curve result{name, style, fig7.time, values, maker};
  for (double& y : result.y) y *= scale;
  return result;
}

// From sample to sample on the level of the one before.
Curve held(const Curve& sampled) {
  Curve steps{sampled.name, sampled.style, {}, {}, sampled.maker};
  for (std::size_t k = 0; k < sampled.x.size(); ++k) {
    if (k > 0) steps.x.push_back(sampled.x[k]), steps.y.push_back(sampled.y[k - 1]);
    steps.x.push_back(sampled.x[k]), steps.y.push_back(sampled.y[k]);
  }
  return steps;
}

Figure figure_of(const Fig7& fig7) {
  const Curve truth = curve("true", ideal, fig7, fig7.velocity, Maker::device);
  const Curve raw =
      held(curve("difference of one sample", {"#4d4d4d", 1}, fig7, fig7.estimates[0].velocity, Maker::runtime));
  const Curve centred = curve("100 samples, centred", plain, fig7, fig7.averaged, Maker::offline);
  const Curve filtered =
      curve("Butterworth, 4th order, 120 Hz", single_motor, fig7, fig7.estimates[1].velocity, Maker::runtime);
  const Interval strip{chosen("fig7.instant"), chosen("fig7.instant") + chosen("fig7.shown")}, around{0.94, 1.06};
  const Curve counted = curve("counted position", dual_channel, fig7, fig7.position, Maker::device, 1e3);
  return {"Fig. 7: velocity from an encoder of 65,536 counts, at 10 kHz",
          {fmt::format("One quantum is {:.3f} rad/s. The filter’s velocity crosses zero {:.2f} ms late.", fig7.quantum,
                       fig7.crossing_delay * 1e3)},
          {{fmt::format("a. Raw, over {:g} ms", chosen("fig7.shown") * 1e3),
            "time [s]",
            "velocity [rad/s]",
            {truth, raw},
            strip,
            Interval{-0.5, 1.5}},
           {"Position as counted", "time [s]", "angle [mrad]", {counted}},
           {"b. Filtered", "time [s]", "velocity [rad/s]", {truth, centred, filtered}},
           {"b. Around a reversal",
            "time [s]",
            "velocity [rad/s]",
            {truth, centred, filtered},
            around,
            Interval{-0.4, 0.4}}}};
}

// Switches of the one-sample difference in what 7a shows.
int switches(const Fig7& fig7) {
  const double from = chosen("fig7.instant"), to = from + chosen("fig7.shown");
  const std::vector<double>& raw = fig7.estimates[0].velocity;
  int count = 0;
  for (std::size_t k = 1; k < raw.size(); ++k)
    count += fig7.time[k] >= from && fig7.time[k] < to && raw[k] != raw[k - 1];
  return count;
}

std::vector<std::string> words_of(const Fig7& fig7) {
  constexpr double milli = 1e3;
  const double delay = fig7.estimates[1].delay, crossing = fig7.crossing_delay;
  const bool is_printed_delay = std::abs(crossing - printed_delay) < 0.1 * printed_delay;
  const std::string late = fmt::format(
      "The paper says that its filter, 4th order at 120 Hz, crosses zero about 5 ms late. That {}: its delay is {:.2f} "
      "ms here, where 2.613/(2π·120 Hz) = 3.47 ms and half a sample of the difference before it are due, and zero it "
      "crosses {:.2f} ms late, {} than its delay.",
      outcome(is_printed_delay), delay * milli, crossing * milli, more_or_less(crossing, delay));
  const std::string why =
      is_printed_delay ? ""
                       : " 5 ms would be a cutoff of 83 Hz, or the 6th order at 120 Hz (5.1 ms), or one and a half "
                         "milliseconds of the loop beside the filter.";
  return {
      fmt::format("The quantum of the one-sample difference is {:.3f} rad/s, and in the {:g} ms of 7a it switches {} "
                  "times; the paper prints {}, which {}: it fixes the rate, 10 kHz.",
                  fig7.quantum, chosen("fig7.shown") * milli, switches(fig7), printed_quantum,
                  outcome(std::abs(fig7.quantum - printed_quantum) < 0.01)),
      late + why +
          " The printed text also calls the filter FIR, which a Butterworth is not. Everything here uses 120 Hz and "
          "the 4th order, and Fig. 6 the 5 ms.",
      fmt::format("Smooth “only at the cost of delay” {}: of the two filters the 4th order leaves {:.4f} rad/s of "
                  "noise at {:.2f} ms, the 2nd {:.4f} at {:.2f} ms.",
                  outcome(fig7.estimates[1].noise < fig7.estimates[2].noise && delay > fig7.estimates[2].delay),
                  fig7.estimates[1].noise, delay * milli, fig7.estimates[2].noise, fig7.estimates[2].delay * milli)};
}

}  // namespace

Fig7 measure_fig7() {
  Fig7 fig7;
  const Experiment experiment = slow_motion();
  for (const NamedEstimator& which : compared_estimators())
    fig7.estimates.push_back(estimate_of(which, experiment, fig7));
  fig7.quantum = smallest_step(fig7.estimates[0].velocity);
  fig7.averaged = centred_average(fig7.estimates[0].velocity, average);
  fig7.crossing_delay = crossing_delay(fig7);
  return fig7;
}

Section show(const Fig7& fig7) {
  Table table{"All estimators on the same positions, peak velocity 1 rad/s",
              {"estimator", "rms error [rad/s]", "largest [rad/s]", "delay [ms]", "rms without the delay [rad/s]"},
              {}};
  for (const Fig7::Estimate& e : fig7.estimates)
    table.rows.push_back({e.name, fmt::format("{:.4f}", e.rms_error), fmt::format("{:.3f}", e.worst),
                          fmt::format("{:.2f}", e.delay * 1e3), fmt::format("{:.4f}", e.noise)});
  return {"fig7", "Fig. 7: noise and delay of the velocity", words_of(fig7), {figure_of(fig7)}, {table}};
}

}  // namespace dashpot::paper
