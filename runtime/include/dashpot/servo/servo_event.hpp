// A change of the loop's state, for people: one line in the log.
#pragma once

#include <cstdint>
#include <string>

#include <dashpot/command.hpp>
#include <dashpot/servo/fault.hpp>
#include <dashpot/servo/servo_state.hpp>

namespace dashpot {

// Which part of a device of two axes is at fault; on one axis, and where it is all of it, none.
struct fault_place {
  const char* name = nullptr;  // "joint 1", a literal
  bool is_tip = false;         // whose positions are in metres, whatever the joints' are
};

struct servo_event {
  double time = 0;  // since the loop's start [s]
  std::uint64_t period = 0;
  servo_state entered = servo_state::idle;
  fault_report cause;  // of entering safe, or what keeps the loop in idle although a start was asked for
  fault_place place = {};
};

// "0.4170 s: safe: encoder jump: moved 0.5 rad between two samples, at most 0.0031 rad". `joint` names the units.
std::string to_text(const servo_event& event, motion joint);

}  // namespace dashpot
