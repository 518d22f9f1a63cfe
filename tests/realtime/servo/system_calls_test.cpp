// What the loop's thread asks of the kernel over whole periods, not only between read and write.
#include <gtest/gtest.h>

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <iostream>
#include <set>
#include <string>
#include <thread>

#include <dashpot/board/board_device.hpp>
#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/servo/servo_loop.hpp>

#include "call_log.hpp"
#include "in_process_board.hpp"
#include "scripted_model.hpp"
#include "stream_pair.hpp"

namespace dashpot::tests {
namespace {

constexpr int logged_periods = 300;

// The log is open from the first release that is waited for until the last period that counts is over.
struct logging_clock : monotonic_clock {
  std::atomic<bool>* over = nullptr;
  bool logs = false;

  wake_up wait() noexcept {
    if (!logs && !*over) begin_call_log(), logs = true;
    if (logs && *over) end_call_log(), logs = false;
    return monotonic_clock::wait();
  }
};

template <void (*Misdeed)()>
class counting_board {
 public:
  counting_board(board_device& device, std::atomic<bool>& over) : device_(device), over_(over) {}

  device_status read(device_sample& sample) noexcept {
    if (++reads_ == 50) Misdeed();
    if (reads_ == logged_periods) over_ = true;
    return device_.read(sample);
  }
  device_status write(const actuation& command) noexcept { return device_.write(command); }
  device_status reset() noexcept { return device_.reset(); }
  const device_description& description() const noexcept { return device_.description(); }

 private:
  board_device& device_;
  std::atomic<bool>& over_;
  int reads_ = 0;
};

void nothing() {}
void ask_the_kernel() { getppid(); }

device_description patient_board() {
  device_description device = board::described_board();
  device.loop.missed_deadlines_allowed = most_missed_deadlines;  // a stalled machine must not end the run
  return device;
}

// The calls of a loop on a board at the other end of a socket, with its log, its table and an observer.
template <void (*Misdeed)()>
std::set<std::string> calls_of_a_loop() {
  board::stream_pair ends = board::connected_pair();
  board::in_process_board<> firmware(std::move(ends.far));
  board_options options;
  options.start_time = 30'000;
  board_device device(std::move(ends.near), patient_board(), options);
  std::string error;
  EXPECT_TRUE(firmware.while_serving([&] { return device.start(error); })) << error;

  std::atomic<bool> over = false;
  counting_board<Misdeed> counting(device, over);
  scripted_model model;
  any_estimator<double> estimator({}, 0.001, device.description().encoder.step);
  servo_options how;
  how.duration = 0.001 * (logged_periods + 50);
  how.outputs.csv = std::tmpfile();
  how.outputs.log = nullptr;
  how.outputs.observe = [](const telemetry_record&) {};
  how.command.energy = energy_policy::raise_brake;
  logging_clock clock;
  clock.over = &over;
  servo_loop loop(model, counting, estimator, how, clock);
  take_logged_calls();
  const servo_summary summary = firmware.while_serving([&] { return loop.run(); });
  end_call_log();
  std::fclose(how.outputs.csv);
  EXPECT_TRUE(over) << "the loop did not come as far: " << to_text(summary);
  std::set<std::string> names;
  for (const long number : take_logged_calls()) names.insert(name_of_call(number));
  return names;
}

// Where a kernel offers no vDSO, or a container hides it, reading a clock is a call.
bool clock_is_a_call() {
  begin_call_log();
  timespec time;
  clock_gettime(CLOCK_BOOTTIME, &time);
  end_call_log();
  return take_logged_calls().count(SYS_clock_gettime) != 0;
}

class SystemCalls : public testing::Test {
 protected:
  void SetUp() override {
    if (can_log_calls()) return;
    std::cerr << "WARNING: system calls cannot be logged here\n";
    GTEST_SKIP() << "system calls cannot be logged here";
  }
};

// Broken, the loop's thread would wait for a lock, a file or memory somewhere in its period.
TEST_F(SystemCalls, OfTheLoopAreSleepReadAndSend) {
  std::set<std::string> allowed = {"clock_nanosleep", "read", "sendto"};
  if (clock_is_a_call()) allowed.insert("clock_gettime");
  EXPECT_EQ(calls_of_a_loop<nothing>(), allowed);
}

// Broken, the test above would pass because nothing is ever noted.
TEST_F(SystemCalls, AreNoted) { EXPECT_EQ(calls_of_a_loop<ask_the_kernel>().count("getppid"), 1u); }

}  // namespace
}  // namespace dashpot::tests
