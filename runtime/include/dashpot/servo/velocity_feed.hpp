// Feeds an estimator on its uniform grid. Where periods passed without a sample, their samples are put on the straight
// line between the two around them: an estimator would otherwise take a gap of n periods for n times the velocity. Of a
// gap beyond most_filled only the end is filled in, after a reset: no number of lost samples may hold up the command.
#pragma once

#include <dashpot/device.hpp>
#include <dashpot/servo/estimator_check.hpp>

namespace dashpot {

template <class Estimator>
class velocity_feed {
  static constexpr bool takes_samples = is_detected<estimator_claim::update_by_sample, Estimator>;
  using scalar = estimate_of<Estimator>;

 public:
  explicit velocity_feed(Estimator& estimator) noexcept : estimator_(estimator) {}

  void reset(const device_sample& sample) noexcept {
    estimator_.reset(static_cast<scalar>(sample.position));
    last_ = sample;
  }

  static constexpr unsigned most_filled = 256;  // [periods], as long as the longest window of an estimator

  // The estimate [rad/s] or [m/s] at `sample`, which lies `periods` ≥ 1 after the one before. At most most_filled
  // calls.
  double update(const device_sample& sample, unsigned periods) noexcept {
    const unsigned first = periods > most_filled ? periods - most_filled + 1 : 1;
    if (first > 1) estimator_.reset(static_cast<scalar>(between(sample, first - 1, periods).position));
    for (unsigned period = first; period < periods; ++period) estimate(between(sample, period, periods));
    last_ = sample;
    return estimate(sample);
  }

 private:
  double estimate(const device_sample& sample) noexcept {
    if constexpr (takes_samples) {
      return static_cast<double>(estimator_.update(sample));
    } else {
      return static_cast<double>(estimator_.update(static_cast<scalar>(sample.position)));
    }
  }

  // Times and edges are not invented: for an estimator that reads them nothing happens until the next sample.
  device_sample between(const device_sample& sample, unsigned period, unsigned periods) const noexcept {
    const double part = static_cast<double>(period) / static_cast<double>(periods);
    device_sample filled = last_;
    filled.position += part * (sample.position - last_.position);
    filled.velocity += part * (sample.velocity - last_.velocity);
    return filled;
  }

  Estimator& estimator_;
  device_sample last_;
};

}  // namespace dashpot
