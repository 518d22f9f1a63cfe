// Requests to a running servo loop, from any thread or from a signal handler: every call is one store to a lock-free
// atomic. The loop acts on them once a period, after the command has left.
#pragma once

#include <atomic>

namespace dashpot {

class servo_control {
 public:
  void start() noexcept { start_.store(true, std::memory_order_release); }  // idle → running
  void reset() noexcept { reset_.store(true, std::memory_order_release); }  // safe → idle
  void stop() noexcept { stop_.store(true, std::memory_order_release); }    // leave the loop, device safe

  // For a program that cannot wait for a log that nobody reads: `end`, which must not return, is called as soon as no
  // device needs the loop any more; if that is so already, at once in this thread.
  void end_when_safe(void (*end)()) noexcept {
    end_.store(end);
    if (!drives_.load()) end();
  }

  // The loop's side: a request is taken once; a stop stays.
  bool take_start() noexcept { return start_.exchange(false, std::memory_order_acquire); }
  bool take_reset() noexcept { return reset_.exchange(false, std::memory_order_acquire); }
  bool stop_requested() const noexcept { return stop_.load(std::memory_order_acquire); }

  // From here on a device has to be left safe; from there on, it has been.
  void take_device() noexcept { drives_.store(true); }
  void leave_device() noexcept {
    drives_.store(false);
    if (void (*const end)() = end_.load()) end();
  }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<void (*)()>::is_always_lock_free,
                "requests must be safe in a signal handler");
  std::atomic<bool> start_{false};
  std::atomic<bool> reset_{false};
  std::atomic<bool> stop_{false};
  std::atomic<bool> drives_{false};
  std::atomic<void (*)()> end_{nullptr};
};

}  // namespace dashpot
