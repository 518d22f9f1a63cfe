// The servo loop's state machine:
//     idle ──start──▶ running ──fault──▶ safe ──reset──▶ idle
// Idle and safe send the safe command every period; only an explicit reset leaves safe, and it never starts by itself.
#pragma once

#include <cstdint>

#include <dashpot/servo/fault.hpp>

namespace dashpot {

enum class servo_state : unsigned char { idle, running, safe };

constexpr const char* name_of(servo_state state) noexcept {
  switch (state) {
    case servo_state::idle: return "idle";
    case servo_state::running: return "running";
    case servo_state::safe: return "safe";
  }
  return "unknown";
}

class servo_state_machine {
 public:
  // Each of the three says whether the state changed; in any other state than the arrow's they do nothing.
  constexpr bool start() noexcept { return move(servo_state::idle, servo_state::running); }
  constexpr bool reset() noexcept { return move(servo_state::safe, servo_state::idle); }
  constexpr bool trip(const fault_report& report) noexcept {
    if (!move(servo_state::running, servo_state::safe)) return false;
    counts_.count(report.kind);
    last_ = report;
    return true;
  }

  constexpr servo_state state() const noexcept { return state_; }
  constexpr bool is_running() const noexcept { return state_ == servo_state::running; }
  constexpr const fault_counts& counts() const noexcept { return counts_; }
  constexpr const fault_report& last_fault() const noexcept { return last_; }

 private:
  constexpr bool move(servo_state from, servo_state to) noexcept {
    if (state_ != from) return false;
    state_ = to;
    return true;
  }

  servo_state state_ = servo_state::idle;
  fault_counts counts_;  // of faults that ended a running state
  fault_report last_;
};

}  // namespace dashpot
