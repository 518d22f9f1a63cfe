// The servo loop: every period of the device read → estimate → model → actuator → write, and only then the rest
// (model.update(), energy, telemetry, histograms). Concepts: model.hpp, device_check.hpp, estimator_check.hpp.
//
//     servo_loop loop(model, device, estimator, options);   // on CLOCK_MONOTONIC; simulated_clock{} for simulations
//     stop_on_signals guard(loop.control());                // Ctrl-C leaves the device safe
//     const servo_summary summary = loop.run();
//
// A model made for another device, estimator, loop delay or rate is refused before the device is touched
// (admission.hpp). Every fault (fault.hpp) ends in the safe command within the period in which it is seen: motor 0,
// brake at the device's safe damping. It is counted, named in the log, and left only through control().reset() and then
// control().start(). A loop that hangs, and a process that crashes or is killed, can send nothing any more: against
// that a device needs a watchdog of its own. A board (devices/board/) has one; a simulated device needs none; of a
// device of your own you have to know.
#pragma once

#include <cstdint>
#include <utility>

#include <dashpot/model.hpp>
#include <dashpot/servo/device_check.hpp>
#include <dashpot/servo/estimator_check.hpp>
#include <dashpot/servo/monotonic_clock.hpp>
#include <dashpot/servo/servo_control.hpp>
#include <dashpot/servo/servo_cycle.hpp>
#include <dashpot/servo/servo_options.hpp>
#include <dashpot/servo/servo_summary.hpp>
#include <dashpot/servo/simulated_clock.hpp>
#include <dashpot/servo/stop_on_signals.hpp>

namespace dashpot {

template <class Model, class Device, class Estimator, class Clock = monotonic_clock>
class servo_loop {
  static_assert(check_model<Model>() && check_device<Device>() && check_estimator<Estimator>());

 public:
  // Refers to all three for as long as it lives.
  servo_loop(Model& model, Device& device, Estimator& estimator, servo_options options = {}, Clock clock = {})
      : model_(model),
        device_(device),
        estimator_(estimator),
        facts_(facts_of(model)),
        options_(std::move(options)),
        clock_(std::move(clock)) {}

  // Requests to a loop that runs in another thread, or from a signal handler. A stop stays.
  servo_control& control() noexcept { return control_; }

  // Runs in the calling thread until the duration is over or a stop is asked for; leaves the device with the safe
  // command.
  servo_summary run() {
    const loop_facts loop{options_.identity, device_.description(), estimator_name(estimator_)};
    const admission verdict = admit(facts_, loop, options_.require_certified);
    telemetry_writer writer(options_.telemetry_capacity, options_.outputs, {facts_.port_motion, loop.device.motion});
    writer.say(to_text(verdict, facts_, loop));
    servo_summary summary = is_admitted(verdict) ? run_admitted(writer) : servo_summary{};
    writer.stop();
    summary.verdict = verdict;
    summary.telemetry_dropped = writer.records().dropped();
    summary.events_dropped = writer.events().dropped();
    summary.telemetry_error = writer.write_error();
    return summary;
  }

 private:
  servo_summary run_admitted(telemetry_writer& writer) {
    servo_cycle cycle(model_, device_, estimator_, options_.command, clock_, control_, writer);
    if constexpr (Clock::is_real) {
      writer.start();
      const realtime_session session(options_.realtime);
      writer.say(to_text(session.report(), options_.realtime));
      pace(cycle);
    } else {
      pace(cycle);
    }
    return cycle.summary();
  }

  template <class Cycle>
  void pace(Cycle& cycle) {
    const double sample_period = device_.description().loop.sample_period;
    const std::uint64_t periods = periods_in(options_.duration, sample_period);
    if (options_.start_running) control_.start();
    clock_.start(sample_period);
    cycle.obey(0);
    if constexpr (Clock::is_real) control_.take_device();
    for (wake_up woken = clock_.wait(); woken.period < periods && !control_.stop_requested(); woken = clock_.wait()) {
      cycle.serve(woken);
    }
    cycle.leave_device_safe(options_.farewell);
    if constexpr (Clock::is_real) control_.leave_device();
  }

  // The nearest whole number; without end for a duration of 0, or one that is beyond counting.
  static std::uint64_t periods_in(double duration, double sample_period) noexcept {
    const double periods = duration / sample_period + 0.5;
    return duration > 0 && periods < 9e18 ? static_cast<std::uint64_t>(periods) : ~std::uint64_t{0};
  }

  Model& model_;
  Device& device_;
  Estimator& estimator_;
  model_facts facts_;
  servo_options options_;
  Clock clock_;
  servo_control control_;
};

}  // namespace dashpot
