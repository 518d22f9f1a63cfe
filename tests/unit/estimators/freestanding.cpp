// What a firmware does with the estimators: all of them in single precision, designed by the compiler and placed in
// initialised memory. Compiled without the standard library; the object must need no function from outside and no
// initialisation at start.
#include <dashpot/estimators/any_estimator.hpp>

namespace {

constexpr dashpot::velocity_description described{dashpot::estimator_kind::butterworth, 1, 4, 120};

dashpot::backward_difference<float> difference(15, 1e-3);
dashpot::least_squares<float> slope(15, 1e-3);
dashpot::low_pass<float> filtered(4, 120, 1e-4);
dashpot::inverse_time<float> inverse(30e-6, 1e-3);
dashpot::foaw<float> end_fit(16, dashpot::foaw_fit::end, 30e-6, 1e-3);
dashpot::foaw<float> best_fit(16, dashpot::foaw_fit::best, 30e-6, 1e-3);
dashpot::kalman<float> predicted(10, 30e-6, 1e-3);
dashpot::super_twisting<float> twisted(10, 1e-3);
dashpot::tracking_differentiator<float> tracked(10, 5, 1e-3);
dashpot::sensor<float> measured(200, 1e-3);
dashpot::interval_difference<float> timed(1e-3);
dashpot::any_estimator<float> chosen(described, 1e-4, 1e-4);

}  // namespace

extern "C" float estimate(float position, std::uint64_t edge_time_ns, std::uint64_t timestamp_ns) {
  float sum = difference.update(position) + slope.update(position) + filtered.update(position);
  sum += inverse.update(position, edge_time_ns, timestamp_ns) + timed.update(position, timestamp_ns);
  sum += end_fit.update(position) + best_fit.update(position);
  sum += predicted.update(position) + twisted.update(position) + tracked.update(position);
  return sum + measured.update(position);
}

extern "C" void come_to_rest(float position) {
  difference.reset(position);
  slope.reset(position);
  filtered.reset(position);
  inverse.reset(position);
  end_fit.reset(position);
  best_fit.reset(position);
  predicted.reset(position);
  twisted.reset(position);
  tracked.reset(position);
  timed.reset(position);
  chosen.reset(position);
}

extern "C" float estimate_chosen(const dashpot::device_sample& sample) { return chosen.update(sample); }
