// The project's servo loop on the firmware under QEMU, over a wire that loses, repeats, damages and delays frames.
#include <atomic>
#include <chrono>
#include <functional>
#include <iostream>
#include <thread>

#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "faulty_wire.hpp"
#include "in_process_board.hpp"
#include "qemu_board.hpp"
#include "stream_pair.hpp"

#include DASHPOT_BOARD_MODEL_HEADER

namespace dashpot {
namespace {

using namespace board;
using model = DASHPOT_BOARD_MODEL_CLASS;

// An emulator on a busy machine pauses: what would be a fault on hardware is none here, except where a test cuts the
// wire.
device_description patient_description(unsigned periods_without_data) {
  device_description described = described_board();
  described.loop.missed_deadlines_allowed = periods_without_data;
  return described;
}

board_options patient(std::uint16_t watchdog_periods) {
  board_options options;
  options.watchdog_periods = watchdog_periods;
  options.late_limit = 1e3;
  options.start_time = 30'000;
  return options;
}

servo_options quiet() {
  servo_options options;
  options.realtime = {0, false, false};
  options.outputs.log = nullptr;
  options.farewell = 30;
  return options;
}

void pause(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

// Loop, wire and emulated board, each with a clock of its own.
class servo_session {
 public:
  servo_session(unsigned periods_without_data, std::uint16_t watchdog_periods, const servo_options& options = quiet())
      : ends_(connected_pair()),
        wire(std::move(ends_.far), emulated_.connect(), 7),
        device(std::move(ends_.near), patient_description(periods_without_data), patient(watchdog_periods)),
        estimator_(device.description().velocity, 0.001, test_plant::encoder_step),
        loop(model_, device, estimator_, options),
        carrier_([this] { carry(); }) {}
  ~servo_session() {
    done_ = true;
    carrier_.join();
  }

  // What the wire is to do comes in through here: it belongs to the carrying thread.
  void tell_wire(std::function<void(faulty_wire&)> order) {
    order_ = std::move(order);
    ordered_ = true;
    while (ordered_) std::this_thread::yield();
  }

 private:
  void carry() {
    while (!done_) {
      if (ordered_) {
        order_(wire);
        ordered_ = false;
      }
      wire.carry();
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }

  qemu_board emulated_;
  stream_pair ends_;
  std::function<void(faulty_wire&)> order_;
  std::atomic<bool> ordered_ = false;
  std::atomic<bool> done_ = false;
  model model_;

 public:
  faulty_wire wire;
  board_device device;

 private:
  any_estimator<double> estimator_;

 public:
  servo_loop<model, board_device, any_estimator<double>> loop;

 private:
  std::thread carrier_;
};

// On a bad wire the loop must go on with the samples that are sound: one that it should not have used would end in a
// fault, and so would a session that a damaged frame could derail.
TEST(Firmware, ServesTheServoLoopOverABadWire) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  servo_session with(5000, 5000);
  std::string error;
  ASSERT_TRUE(with.device.start(error)) << error;
  with.tell_wire([](faulty_wire& wire) { wire.set_rate(0.1); });
  std::thread stopper([&] {
    pause(2000);
    with.loop.control().stop();
  });
  const servo_summary summary = with.loop.run();
  stopper.join();
  with.tell_wire([](faulty_wire& wire) { wire.set_rate(0); });

  EXPECT_EQ(summary.state, servo_state::running);
  EXPECT_EQ(summary.faults.total(), 0U);
  EXPECT_TRUE(summary.safe_confirmed && summary.left_safe);
  mishap_counts up, down;
  with.tell_wire([&](faulty_wire& wire) { up = wire.up().counts(), down = wire.down().counts(); });
  EXPECT_GT(up.total(), 0U);
  EXPECT_GT(down.total(), 0U);
  std::cout << summary.periods << " periods, " << summary.held << " without a fresh sample; on the wire "
            << up.total() + down.total() << " mishaps\n";
}

// The whole chain of safety: the wire dies, the loop goes safe, the board stops by itself; both stay so when the wire
// is back, until the user asks for reset and start.
TEST(Firmware, RecoversTheServoLoopFromADeadWireOnRequestOnly) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  std::atomic<servo_state> state = servo_state::idle;
  servo_options options = quiet();
  options.outputs.observe = [&](const telemetry_record& record) { state = record.state; };
  servo_session with(500, 100, options);
  std::string error;
  ASSERT_TRUE(with.device.start(error)) << error;
  servo_summary summary;
  std::thread looping([&] { summary = with.loop.run(); });
  const auto wait_for = [&](servo_state wanted) {
    while (state != wanted) pause(1);
  };

  wait_for(servo_state::running);
  with.tell_wire([](faulty_wire& wire) { wire.up().cut(true), wire.down().cut(true); });
  wait_for(servo_state::safe);
  pause(1000);  // many times the board's hundred periods
  with.tell_wire([](faulty_wire& wire) { wire.up().cut(false), wire.down().cut(false); });
  pause(200);
  EXPECT_EQ(state, servo_state::safe);
  while (state != servo_state::running) {
    with.loop.control().reset();
    with.loop.control().start();
    pause(100);
  }
  with.loop.control().stop();
  looping.join();

  EXPECT_GE(summary.faults.total(), 1U);
  EXPECT_TRUE(summary.left_safe);
  EXPECT_GE(with.device.newest_sample().stops, 2U) << "configure is the first stop, the board's watchdog the second";
}

}  // namespace
}  // namespace dashpot
