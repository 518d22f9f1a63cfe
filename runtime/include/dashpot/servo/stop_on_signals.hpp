// While it lives, SIGINT (Ctrl-C), SIGTERM, SIGHUP (the terminal is closed) and SIGXCPU ask a servo loop to stop, so
// that the device is left safe; a SIGHUP that is ignored, as under nohup, stays so. A second one ends the process as
// soon as the device is safe, whatever else it waits for, such as a log that nobody reads; a third one at once. A file
// that may not grow (SIGXFSZ) and a reader that is gone (SIGPIPE) are failed writes, and end nothing. The handlers that
// were there before come back with its end. One at a time in a process.
#pragma once

#include <csignal>

#include <dashpot/servo/servo_control.hpp>

namespace dashpot {

class stop_on_signals {
 public:
  explicit stop_on_signals(servo_control& control) noexcept;
  ~stop_on_signals();
  stop_on_signals(const stop_on_signals&) = delete;
  stop_on_signals& operator=(const stop_on_signals&) = delete;

 private:
  static constexpr int handled = 6;
  struct sigaction before_[handled];
};

}  // namespace dashpot
