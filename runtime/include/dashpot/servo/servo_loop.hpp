// The servo loop: every period of the device read → estimate → model → actuator → write, and only then the rest
// (model.update(), energy, telemetry, histograms). Concepts: model.hpp, device_check.hpp, estimator_check.hpp.
//
//     servo_loop loop(model, device, estimator, options);   // on CLOCK_MONOTONIC; simulated_clock{} for simulations
//     stop_on_signals guard(loop.control());                // Ctrl-C leaves the device safe
//     const servo_summary summary = loop.run();
//
// A model of two axes, a device of arm_device.hpp and an array of one estimator for each joint make a loop of two axes;
// its options are arm_servo_options, its summary an arm_servo_summary.
//
// A model made for another device, estimator, loop delay or rate is refused before the device is touched
// (admission.hpp). Every fault (fault.hpp) ends in the safe command within the period in which it is seen: motor 0,
// brake at the device's safe damping. It is counted, named in the log, and left only through control().reset() and then
// control().start(). A loop that hangs, and a process that crashes or is killed, can send nothing any more: against
// that a device needs a watchdog of its own. A board (devices/board/) has one; a simulated device needs none; of a
// device of your own you have to know.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include <dashpot/arm_model.hpp>
#include <dashpot/model.hpp>
#include <dashpot/servo/arm_path.hpp>
#include <dashpot/servo/command_path.hpp>
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
  static constexpr bool is_arm = has_two_axes<Model>;
  using path_type = std::conditional_t<is_arm, arm_path<Model, Estimator>, command_path<Model, Estimator>>;
  using options_type = std::conditional_t<is_arm, arm_servo_options, servo_options>;
  using writer_type = std::conditional_t<is_arm, arm_telemetry_writer, telemetry_writer>;
  using summary_type = std::conditional_t<is_arm, arm_servo_summary, servo_summary>;

  static constexpr bool check() {
    if constexpr (is_arm) return check_arm_model<Model>() && check_arm_device<Device>();
    else return check_model<Model>() && check_device<Device>();
  }
  static_assert(check() && check_estimator<std::remove_extent_t<Estimator>>());
  static_assert(std::extent_v<Estimator> == (is_arm ? arm_axes : 0),
                "a loop of two axes takes an array of two estimators, a loop of one takes one");

 public:
  // Refers to all three for as long as it lives.
  servo_loop(Model& model, Device& device, Estimator& estimator, options_type options = {}, Clock clock = {})
      : model_(model),
        device_(device),
        estimator_(estimator),
        facts_(facts()),
        options_(std::move(options)),
        clock_(std::move(clock)) {}

  // Requests to a loop that runs in another thread, or from a signal handler. A stop stays.
  servo_control& control() noexcept { return control_; }

  // Runs in the calling thread until the duration is over or a stop is asked for; leaves the device with the safe
  // command.
  summary_type run() {
    const auto loop = facts_of_loop();
    const admission verdict = admit(facts_, loop, options_.require_certified);
    writer_type writer(options_.telemetry_capacity, options_.outputs, units());
    writer.say(to_text(verdict, facts_, loop));
    summary_type summary = is_admitted(verdict) ? run_admitted(writer) : summary_type{};
    writer.stop();
    summary.verdict = verdict;
    summary.telemetry_dropped = writer.records().dropped();
    summary.events_dropped = writer.events().dropped();
    summary.telemetry_error = writer.write_error();
    return summary;
  }

 private:
  auto facts() const {
    if constexpr (is_arm) return arm_facts_of(model_);
    else return facts_of(model_);
  }

  auto facts_of_loop() const {
    if constexpr (is_arm)
      return arm_loop_facts{
          options_.identity, device_.description(), {estimator_name(estimator_[0]), estimator_name(estimator_[1])}};
    else return loop_facts{options_.identity, device_.description(), estimator_name(estimator_)};
  }

  auto units() const {
    if constexpr (is_arm) return arm_telemetry_units{device_.description().motion(), device_.description().brake_count};
    else return telemetry_units{facts_.port_motion, device_.description().motion};
  }

  path_type path() {
    if constexpr (is_arm) return {model_, estimator_, device_.description(), options_.command};
    else return {model_, estimator_, device_.description(), facts_.port_motion, options_.command};
  }

  const loop_description& timing() const {
    if constexpr (is_arm) return device_.description().loop();
    else return device_.description().loop;
  }

  summary_type run_admitted(writer_type& writer) {
    servo_cycle<path_type, Model, Device, Clock, writer_type> cycle(path(), timing(), model_, device_, clock_, control_,
                                                                    writer);
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
    const double sample_period = timing().sample_period;
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
  std::conditional_t<is_arm, arm_model_facts, model_facts> facts_;
  options_type options_;
  Clock clock_;
  servo_control control_;
};

}  // namespace dashpot
