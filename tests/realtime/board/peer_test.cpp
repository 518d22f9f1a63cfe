// The host's driver against a peer that shares no line of code with it, only the page: peer.py.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/board/board_device.hpp>
#include <dashpot/board/transport.hpp>

#include "child_process.hpp"
#include "in_process_board.hpp"
#include "qemu_board.hpp"

namespace dashpot {
namespace {

using namespace board;

#define DASHPOT_SKIP_WITHOUT_PYTHON()           \
  if (std::string(PYTHON).empty()) {            \
    announce_skip("python3 is not installed");  \
    GTEST_SKIP() << "python3 is not installed"; \
  }

board_options patient(sampling when, std::uint16_t watchdog_periods) {
  board_options options;
  options.sampling = when;
  options.watchdog_periods = watchdog_periods;
  options.late_limit = 1e3;
  options.start_time = 30'000;
  return options;
}

std::vector<std::string> peer_on(const std::string& socket, unsigned axes) {
  std::vector<std::string> words = {PYTHON, PEER, "--unix", socket};
  if (axes == arm_axes) words.push_back("--arm");
  return words;
}

// The peer on a Unix socket, and a device on it.
template <class Plant = test_plant>
struct peer_session {
  explicit peer_session(sampling when, std::uint16_t watchdog_periods = 5000)
      : device(connect_to(folder.path() / "s", peer), described_board_with<Plant>(), patient(when, watchdog_periods)) {}

  // The next sample, whatever the board says of itself.
  device_status next() {
    device_status status = device_status::no_data;
    while (status == device_status::no_data || status == device_status::stale) {
      device.wait_for_sample(1000);
      status = device.read(sample);
    }
    return status;
  }

  testing::TemporaryFolder folder;
  child_process peer{peer_on(folder.path() / "s", Plant::axes)};
  basic_board_device<Plant::axes> device;
  typename loop_types<Plant::axes>::sample sample;
};

// Were the page unclear or the code apart from it, the two would not get past this.
TEST(Peer, UnderstandsTheDriver) {
  DASHPOT_SKIP_WITHOUT_PYTHON();
  peer_session<> with(sampling::on_command);
  std::string error;
  ASSERT_TRUE(with.device.start(error)) << error;
  EXPECT_STREQ(with.device.description_of_board().name, "peer.py");
  with.device.reset();  // of a board that runs: only a sample comes of it
  ASSERT_EQ(with.next(), device_status::ok);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const float torque = 0.01F * static_cast<float>(i), damping = 0.02F * static_cast<float>(i);
    ASSERT_EQ(with.device.write({static_cast<double>(torque), static_cast<double>(damping)}), device_status::ok);
    ASSERT_EQ(with.next(), device_status::ok);
    ASSERT_EQ(with.device.newest_sample().motor_torque, torque);
    ASSERT_EQ(with.device.newest_sample().brake_damping, damping);
    ASSERT_EQ(with.device.newest_sample().command_sequence, i);
    const std::int64_t rise = with.sample.sequence * std::int64_t{3} % 1000;
    ASSERT_EQ(with.sample.counts, rise < 500 ? rise : 1000 - rise);
  }
  ASSERT_EQ(with.device.ask_statistics(), device_status::ok);
  while (!with.device.counts_of_board()) {
    with.device.write({});
    ASSERT_EQ(with.next(), device_status::ok);
  }
  EXPECT_EQ(with.device.counts_of_board()->discarded_bytes, 0U);
  EXPECT_EQ(with.device.statistics().frames.discarded_bytes, 0U);
  EXPECT_EQ(with.device.statistics().samples.lost, 0U);
}

// The same with two axes: on which nobody but the page says which number is whose.
TEST(Peer, UnderstandsTheDriverOnTwoAxes) {
  DASHPOT_SKIP_WITHOUT_PYTHON();
  peer_session<test_arm> with(sampling::on_command);
  std::string error;
  ASSERT_TRUE(with.device.start(error)) << error;
  EXPECT_STREQ(with.device.description_of_board().name, "peer.py");
  with.device.reset();  // of a board that runs: only a sample comes of it
  ASSERT_EQ(with.next(), device_status::ok);
  for (std::uint32_t i = 0; i < 300; ++i) {
    const double part = i / 512.0;  // exact in single precision
    ASSERT_EQ(with.device.write({{part, -part / 2}, {part / 16, part / 32}}), device_status::ok);
    ASSERT_EQ(with.next(), device_status::ok);
    const arm_sample_message& seen = with.device.newest_sample();
    ASSERT_EQ(static_cast<double>(seen.motor_torque[0]), std::min(part, 0.5));
    ASSERT_EQ(static_cast<double>(seen.motor_torque[1]), -part / 2);
    ASSERT_EQ(static_cast<double>(seen.brake_damping[0]), part / 16);
    ASSERT_EQ(static_cast<double>(seen.brake_damping[1]), part / 32);
    ASSERT_EQ(seen.brake_damping[2] + seen.brake_damping[3], 0.0F);
    const std::int64_t rise = with.sample.sequence * std::int64_t{3} % 1000;
    ASSERT_EQ(with.sample.counts[0], 24384 + (rise < 500 ? rise : 1000 - rise));
    ASSERT_EQ(with.sample.counts[1], with.sample.counts[0] - 16000);
  }
  EXPECT_EQ(with.device.statistics().frames.discarded_bytes, 0U);
}

// The rules of the page that protect people: limits, watchdog, reset.
TEST(Peer, KeepsTheSafetyRules) {
  DASHPOT_SKIP_WITHOUT_PYTHON();
  peer_session<> with(sampling::free_running, 100);
  std::string error;
  ASSERT_TRUE(with.device.start(error)) << error;
  with.device.write({1000, 1000});
  while (with.device.newest_sample().motor_torque == 0) ASSERT_EQ(with.next(), device_status::ok);
  EXPECT_EQ(with.device.newest_sample().motor_torque, 50.0F);
  EXPECT_EQ(with.device.newest_sample().brake_damping, 30.0F);

  while (with.next() != device_status::fault) ASSERT_NE(with.device.board_state(), board_state::idle);
  EXPECT_EQ(with.device.stop_cause(), stop_cause::host_silent);
  EXPECT_EQ(with.device.newest_sample().motor_torque, 0.0F);
  EXPECT_EQ(with.device.newest_sample().brake_damping, 4.0F);
  with.device.reset();
  while (with.next() != device_status::ok) ASSERT_EQ(with.device.board_state(), board_state::safe);
  EXPECT_EQ(with.device.newest_sample().motor_torque, 0.0F);
}

// A serial line is what most boards hang on.
TEST(Peer, ServesATerminal) {
  DASHPOT_SKIP_WITHOUT_PYTHON();
  child_process peer({PYTHON, PEER, "--pty"});
  std::string error;
  auto stream = open_transport("serial:" + peer.read_line(), error);
  ASSERT_TRUE(stream) << error;
  board_device device(std::move(*stream), described_board(), patient(sampling::on_command, 5000));
  ASSERT_TRUE(device.start(error)) << error;
  device_sample sample;
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(device.write({0.1, i * 0.1}), device_status::ok);
    do device.wait_for_sample(1000);
    while (device.read(sample) != device_status::ok);
    ASSERT_EQ(device.newest_sample().brake_damping, static_cast<float>(i * 0.1));
  }
  EXPECT_EQ(device.statistics().frames.discarded_bytes, 0U);
}

// A host's configuration that the page forbids must be refused by the peer with the number that the page gives.
TEST(Peer, RefusesByThePage) {
  DASHPOT_SKIP_WITHOUT_PYTHON();
  std::string error;
  peer_session<> with(sampling::on_command, 0);
  EXPECT_FALSE(with.device.start(error));
  EXPECT_EQ(
      error,
      "the board refuses the configuration: a board that the host controls needs a watchdog of one period or more");
}

}  // namespace
}  // namespace dashpot
