// While it lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP (the terminal is closed) ask a servo loop to stop, so that the
// device is left safe; a SIGHUP that is ignored, as under nohup, stays so. The handlers that were there before come
// back with its end. One at a time in a process.
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
  struct sigaction before_interrupt_;
  struct sigaction before_terminate_;
  struct sigaction before_hangup_;
};

}  // namespace dashpot
