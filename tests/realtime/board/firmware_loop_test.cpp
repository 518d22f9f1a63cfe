// A paced host loop on the firmware under QEMU.
#include <chrono>
#include <iostream>

#include <time.h>

#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>

#include "in_process_board.hpp"
#include "qemu_board.hpp"

namespace dashpot {
namespace {

using namespace board;

// The emulator stands in for hardware in everything but punctuality: pauses of either process must not end a test.
board_options patient(sampling when) {
  board_options options;
  options.sampling = when;
  options.watchdog_periods = 5000;
  options.late_limit = 1e3;
  options.start_time = 30'000;
  return options;
}

class paced_clock {
 public:
  void wait_for_next(std::uint64_t period) {
    next_ += period;
    const timespec until = {static_cast<time_t>(next_ / 1'000'000'000U), static_cast<long>(next_ % 1'000'000'000U)};
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  }

 private:
  std::uint64_t next_ = monotonic_nanoseconds();
};

// The whole way from Device interface to emulated UART and back, at the rate of a real loop: on a sound line nothing
// may be damaged or misread, and nothing missing but what a side could not send and says so, however late they are
// scheduled.
TEST(Firmware, AnswersEveryCommandOfAPacedLoop) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  const auto switched_on = std::chrono::steady_clock::now();
  qemu_board emulated;
  board_device device(emulated.connect(), described_board(), patient(sampling::on_command));
  std::string error;
  ASSERT_TRUE(device.start(error)) << error;
  EXPECT_STREQ(device.description_of_board().name, "dashpot mps2");

  constexpr std::uint32_t periods = 2000;
  device_sample sample;
  unsigned fresh = 0;
  double sent = 0;
  std::uint64_t board_time = 0;
  paced_clock clock;
  for (std::uint32_t i = 0; i < periods; ++i) {
    const device_status status = device.read(sample);
    ASSERT_TRUE(status == device_status::ok || status == device_status::no_data || status == device_status::stale);
    fresh += status == device_status::ok;
    if (status == device_status::ok) {
      EXPECT_GT(device.newest_sample().timestamp, board_time);
      board_time = device.newest_sample().timestamp;
    }
    sent = 0.001 * i;
    const device_status written = device.write({sent, 5});
    ASSERT_TRUE(written == device_status::ok || written == device_status::stale);
    clock.wait_for_next(1'000'000);
  }
  while (device.write({sent, 5}) != device_status::ok) device.read(sample);
  while (device.newest_sample().command_sequence != device.statistics().commands_sent - 1) {
    device.wait_for_sample(1000);
    ASSERT_NE(device.read(sample), device_status::disconnected);
  }
  EXPECT_EQ(device.newest_sample().motor_torque, static_cast<float>(sent));
  EXPECT_EQ(device.newest_sample().brake_damping, 5.0F);
  const std::chrono::nanoseconds since = std::chrono::steady_clock::now() - switched_on;
  EXPECT_LE(board_time, static_cast<std::uint64_t>(since.count())) << "an emulated clock is no faster than the host's";
  while (!device.counts_of_board()) {
    device.ask_statistics();
    device.wait_for_sample(1000);
    device.read(sample);
  }
  EXPECT_EQ(device.statistics().samples.lost, device.counts_of_board()->dropped);
  // The emulated line has no baud rate: an emulator that did not run while the stream filled up gets all that has
  // waited at once, as no real line brings it, and may lose some of it.
  if (device.statistics().commands_dropped == 0) {
    EXPECT_EQ(device.counts_of_board()->lost, 0U);
    EXPECT_EQ(device.counts_of_board()->discarded_bytes, 0U);
  }
  EXPECT_EQ(device.statistics().frames.discarded_bytes, 0U);
  EXPECT_NE(sample.counts, 0);
  std::cout << fresh << " of " << periods << " periods of 1 ms had a fresh sample, "
            << device.statistics().commands_dropped << " commands found the stream full\n";
}

// The board's own watchdog, timed by its own clock, with nobody there to help.
TEST(Firmware, StopsTheMotorWhenTheHostFallsSilent) {
  DASHPOT_SKIP_WITHOUT_QEMU();
  qemu_board emulated;
  board_options options = patient(sampling::free_running);
  options.watchdog_periods = 100;
  board_device device(emulated.connect(), described_board(), options);
  std::string error;
  ASSERT_TRUE(device.start(error)) << error;
  device_sample sample;
  const auto wait_for = [&](device_status wanted) {
    device_status status = device_status::no_data;
    while (status != wanted && status != device_status::disconnected) {
      device.wait_for_sample(1000);
      status = device.read(sample);
    }
    return status == wanted;
  };
  ASSERT_EQ(device.write({2, 3}), device_status::ok);
  ASSERT_TRUE(wait_for(device_status::fault));
  EXPECT_EQ(device.board_state(), board_state::safe);
  EXPECT_EQ(device.stop_cause(), stop_cause::host_silent);
  EXPECT_EQ(device.newest_sample().motor_torque, 0.0F);
  EXPECT_EQ(device.newest_sample().brake_damping, 4.0F);

  ASSERT_EQ(device.write({2, 3}), device_status::ok);
  while (device.newest_sample().command_sequence != 1) ASSERT_TRUE(wait_for(device_status::fault));
  EXPECT_EQ(device.newest_sample().motor_torque, 0.0F) << "a command alone must not end the stop";
  ASSERT_EQ(device.reset(), device_status::ok);
  ASSERT_TRUE(wait_for(device_status::ok));
  ASSERT_EQ(device.write({2, 3}), device_status::ok);
  while (device.newest_sample().command_sequence != 2) ASSERT_TRUE(wait_for(device_status::ok));
  EXPECT_EQ(device.newest_sample().motor_torque, 2.0F);
}

}  // namespace
}  // namespace dashpot
