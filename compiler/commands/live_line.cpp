#include "commands/live_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace dashpot::compiler {

LiveLine::LiveLine(motion port_motion)
    : units_(port_units(port_motion)),
      terminal_(::isatty(STDOUT_FILENO) == 1),
      interval_(terminal_ ? 0.1 : 1.0),
      next_(interval_) {}

void LiveLine::show(const telemetry_record& record) {
  ++records_;
  time_ = record.time;
  energy_ = record.energy;
  latest_ = std::max(latest_, record.lateness);
  motor_ = std::max(motor_, std::abs(record.motor_force));
  brake_ = std::max(brake_, record.damping);
  if (record.tripped != fault::none) ++faults_;
  if (time_ >= next_) print();
}

void LiveLine::print() {
  const double elapsed = time_ - last_time_;
  const double periods = shown_ ? double(records_) : double(records_) - 1;  // the first record begins one
  const double rate = elapsed > 0 ? periods / elapsed : 0;
  const std::string line = fmt::format(
      "{}{:7.1f} s  {:7.0f} Hz  late {:6.0f} us  motor up to {:9.4f} {}  brake up to {:8.4f} {}  energy {:9.5f} J  "
      "faults {}{}",
      terminal_ ? "\r" : "", time_, rate, double(latest_) * 1e-3, motor_, units_.force, brake_, units_.damping, energy_,
      faults_, terminal_ ? "" : "\n");
  std::fputs(line.c_str(), stdout);  // nobody has to read along
  std::fflush(stdout);
  shown_ = true;
  next_ = time_ + interval_;
  last_time_ = time_;
  records_ = 0;
  latest_ = 0;
  motor_ = brake_ = 0;
}

void LiveLine::finish() {
  if (records_ > 0) print();
  if (terminal_ && shown_) std::fputs("\n", stdout);
}

}  // namespace dashpot::compiler
