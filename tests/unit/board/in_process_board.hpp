// The firmware's application on a byte stream of this process. Its clock stands still until pass_period().
#pragma once

#include <atomic>
#include <thread>
#include <utility>

#include <dashpot/board/transport.hpp>
#include <dashpot/device.hpp>

#include "application.hpp"
#include "stand_in_model.hpp"
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

inline board_facts facts_of_board() {
  board_facts facts;
  facts.description = {test_plant::encoder_step, 50, 30, 100'000, 0, motion::translation, "in process"};
  facts.power_on_damping = 5;
  return facts;
}

// Where encoder and clock of a board stand when it is switched on: those of the plant itself begin at 0.
struct board_age {
  std::int32_t counts = 0;
  std::uint64_t time = 1'000'000'000;  // [ns]; boards do not start at zero when we connect
};

// Hardware for the application: a test plant, and a transport in place of the UART.
class simulated_hardware {
 public:
  explicit simulated_hardware(transport stream, const board_age& age = {})
      : stream_(std::move(stream)), first_counts_(static_cast<std::uint32_t>(age.counts)), time_(age.time) {}

  encoder_reading read_encoder() noexcept {
    const std::uint32_t counts = first_counts_ + static_cast<std::uint32_t>(plant_.counts());
    return {static_cast<std::int32_t>(counts), time_, edge_time_};
  }
  void drive(const outputs& wanted) noexcept { driven_ = wanted; }
  void set_period(std::uint32_t nanoseconds) noexcept { period_ = nanoseconds; }
  bool send(const encoded_frame& whole) noexcept { return stream_.write(whole.bytes, whole.size) == whole.size; }

  void pass_period() noexcept {
    const std::int32_t before = plant_.counts();
    time_ += period_;
    plant_.advance(driven_, static_cast<float>(period_) * 1e-9F);
    if (plant_.counts() != before) edge_time_ = time_;
  }

  transport& stream() noexcept { return stream_; }
  const outputs& driven() const noexcept { return driven_; }
  std::uint64_t time() const noexcept { return time_; }

 private:
  transport stream_;
  test_plant plant_;
  outputs driven_;
  std::uint32_t first_counts_;
  std::uint32_t period_ = 1'000'000;  // [ns]
  std::uint64_t time_;                // [ns]
  std::uint64_t edge_time_ = 0;       // [ns]
};

template <class Model = generated::stand_in_model>
class in_process_board {
 public:
  explicit in_process_board(transport stream, const board_facts& facts = facts_of_board(), const board_age& age = {})
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

  simulated_hardware& hardware() { return hardware_; }
  const supervisor& state() const { return application_.state(); }

 private:
  simulated_hardware hardware_;
  application<simulated_hardware, Model> application_;
};

}  // namespace dashpot::board
