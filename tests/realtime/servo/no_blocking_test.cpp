#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <mutex>
#include <string>
#include <vector>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "guarded_device.hpp"
#include "scripted_device.hpp"
#include "scripted_model.hpp"
#include "trap.hpp"

namespace dashpot::tests {
namespace {

velocity_description with(estimator_kind kind) {
  velocity_description wanted;
  wanted.estimator = kind;
  wanted.window = 15;
  wanted.cutoff = 120;
  wanted.acceleration = 50;
  return wanted;
}

device_description lagging_description() {
  device_description device = scripted_description();
  device.brake.coil_lag = 0.002;
  device.brake.damping_per_current_squared = 4;
  device.brake.slew = 2000;
  device.loop.missed_deadlines_allowed = 1'000'000;  // a stalled machine must not end the run
  return device;
}

servo_options options_for(double duration) {
  servo_options options;
  options.duration = duration;
  options.outputs.log = nullptr;
  options.command.actuator = {true, true};
  options.command.energy = energy_policy::raise_brake;
  return options;
}

template <class Model, class Estimator, class Clock>
trap_counts trapped_in(Model& model, scripted_device& device, Estimator& estimator, Clock clock, double duration) {
  guarded_device guarded(device);
  servo_loop loop(model, guarded, estimator, options_for(duration), clock);
  take_trapped();
  loop.run();
  return take_trapped();
}

class NoBlocking : public testing::Test {
 protected:
  void SetUp() override {
    watched_ = watch_system_calls();
    if (!watched_) {
      std::cerr << "WARNING: without syscall user dispatch, or under a sanitizer, only heap and locks are trapped\n";
    }
  }
  void expect_nothing(const trap_counts& counts, const std::string& where) {
    EXPECT_EQ(counts.heap, 0) << where;
    EXPECT_EQ(counts.locks, 0) << where;
    EXPECT_EQ(counts.system_calls, 0) << where;
  }

  bool watched_ = false;
};

// Broken, an estimator, the model, the actuator or a safety check would allocate, lock or enter the kernel before the
// command has left.
TEST_F(NoBlocking, NothingBetweenReadAndWriteWithAnyEstimator) {
  for (const estimator_kind kind : all_estimators) {
    scripted_device device(lagging_description());
    scripted_model model;
    any_estimator<double> estimator(with(kind), 0.001, device.description().encoder.step);
    expect_nothing(trapped_in(model, device, estimator, simulated_clock{}, 0.5), name_of(kind));
  }
}

// Broken, the writer thread, the real clock or the histograms would reach into the time before the command has left.
TEST_F(NoBlocking, NothingBetweenReadAndWriteInRealTime) {
  scripted_device device(lagging_description());
  scripted_model model;
  any_estimator<double> estimator(with(estimator_kind::foaw), 0.001, device.description().encoder.step);
  expect_nothing(trapped_in(model, device, estimator, monotonic_clock{}, 0.3), "monotonic clock");
  EXPECT_GT(device.written().size(), 1u);
}

// Broken, a fault would be formatted, logged or thrown before the safe command has left.
TEST_F(NoBlocking, NothingBetweenReadAndWriteInAFault) {
  scripted_device device(lagging_description());
  device.on_read([](std::size_t read, device_sample& sample) {
    if (read == 20) sample.position = 1e9;
    return device_status::ok;
  });
  scripted_model model;
  any_estimator<double> estimator(with(estimator_kind::kalman), 0.001, device.description().encoder.step);
  expect_nothing(trapped_in(model, device, estimator, simulated_clock{}, 0.05), "fault");
}

// A model that does what it must not, once.
template <void (*Misdeed)()>
struct misbehaving_model : scripted_model {
  command<double> output(double position, double velocity) noexcept {
    if (outputs() == 10) Misdeed();
    return scripted_model::output(position, velocity);
  }
};

std::vector<int>* kept = nullptr;
std::mutex mutex;

void use_new() { kept = new std::vector<int>(100); }
void use_malloc() {
  void* volatile block = std::malloc(10);
  std::free(block);
}
void use_lock() { const std::lock_guard lock(mutex); }
void use_kernel() { getppid(); }

template <void (*Misdeed)()>
trap_counts trapped_with() {
  scripted_device device(lagging_description());
  misbehaving_model<Misdeed> model;
  scripted_estimator estimator;
  return trapped_in(model, device, estimator, simulated_clock{}, 0.05);
}

// Broken, the tests above would pass because nothing is ever trapped.
TEST_F(NoBlocking, TheTrapCatchesWhatItIsThereFor) {
  EXPECT_GT(trapped_with<use_new>().heap, 0);
  delete kept;
  EXPECT_GT(trapped_with<use_malloc>().heap, 0);
  EXPECT_GT(trapped_with<use_lock>().locks, 0);
  EXPECT_EQ(trapped_with<use_kernel>().system_calls, watched_ ? 1 : 0);
}

}  // namespace
}  // namespace dashpot::tests
