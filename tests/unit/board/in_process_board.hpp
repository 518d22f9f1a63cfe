// The firmware's application on a byte stream of this process. Its clock stands still until pass_period().
#pragma once

#include <atomic>
#include <thread>
#include <utility>

#include <dashpot/board/transport.hpp>
#include <dashpot/device.hpp>

#include "application.hpp"
#include "stand_in_model.hpp"
#include "test_arm.hpp"
#include "test_plant.hpp"

namespace dashpot::board {

// A device file that the test plant fits.
inline device_description described_board() {
  device_description described;
  described.motion = motion::translation;
  described.loop.sample_period = 0.001;
  described.loop.missed_deadlines_allowed = 3;
  described.encoder.step = test_plant::encoder_step;
  described.motor.max_torque = 50;
  described.brake.kind = brake_kind::eddy_current;
  described.brake.max_damping = 30;
  described.brake.safe_damping = 4;
  return described;
}

// And one that the test arm fits.
inline arm_description described_arm_board() {
  arm_description described;
  described.geometry = {arm_kind::five_bar, 0.063, 0.075, 0.025, {-0.04, 0.07}, {0.04, 0.12}};
  for (device_description& joint : described.joints) {
    joint.motion = motion::rotation;
    joint.loop.sample_period = 0.001;
    joint.loop.missed_deadlines_allowed = 3;
    joint.encoder.step = test_arm::encoder_step;
    joint.motor.max_torque = 0.5;
  }
  described.brake_count = 2;
  for (unsigned i = 0; i < described.brake_count; ++i) {
    described.brakes[i].along[i] = 1;
    described.brakes[i].brake.kind = brake_kind::eddy_current;
    described.brakes[i].brake.max_damping = 0.05;
    described.brakes[i].brake.safe_damping = 0.004 + 0.001 * i;
  }
  return described;
}

inline board_facts facts_of_board() {
  board_facts facts;
  facts.description = {test_plant::encoder_step, 50, 30, 100'000, 0, motion::translation, "in process"};
  facts.power_on_damping = 5;
  return facts;
}

inline arm_board_facts facts_of_arm_board() {
  constexpr double step = test_arm::encoder_step;
  arm_board_facts facts;
  facts.description = {{step, step}, {0.5F, 0.5F}, {0.05F, 0.05F}, 100'000, 0, motion::rotation, "arm in process"};
  facts.power_on_damping[0] = facts.power_on_damping[1] = 0.005F;
  return facts;
}

template <class Plant>
auto facts_of_board_with() {
  if constexpr (Plant::axes == 1) return facts_of_board();
  else return facts_of_arm_board();
}

template <class Plant>
auto described_board_with() {
  if constexpr (Plant::axes == 1) return described_board();
  else return described_arm_board();
}

// Where encoders and clock of a board stand when it is switched on: those of the plant itself begin at 0.
struct board_age {
  std::int32_t counts = 0;
  std::uint64_t time = 1'000'000'000;  // [ns]; boards do not start at zero when we connect
};

// Hardware for the application: a test plant, and a transport in place of the UART.
template <class Plant>
class simulated_hardware {
  static constexpr unsigned axes = Plant::axes;

 public:
  explicit simulated_hardware(transport stream, const board_age& age = {})
      : stream_(std::move(stream)), first_counts_(static_cast<std::uint32_t>(age.counts)), time_(age.time) {}

  basic_encoder_reading<axes> read_encoder() noexcept {
    basic_encoder_reading<axes> reading;
    for (unsigned j = 0; j < axes; ++j) {
      const std::uint32_t counts = first_counts_ + static_cast<std::uint32_t>(plant_.counts(j));
      nth(reading.counts, j) = static_cast<std::int32_t>(counts);
      nth(reading.edge_time, j) = edge_time_[j];
    }
    reading.timestamp = time_;
    return reading;
  }
  void drive(const basic_outputs<axes>& wanted) noexcept { driven_ = wanted; }
  void set_period(std::uint32_t nanoseconds) noexcept { period_ = nanoseconds; }
  bool send(const encoded_frame& whole) noexcept { return stream_.write(whole.bytes, whole.size) == whole.size; }

  void pass_period() noexcept {
    const Plant before = plant_;
    time_ += period_;
    plant_.advance(driven_, static_cast<float>(period_) * 1e-9F);
    for (unsigned j = 0; j < axes; ++j)
      if (plant_.counts(j) != before.counts(j)) edge_time_[j] = time_;
  }

  transport& stream() noexcept { return stream_; }
  const basic_outputs<axes>& driven() const noexcept { return driven_; }
  std::uint64_t time() const noexcept { return time_; }

 private:
  transport stream_;
  Plant plant_;
  basic_outputs<axes> driven_;
  std::uint32_t first_counts_;
  std::uint32_t period_ = 1'000'000;    // [ns]
  std::uint64_t time_;                  // [ns]
  std::uint64_t edge_time_[axes] = {};  // [ns]
};

template <class Model = generated::stand_in_model, class Plant = test_plant>
class in_process_board {
 public:
  explicit in_process_board(transport stream,
                            const basic_board_facts<Plant::axes>& facts = facts_of_board_with<Plant>(),
                            const board_age& age = {})
      : hardware_(std::move(stream), age), application_(hardware_, facts) {}

  // Answers what has come.
  void serve() {
    std::uint8_t bytes[256];
    while (const std::size_t count = hardware_.stream().read(bytes, sizeof bytes)) application_.receive(bytes, count);
  }

  void pass_period(unsigned periods = 1) {
    hardware_.pass_period();
    application_.pass_period(periods);
  }

  // Serves on another thread as long as `body` runs: for calls that wait for an answer. `also` runs between servings.
  template <class Body, class Also>
  auto while_serving(Body&& body, Also&& also) {
    std::atomic<bool> done = false;
    std::thread server([&] {
      while (!done) {
        also();
        serve();
        also();
        std::this_thread::yield();
      }
    });
    const auto result = body();
    done = true;
    server.join();
    return result;
  }
  template <class Body>
  auto while_serving(Body&& body) {
    return while_serving(std::forward<Body>(body), [] {});
  }

  simulated_hardware<Plant>& hardware() { return hardware_; }
  const basic_supervisor<Plant::axes>& state() const { return application_.state(); }

 private:
  simulated_hardware<Plant> hardware_;
  application<simulated_hardware<Plant>, Model> application_;
};

}  // namespace dashpot::board
