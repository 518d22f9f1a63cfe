#include <dashpot/servo/stop_on_signals.hpp>

#include <atomic>

namespace dashpot {
namespace {

std::atomic<servo_control*> listener{nullptr};

extern "C" void ask_to_stop(int) {
  if (servo_control* const control = listener.load()) control->stop();
}

}  // namespace

stop_on_signals::stop_on_signals(servo_control& control) noexcept
    : before_interrupt_{}, before_terminate_{}, before_hangup_{} {
  listener.store(&control);
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &before_interrupt_);
  sigaction(SIGTERM, &action, &before_terminate_);
  sigaction(SIGHUP, &action, &before_hangup_);
  if (before_hangup_.sa_handler == SIG_IGN) sigaction(SIGHUP, &before_hangup_, nullptr);
}

stop_on_signals::~stop_on_signals() {
  sigaction(SIGINT, &before_interrupt_, nullptr);
  sigaction(SIGTERM, &before_terminate_, nullptr);
  sigaction(SIGHUP, &before_hangup_, nullptr);
  listener.store(nullptr);
}

}  // namespace dashpot
