#include <dashpot/servo/realtime_session.hpp>

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace dashpot {
namespace {

constexpr unsigned touched_stack = 256 * 1024;  // [bytes], far above what the loop uses
constexpr unsigned page = 4096;                 // [bytes], the smallest a page may be

// Written to, so that no page of it is first mapped inside the loop.
void touch_stack() noexcept {
  unsigned char stack[touched_stack];
  volatile unsigned char* const bytes = stack;  // the compiler may not leave the writes out
  for (unsigned i = 0; i < touched_stack; i += page) bytes[i] = 0;
}

std::string outcome(const std::string& wish, const realtime_grant& grant) {
  if (!grant.asked) return {};
  if (grant.is_granted()) return wish + ": granted\n";
  return wish + ": refused (" + std::strerror(grant.error) + "), running without\n";
}

}  // namespace

std::string to_text(const realtime_report& report, const realtime_wishes& wishes) {
  std::string lines = outcome("SCHED_FIFO priority " + std::to_string(wishes.priority), report.scheduling) +
                      outcome("locked memory", report.memory) + outcome("no deep processor sleep", report.latency);
  if (!lines.empty()) lines.pop_back();
  return lines;
}

realtime_session::realtime_session(const realtime_wishes& wishes) noexcept {
  if (wishes.lock_memory) report_.memory = {true, lock_memory()};
  if (wishes.stay_awake) report_.latency = {true, hold_latency()};
  if (wishes.priority > 0) report_.scheduling = {true, raise_priority(wishes.priority)};
}

realtime_session::~realtime_session() {
  if (report_.scheduling.is_granted()) {
    const sched_param former{former_priority_};
    pthread_setschedparam(pthread_self(), former_policy_, &former);
  }
  if (report_.memory.is_granted()) munlockall();
  if (latency_file_ >= 0) close(latency_file_);
}

int realtime_session::raise_priority(int priority) noexcept {
  sched_param former{};
  if (const int error = pthread_getschedparam(pthread_self(), &former_policy_, &former)) return error;
  former_priority_ = former.sched_priority;
  const sched_param wanted{priority};
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
}

int realtime_session::lock_memory() noexcept {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) return errno;
  touch_stack();
  return 0;
}

int realtime_session::hold_latency() noexcept {
  latency_file_ = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  if (latency_file_ < 0) return errno;
  const std::int32_t longest = 0;  // [µs]
  return write(latency_file_, &longest, sizeof longest) < 0 ? errno : 0;
}

}  // namespace dashpot
