#include <dashpot/servo/stop_on_signals.hpp>

#include <atomic>

#include <unistd.h>

namespace dashpot {
namespace {

constexpr int stopping[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
constexpr int failing_writes[] = {SIGPIPE, SIGXFSZ};

std::atomic<servo_control*> listener{nullptr};
std::atomic<int> heard{0};         // how many signals
std::atomic<int> newest_heard{0};  // which one

// As the signal would have ended it without a handler, so that a shell sees what has happened.
void end_process() {
  const int signal = newest_heard.load();
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  sigprocmask(SIG_UNBLOCK, &only, nullptr);
  ::kill(::getpid(), signal);
  ::_exit(128 + signal);
}

extern "C" void ask_to_stop(int signal) {
  servo_control* const control = listener.load();
  if (control == nullptr) return;
  newest_heard.store(signal);
  switch (heard.fetch_add(1)) {
    case 0: control->stop(); break;
    case 1: control->end_when_safe(end_process); break;
    default: end_process();
  }
}

}  // namespace

stop_on_signals::stop_on_signals(servo_control& control) noexcept : before_{} {
  heard.store(0);
  listener.store(&control);
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  struct sigaction* before = before_;
  for (const int signal : stopping) {
    sigaction(signal, &action, before);
    if (signal == SIGHUP && before->sa_handler == SIG_IGN) sigaction(signal, before, nullptr);
    ++before;
  }
  action.sa_handler = SIG_IGN;
  for (const int signal : failing_writes) sigaction(signal, &action, before++);
}

stop_on_signals::~stop_on_signals() {
  const struct sigaction* before = before_;
  for (const int signal : stopping) sigaction(signal, before++, nullptr);
  for (const int signal : failing_writes) sigaction(signal, before++, nullptr);
  listener.store(nullptr);
}

}  // namespace dashpot
