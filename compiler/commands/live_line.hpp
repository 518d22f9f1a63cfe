// What a running loop is doing, in one line: overwritten on a terminal, once a second elsewhere. Of motor and brake it
// tells the largest command since the line before.
#pragma once

#include <dashpot/servo/telemetry_record.hpp>

#include <cstdint>

#include "network/port_units.hpp"

namespace dashpot::compiler {

class LiveLine {
 public:
  explicit LiveLine(motion port_motion);

  void show(const telemetry_record& record);  // from the writer's thread
  void finish();                              // tells of what came after the last line, and leaves that standing

 private:
  void print();

  PortUnits units_;
  bool terminal_;
  double interval_;       // between lines [s]
  double next_ = 0;       // [s]
  double last_time_ = 0;  // of the line before [s]
  double time_ = 0;       // of the newest record [s]
  double energy_ = 0;     // [J]
  std::uint64_t records_ = 0;
  std::int64_t latest_ = 0;  // largest lateness since the last line [ns]
  double motor_ = 0;         // largest force since the last line, its magnitude [N] or [N·m]
  double brake_ = 0;         // likewise [N·s/m] or [N·m·s/rad]
  std::uint64_t faults_ = 0;
  bool shown_ = false;
};

}  // namespace dashpot::compiler
