// Counts what must not happen while it is armed in a thread: heap, locks, sleeps, and system calls of any kind.
//
// Heap and locks are caught by the linker (--wrap) and by replaced operators new and delete, system calls by the kernel
// (syscall user dispatch): one that is trapped is not carried out.
#pragma once

namespace dashpot::tests {

struct trap_counts {
  int heap = 0;
  int locks = 0;
  int system_calls = 0;

  int total() const { return heap + locks + system_calls; }
};

// From here on the kernel watches the calling thread. False: this kernel cannot, or a sanitizer
// is in the way, and only heap and locks are counted.
bool watch_system_calls();

void arm_trap() noexcept;
void disarm_trap() noexcept;
trap_counts take_trapped() noexcept;  // of the calling thread, and starts again from zero

}  // namespace dashpot::tests
