// The other end of the loop's rings: prints telemetry as CSV and events as lines, and shows every record to an
// observer. All that may block happens here, in a thread of its own (real time) or between two periods (simulated
// time).
//
// The CSV's first line names the columns with their units; numbers round-trip. A failed write stops the file, not the
// loop, and is reported by write_error(); it raises no signal, on a full disk, at a file's limit or towards a closed
// pipe.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include <dashpot/command.hpp>
#include <dashpot/servo/arm_telemetry.hpp>
#include <dashpot/servo/servo_event.hpp>
#include <dashpot/servo/spsc_ring.hpp>
#include <dashpot/servo/telemetry_record.hpp>

namespace dashpot {

template <class Record>
struct outputs_of {
  std::FILE* csv = nullptr;                    // null: no table
  std::FILE* log = stderr;                     // null: silent
  std::function<void(const Record&)> observe;  // called for every record that was not dropped; must not throw
};
using telemetry_outputs = outputs_of<telemetry_record>;

// The units of a run: `model` names those of position, velocity and command, `joint` those sent to the device.
struct telemetry_units {
  motion model = motion::translation;
  motion joint = motion::translation;
};

std::string csv_header(telemetry_units units);                                    // with its line end
std::string csv_row(const telemetry_record& record, telemetry_units units = {});  // with its line end
std::string csv_header(arm_telemetry_units units);
std::string csv_row(const arm_telemetry_record& record, arm_telemetry_units units);

// Of telemetry_records in telemetry_units, or of arm_telemetry_records in arm_telemetry_units.
template <class Record, class Units>
class record_writer {
 public:
  record_writer(std::size_t capacity, outputs_of<Record> outputs, Units units);
  ~record_writer();  // stops the thread and writes what is left
  record_writer(const record_writer&) = delete;
  record_writer& operator=(const record_writer&) = delete;

  // The loop's side: wait-free.
  spsc_ring<Record>& records() noexcept { return records_; }
  spsc_ring<servo_event>& events() noexcept { return events_; }

  void start();  // the thread; without it, drain() is called by hand
  void stop();   // the thread, after a last drain()
  void drain();  // writes everything that waits; the calling thread is the consumer

  void say(const std::string& lines);  // to the log, from the loop's thread while no period is running
  int write_error() const noexcept { return write_error_; }  // errno of the first failed write, 0: none; after stop()

 private:
  void run();
  void write(const Record& record);
  void put(const std::string& text);

  spsc_ring<Record> records_;
  spsc_ring<servo_event> events_;
  outputs_of<Record> outputs_;
  Units units_;
  int write_error_ = 0;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

using telemetry_writer = record_writer<telemetry_record, telemetry_units>;
using arm_telemetry_writer = record_writer<arm_telemetry_record, arm_telemetry_units>;
extern template class record_writer<telemetry_record, telemetry_units>;
extern template class record_writer<arm_telemetry_record, arm_telemetry_units>;

}  // namespace dashpot
