#include "fig7.hpp"

#include <fmt/format.h>

#include <cmath>

#include "chosen.hpp"
#include "compared_estimators.hpp"
#include "zero_phase.hpp"

namespace dashpot::paper {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double duration = 2;         // [s]
constexpr std::size_t settled = 1000;  // samples; every estimator here remembers less

// Only the velocity is wanted: no brake, no motor.
class NoLaw final : public Law {
 public:
  void reset(double) override {}
  command<double> output(double, double) override { return {0, 0}; }
  void update() override {}
};

Experiment slow_motion() {
  Experiment experiment{rig().description, {}, duration, {}};
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
  double sum = 0;
  for (std::size_t k = settled; k < truth.size(); ++k) {
    const double then = truth[k - back] + part * (truth[k - back - 1] - truth[k - back]);
    sum += (estimate[k] - then) * (estimate[k] - then);
  }
  return std::sqrt(sum / static_cast<double>(truth.size() - settled));
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
  const Trace trace = run(experiment, {which.name, [] { return std::make_unique<NoLaw>(); }, which.velocity, 0});
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
  for (std::size_t k = settled; k < fig7.velocity.size(); ++k)
    estimate.worst = std::max(estimate.worst, std::abs(estimate.velocity[k] - fig7.velocity[k]));
  return estimate;
}

// Instants of the sign changes, between samples on a straight line [s].
std::vector<double> crossings(const std::vector<double>& time, const std::vector<double>& values) {
  std::vector<double> instants;
  for (std::size_t k = settled; k < values.size(); ++k)
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

Curve curve(const char* name, const Style& style, const Fig7& fig7, const std::vector<double>& values,
            double scale = 1) {
  Curve result{name, style, fig7.time, values};
  for (double& y : result.y) y *= scale;
  return result;
}

Figure figure_of(const Fig7& fig7) {
  const Curve truth = curve("true", ideal, fig7, fig7.velocity);
  const Curve raw = curve("difference of one sample", {"#7f7f7f", 0.7}, fig7, fig7.estimates[0].velocity);
  const Curve average = curve("100 samples, centred: not causal", plain, fig7, fig7.averaged);
  const Curve filtered = curve("Butterworth, 4th order, 120 Hz", single_motor, fig7, fig7.estimates[1].velocity);
  const Interval strip{0.02, 0.14}, around{0.94, 1.06};
  return {
      "Fig. 7: velocity from an encoder of 65,536 counts, at 10 kHz",
      {fmt::format("One quantum is {:.3f} rad/s. The filter’s velocity crosses zero {:.2f} ms late.", fig7.quantum,
                   fig7.crossing_delay * 1e3)},
      {{"a. Raw", "time [s]", "velocity [rad/s]", {truth, raw}, strip, Interval{-1, 2.2}},
       {"Position as counted", "time [s]", "angle [mrad]", {curve("counted", dual_channel, fig7, fig7.position, 1e3)}},
       {"b. Filtered", "time [s]", "velocity [rad/s]", {truth, average, filtered}},
       {"b. Around a reversal",
        "time [s]",
        "velocity [rad/s]",
        {truth, average, filtered},
        around,
        Interval{-0.4, 0.4}}}};
}

}  // namespace

Fig7 measure_fig7() {
  Fig7 fig7;
  const Experiment experiment = slow_motion();
  for (const NamedEstimator& which : compared_estimators())
    fig7.estimates.push_back(estimate_of(which, experiment, fig7));
  fig7.quantum = smallest_step(fig7.estimates[0].velocity);
  fig7.averaged = centred_average(fig7.estimates[0].velocity, 100);
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
  return {"fig7",
          "Fig. 7: noise and delay of the velocity",
          {fmt::format(
               "The quantum of the one-sample difference is {:.3f} rad/s; the paper prints 0.95, which fixes its rate: "
               "10 kHz.",
               fig7.quantum),
           fmt::format(
               "The paper says that its filter, 4th order at 120 Hz, crosses zero about 5 ms late. Its delay is {:.2f} "
               "ms here: 2.613/(2π·120 Hz) = 3.47 ms, and half a sample of the difference before it. Zero itself it "
               "crosses {:.2f} ms late, because the encoder has nothing to say while the arm turns. 5 ms would be a "
               "cutoff of 83 Hz, or the 6th order at 120 Hz (5.1 ms), or one and "
               "a half milliseconds of the loop beside the filter. The printed text also calls the filter FIR, which "
               "a Butterworth is not. Everything here uses 120 Hz and the 4th order, and Fig. 6 the 5 ms.",
               fig7.estimates[1].delay * 1e3, fig7.crossing_delay * 1e3)},
          {figure_of(fig7)},
          {table}};
}

}  // namespace dashpot::paper
