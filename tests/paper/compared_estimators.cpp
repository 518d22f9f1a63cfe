#include "compared_estimators.hpp"

#include <cmath>

#include "chosen.hpp"

namespace dashpot::paper {
namespace {

unsigned whole(const char* name) { return static_cast<unsigned>(std::lround(chosen(name))); }

NamedEstimator named(const char* name, estimator_kind kind) {
  NamedEstimator it{name, {}};
  it.velocity.estimator = kind;
  it.velocity.window = 1;
  it.velocity.acceleration =
      chosen(kind == estimator_kind::kalman ? "fig7.kalman_acceleration" : "fig7.acceleration_bound");
  it.velocity.filter_factor = chosen("fig7.filter_factor");
  return it;
}

}  // namespace

std::vector<NamedEstimator> compared_estimators() {
  const velocity_description paper = rig().description.velocity;
  std::vector<NamedEstimator> all = {named("difference of one sample", estimator_kind::backward_difference),
                                     {"Butterworth, 4th order, 120 Hz: the paper's", paper}};
  NamedEstimator second{"Butterworth, 2nd order, 120 Hz", paper};
  second.velocity.order = 2;
  NamedEstimator window = named("difference over 15 samples", estimator_kind::backward_difference);
  NamedEstimator slope = named("least squares over 15 samples", estimator_kind::least_squares);
  window.velocity.window = slope.velocity.window = whole("fig7.window");
  NamedEstimator end = named("FOAW, end fit, up to 64 samples", estimator_kind::foaw);
  end.velocity.window = whole("fig7.foaw_window");
  NamedEstimator best = end;
  best.name = "FOAW, best fit, up to 64 samples";
  best.velocity.best_fit = true;
  for (const NamedEstimator& each :
       {second, window, slope, end, best, named("inverse time", estimator_kind::inverse_time),
        named("Kalman, 200 rad/s²", estimator_kind::kalman),
        named("super-twisting, 200 rad/s²", estimator_kind::super_twisting),
        named("tracking differentiator, 200 rad/s², 20 samples", estimator_kind::tracking_differentiator)})
    all.push_back(each);
  return all;
}

}  // namespace dashpot::paper
