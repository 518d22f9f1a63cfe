#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

#include <dashpot/servo/telemetry_writer.hpp>

#include "log_text.hpp"

namespace dashpot::tests {
namespace {

telemetry_record full_record() {
  telemetry_record record;
  record.time = 0.017;
  record.period = 17;
  record.state = servo_state::safe;
  record.tripped = fault::encoder_jump;
  record.fresh = true;
  record.lateness = 2300;
  record.response = 900;
  record.position = 0.1;
  record.velocity = -1.0 / 3;
  record.damping = 11;
  record.motor_force = 1e-300;
  record.motor_torque = -2.5;
  record.brake_damping = 7.5;
  record.stored_energy = 0.125;
  record.energy = -1e-7;
  return record;
}

// Broken, a column would have no unit, another unit than its motion's, or another place than its value.
TEST(Telemetry, HeaderNamesEveryColumnWithItsUnit) {
  EXPECT_EQ(csv_header({motion::translation, motion::rotation}),
            "time [s],period,state,fault,fresh,lateness [ns],response [ns],position [m],velocity [m/s],damping [N s/m],"
            "motor_force [N],motor_torque [N m],brake_damping [N m s/rad],stored_energy [J],energy [J]\n");
  EXPECT_EQ(csv_header({motion::rotation, motion::rotation}),
            "time [s],period,state,fault,fresh,lateness [ns],response [ns],position [rad],velocity [rad/s],"
            "damping [N m s/rad],motor_force [N m],motor_torque [N m],brake_damping [N m s/rad],stored_energy [J],"
            "energy [J]\n");
}

// Broken, a number read back from the log would not be the one in the loop.
TEST(Telemetry, RowRoundTripsEveryNumber) {
  EXPECT_EQ(csv_row(full_record()),
            "0.017,17,safe,encoder jump,1,2300,900,0.1,-0.3333333333333333,11,1e-300,-2.5,7.5,0.125,-1e-07\n");
}

// Broken, what was queued when the loop ended would never be written.
TEST(Telemetry, StopWritesWhatIsLeft) {
  log_text csv, log;
  telemetry_writer writer(64, {csv.file(), log.file(), {}}, {});
  writer.start();
  for (int i = 0; i < 10; ++i) writer.records().push(full_record());
  writer.events().push({0.017, 17, servo_state::safe, {fault::overspeed, -2.5, 2}});
  writer.stop();
  std::string expected = csv_header({});
  for (int i = 0; i < 10; ++i) expected += csv_row(full_record());
  EXPECT_EQ(csv.text(), expected);
  EXPECT_EQ(log.text(), "0.017000 s: safe: overspeed: -2.5 m/s, at most 2 m/s\n");
  EXPECT_EQ(writer.write_error(), 0);
}

// Broken, a full disk would end the run, or go untold.
TEST(Telemetry, FailedWriteIsToldAndSurvived) {
  std::FILE* const full = std::fopen("/dev/full", "w");
  ASSERT_NE(full, nullptr);
  int observed = 0;
  telemetry_writer writer(64, {full, nullptr, [&observed](const telemetry_record&) { ++observed; }}, {});
  writer.records().push(full_record());
  writer.drain();
  EXPECT_EQ(writer.write_error(), ENOSPC);
  writer.records().push(full_record());
  writer.drain();
  EXPECT_EQ(observed, 2);
  std::fclose(full);
}

// A file that refuses its first write and takes the later ones.
struct hesitant_file {
  std::string taken;
  bool refused = false;

  static ssize_t write(void* self, const char* bytes, std::size_t size) {
    auto& file = *static_cast<hesitant_file*>(self);
    if (!file.refused) {
      file.refused = true;
      errno = EIO;
      return 0;
    }
    file.taken.append(bytes, size);
    return static_cast<ssize_t>(size);
  }
};

// Broken, a table with a hole in it would look like one without.
TEST(Telemetry, NothingFollowsAFailedWrite) {
  hesitant_file target;
  std::FILE* const file = fopencookie(&target, "w", {nullptr, hesitant_file::write, nullptr, nullptr});
  std::setvbuf(file, nullptr, _IONBF, 0);
  telemetry_writer writer(64, {file, nullptr, {}}, {});
  writer.records().push(full_record());
  writer.drain();
  EXPECT_EQ(writer.write_error(), EIO);
  EXPECT_EQ(target.taken, "");
  std::fclose(file);
}

// Broken, whoever closes the pipe that a log goes into would end the process, with the motor on.
TEST(Telemetry, ReaderThatLeavesIsAFailedWrite) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  std::FILE* const file = fdopen(ends[1], "w");
  std::setvbuf(file, nullptr, _IONBF, 0);
  telemetry_writer writer(64, {file, file, {}}, {});
  writer.say("also what is said");
  writer.records().push(full_record());
  writer.start();
  writer.stop();
  EXPECT_EQ(writer.write_error(), EPIPE);
  sigset_t pending;
  sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGPIPE), 0);
  std::fclose(file);
}

// Broken, the shell's limit on the size of files would end the process in the middle of a run, with the motor on.
TEST(Telemetry, FileAtItsLimitIsAFailedWrite) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::FILE* const file = std::tmpfile();
  std::setvbuf(file, nullptr, _IONBF, 0);
  const rlimit narrow{1000, before.rlim_max};
  telemetry_writer writer(64, {file, nullptr, {}}, {});
  setrlimit(RLIMIT_FSIZE, &narrow);
  for (int i = 0; i < 50; ++i) writer.records().push(full_record());
  writer.start();
  writer.stop();
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(writer.write_error(), EFBIG);
  std::fclose(file);
}

struct sentence {
  fault_report cause;
  const char* text;
};

// Broken, the log would name a fault without the numbers or units that explain it.
TEST(ServoEvent, NamesEveryFaultWithItsEvidence) {
  const sentence sentences[] = {
      {{fault::missed_deadlines, 4, 3}, "missed deadlines: 4 in a row, at most 3"},
      {{fault::no_data, 4, 3}, "no data: 4 periods without a fresh sample, at most 3"},
      {{fault::device_error, 4, 0}, "device error: the device answers 'disconnected'"},
      {{fault::position_not_finite, -1.0 / 0.0, 0}, "position not finite: the device reads -inf"},
      {{fault::report_not_finite, -1.0 / 0.0, 0}, "report not finite: the device says that it applies -inf"},
      {{fault::position_out_of_range, 0.9, 0.8}, "position out of range: 0.9 rad is beyond 0.8 rad"},
      {{fault::encoder_jump, 0.3, 0.0033}, "encoder jump: moved 0.3 rad between two samples, at most 0.0033 rad"},
      {{fault::velocity_not_finite, 1.0 / 0.0, 2}, "velocity not finite: the estimator returns inf"},
      {{fault::overspeed, -31, 30}, "overspeed: -31 rad/s, at most 30 rad/s"},
      {{fault::command_not_finite, 1.0 / 0.0, 0}, "command not finite: the device would get inf"},
      {{fault::motor_saturated, 0.2001, 0.2}, "motor saturated: for 0.2001 s, at most 0.2 s"},
      {{fault::suspended, 12.5, 0}, "suspended: the machine was asleep for 12.5 s"},
  };
  EXPECT_EQ(std::size(sentences), fault_kinds - 1);
  for (const sentence& each : sentences) {
    EXPECT_EQ(to_text({1.25, 1250, servo_state::safe, each.cause}, motion::rotation),
              std::string("1.250000 s: safe: ") + each.text);
  }
  EXPECT_EQ(to_text({0, 0, servo_state::running, {}}, motion::rotation), "0.000000 s: running");
  EXPECT_EQ(to_text({0, 0, servo_state::idle, {fault::device_error, 1, 0}}, motion::rotation),
            "0.000000 s: idle: cannot start: the device answers 'no data'");
  EXPECT_EQ(to_text({0, 0, servo_state::safe, {fault::device_error, 5, 0, "its fuse"}}, motion::rotation),
            "0.000000 s: safe: device error: the device answers 'fault': its fuse");
}

}  // namespace
}  // namespace dashpot::tests
