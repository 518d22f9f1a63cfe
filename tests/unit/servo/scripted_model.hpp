// The law of Fig. 5 and a plain estimator, both able to misbehave where a test tells them to.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include <dashpot/estimators/backward_difference.hpp>

#include "second_order_maxwell.hpp"

namespace dashpot::tests {

class scripted_model : public generated::second_order_maxwell {
 public:
  using disturbance = std::function<void(std::size_t, command<double>&)>;
  void on_output(disturbance disturb) { disturb_ = std::move(disturb); }

  command<double> output(double position, double velocity) noexcept {
    command<double> wanted = second_order_maxwell::output(position, velocity);
    if (disturb_) disturb_(outputs_, wanted);
    ++outputs_;
    return wanted;
  }
  void update() noexcept {
    ++updates_;
    second_order_maxwell::update();
  }
  void reset(double position = 0) noexcept {
    ++resets_;
    second_order_maxwell::reset(position);
  }

  // What is left of all forces with each output; nothing is shed where this is not told.
  void on_share(std::function<double(std::size_t)> share) { share_ = std::move(share); }
  double kept_share() const noexcept { return share_ && outputs_ > 0 ? share_(outputs_ - 1) : 1; }

  std::size_t outputs() const noexcept { return outputs_; }
  std::size_t updates() const noexcept { return updates_; }
  std::size_t resets() const noexcept { return resets_; }

 private:
  disturbance disturb_;
  std::function<double(std::size_t)> share_;
  std::size_t outputs_ = 0;
  std::size_t updates_ = 0;
  std::size_t resets_ = 0;
};

class scripted_estimator {
 public:
  using disturbance = std::function<double(std::size_t, double)>;
  void on_update(disturbance disturb) { disturb_ = std::move(disturb); }

  double update(double position) noexcept {
    const double velocity = difference_.update(position);
    const std::size_t update = updates_++;
    return disturb_ ? disturb_(update, velocity) : velocity;
  }
  void reset(double position) noexcept { difference_.reset(position); }
  const char* name() const noexcept { return "backward_difference"; }

 private:
  backward_difference<double> difference_{10, 0.001};
  disturbance disturb_;
  std::size_t updates_ = 0;
};

}  // namespace dashpot::tests
