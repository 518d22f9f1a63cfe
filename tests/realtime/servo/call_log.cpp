#include "call_log.hpp"

#include <errno.h>
#include <linux/prctl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace dashpot::tests {
namespace {

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)

constexpr long largest_number = 1024;
thread_local volatile char gate = SYSCALL_DISPATCH_FILTER_ALLOW;
thread_local volatile bool logging = false;
thread_local std::array<bool, largest_number> logged{};

// The kernel has not made the call: it is noted and made from here, and its result put where the caller expects it.
void on_call(int, siginfo_t* what, void* context) {
  gate = SYSCALL_DISPATCH_FILTER_ALLOW;
  auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const long number = what->si_syscall;
  if (number >= 0 && number < largest_number) logged[static_cast<std::size_t>(number)] = true;
  const long result = syscall(number, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX], registers[REG_R10],
                              registers[REG_R8], registers[REG_R9]);
  registers[REG_RAX] = result < 0 ? -errno : result;
  if (logging) gate = SYSCALL_DISPATCH_FILTER_BLOCK;
}

// What a handler returns through is a call too, which must pass.
struct kernel_action {
  void* handler;
  unsigned long flags;
  void* restorer;
  std::uint64_t mask;
};

bool dispatch_calls() {
  struct sigaction action {};
  action.sa_sigaction = on_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  kernel_action known{};
  if (syscall(SYS_rt_sigaction, SIGSYS, nullptr, &known, sizeof known.mask) != 0 || known.restorer == nullptr)
    return false;
  return prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, known.restorer, 16, &gate) == 0;
}

#endif

}  // namespace

#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)

bool can_log_calls() {
  if (!dispatch_calls()) return false;
  prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
  return true;
}

void begin_call_log() {
  dispatch_calls();
  logging = true;
  gate = SYSCALL_DISPATCH_FILTER_BLOCK;
}

void end_call_log() {
  gate = SYSCALL_DISPATCH_FILTER_ALLOW;
  logging = false;
  prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
}

std::set<long> take_logged_calls() {
  std::set<long> numbers;
  for (long number = 0; number < largest_number; ++number)
    if (logged[static_cast<std::size_t>(number)]) numbers.insert(number);
  logged = {};
  return numbers;
}

#else

bool can_log_calls() { return false; }
void begin_call_log() {}
void end_call_log() {}
std::set<long> take_logged_calls() { return {}; }

#endif

std::string name_of_call(long number) {
  switch (number) {
    case SYS_clock_nanosleep: return "clock_nanosleep";
    case SYS_read: return "read";
    case SYS_sendto: return "sendto";
    case SYS_write: return "write";
    case SYS_clock_gettime: return "clock_gettime";
    case SYS_futex: return "futex";
    case SYS_getppid: return "getppid";
    default: return std::to_string(number);
  }
}

}  // namespace dashpot::tests
