// The firmware under QEMU at the end of a wire that loses, repeats, damages and delays frames both ways.
#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>

#include "faulty_wire.hpp"
#include "in_process_board.hpp"
#include "qemu_board.hpp"
#include "stream_pair.hpp"

namespace dashpot {
namespace {

using namespace board;

board_options patient() {
  board_options options;
  options.watchdog_periods = 5000;
  options.late_limit = 1e3;
  options.start_time = 30'000;
  return options;
}

class wired_session {
 public:
  wired_session()
      : ends_(connected_pair()),
        device(std::move(ends_.near), described_board(), patient()),
        board_side_(emulated_.connect()),
        board_watch_(::dup(board_side_.descriptor()), transport::kind::stream_socket),
        wire(std::move(ends_.far), std::move(board_side_), 1) {}

  bool start(std::string& error) {
    std::atomic<bool> done = false;
    std::thread carrier([&] {
      while (!done) {
        wire.carry();
        board_watch_.wait_readable(1);
      }
    });
    const bool started = device.start(error);
    done = true;
    carrier.join();
    return started;
  }

  // One command, and what comes up the wire: its answer, or nothing for some milliseconds because it was lost.
  device_status exchange(double torque) {
    EXPECT_EQ(device.write({torque, 5}), device_status::ok);
    const std::uint32_t seen = wire.up().frames_seen();
    for (int waits = 0; waits < 10 && wire.up().frames_seen() == seen; ++waits) {
      wire.carry();
      board_watch_.wait_readable(1);
    }
    wire.carry();
    return device.read(sample);
  }

 private:
  qemu_board emulated_;
  stream_pair ends_;

 public:
  board_device device;

 private:
  transport board_side_;
  transport board_watch_;

 public:
  faulty_wire wire;
  device_sample sample;
};

// The firmware and the host are two programs with clocks of their own: what the unit tests prove in lockstep must hold
// when nothing waits for anything. Host and board must count exactly what the wire did, and the session must go on.
TEST(Firmware, SurvivesAndCountsABadWire) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  wired_session with;
  std::string error;
  ASSERT_TRUE(with.start(error)) << error;
  with.exchange(0);
  with.wire.set_rate(0.2);
  float applied = 0;
  for (int i = 1; i <= 1000; ++i) {
    const device_status status = with.exchange(0.01 * i);
    ASSERT_TRUE(status != device_status::fault && status != device_status::disconnected);
    ASSERT_GE(with.device.newest_sample().motor_torque, applied);
    applied = with.device.newest_sample().motor_torque;
  }
  with.wire.set_rate(0);
  with.exchange(10);
  while (!with.device.counts_of_board()) {
    ASSERT_EQ(with.device.ask_statistics(), device_status::ok);
    with.exchange(10);
  }

  const mishap_counts& up = with.wire.up().counts();
  const board_statistics host = with.device.statistics();
  EXPECT_EQ(host.frames.corrupted, up.damaged);
  EXPECT_EQ(host.samples.lost, up.lost + up.damaged + with.device.counts_of_board()->dropped);
  EXPECT_EQ(host.samples.repeated, up.repeated);
  EXPECT_EQ(host.samples.late, up.delayed);
  const mishap_counts& down = with.wire.down().counts();
  const statistics_message& board = *with.device.counts_of_board();
  EXPECT_EQ(board.corrupted, down.damaged);
  EXPECT_EQ(board.lost, down.lost + down.damaged);
  EXPECT_EQ(board.repeated, down.repeated);
  EXPECT_EQ(board.late, down.delayed);
  EXPECT_GT(up.lost * up.repeated * up.damaged * up.delayed * down.lost * down.repeated * down.damaged * down.delayed,
            0U);
  EXPECT_EQ(with.device.newest_sample().motor_torque, 10.0F);
}

}  // namespace
}  // namespace dashpot
