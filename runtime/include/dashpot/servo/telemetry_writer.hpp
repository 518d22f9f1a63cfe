// The other end of the loop's rings: prints telemetry as CSV and events as lines, and shows every record to an
// observer. All that may block happens here, in a thread of its own (real time) or between two periods (simulated
// time).
//
// The CSV's first line names the columns with their units; numbers round-trip. A failed write stops the file, not the
// loop, and is told by write_error(); it raises no signal, on a full disk, at a file's limit or towards a closed pipe.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include <dashpot/command.hpp>
#include <dashpot/servo/servo_event.hpp>
#include <dashpot/servo/spsc_ring.hpp>
#include <dashpot/servo/telemetry_record.hpp>

namespace dashpot {

struct telemetry_outputs {
  std::FILE* csv = nullptr;                              // null: no table
  std::FILE* log = stderr;                               // null: silent
  std::function<void(const telemetry_record&)> observe;  // called for every record that was not dropped; must not throw
};

// The units of a run: `model` names those of position, velocity and command, `joint` those sent to the device.
struct telemetry_units {
  motion model = motion::translation;
  motion joint = motion::translation;
};

std::string csv_header(telemetry_units units);        // with its line end
std::string csv_row(const telemetry_record& record);  // with its line end

class telemetry_writer {
 public:
  telemetry_writer(std::size_t capacity, telemetry_outputs outputs, telemetry_units units);
  ~telemetry_writer();  // stops the thread and writes what is left
  telemetry_writer(const telemetry_writer&) = delete;
  telemetry_writer& operator=(const telemetry_writer&) = delete;

  // The loop's side: wait-free.
  spsc_ring<telemetry_record>& records() noexcept { return records_; }
  spsc_ring<servo_event>& events() noexcept { return events_; }

  void start();  // the thread; without it, drain() is called by hand
  void stop();   // the thread, after a last drain()
  void drain();  // writes everything that waits; the calling thread is the consumer

  void say(const std::string& lines);  // to the log, from the loop's thread while no period is running
  int write_error() const noexcept { return write_error_; }  // errno of the first failed write, 0: none; after stop()

 private:
  void run();
  void write(const telemetry_record& record);
  void put(const std::string& text);

  spsc_ring<telemetry_record> records_;
  spsc_ring<servo_event> events_;
  telemetry_outputs outputs_;
  telemetry_units units_;
  int write_error_ = 0;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace dashpot
