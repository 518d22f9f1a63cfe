// While it lives, the calling thread runs as real time as the system allows: SCHED_FIFO, memory locked and touched, the
// processors kept out of their deep sleep states. What is not granted is reported, and the loop runs without it. The
// thread's former scheduling comes back with its end.
#pragma once

#include <string>

namespace dashpot {

struct realtime_wishes {
  int priority = 80;        // SCHED_FIFO, 1 … 99; 0: leave the scheduling alone
  bool lock_memory = true;  // mlockall and a touched stack
  bool stay_awake = true;   // 0 µs in /dev/cpu_dma_latency
};

// One wish and what came of it.
struct realtime_grant {
  bool asked = false;
  int error = 0;  // errno, 0: granted

  bool is_granted() const noexcept { return asked && error == 0; }
};

struct realtime_report {
  realtime_grant scheduling;
  realtime_grant memory;
  realtime_grant latency;
};

// One line a wish, the last without its end: "SCHED_FIFO priority 80: granted", "locked memory: refused (Operation not
// permitted), running without".
std::string to_text(const realtime_report& report, const realtime_wishes& wishes);

class realtime_session {
 public:
  explicit realtime_session(const realtime_wishes& wishes) noexcept;
  ~realtime_session();
  realtime_session(const realtime_session&) = delete;
  realtime_session& operator=(const realtime_session&) = delete;

  const realtime_report& report() const noexcept { return report_; }

 private:
  int raise_priority(int priority) noexcept;
  int lock_memory() noexcept;
  int hold_latency() noexcept;

  realtime_report report_;
  int former_policy_ = 0;
  int former_priority_ = 0;
  int latency_file_ = -1;  // the request lasts while it is open
};

}  // namespace dashpot
