#include "trap.hpp"

#include <linux/prctl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/prctl.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

namespace dashpot::tests {
namespace {

// A sanitizer's runtime enters the kernel whenever it likes.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

thread_local bool armed = false;
thread_local trap_counts trapped;
thread_local volatile char selector = SYSCALL_DISPATCH_FILTER_ALLOW;

void on_system_call(int, siginfo_t*, void*) {
  selector = SYSCALL_DISPATCH_FILTER_ALLOW;  // the return from this handler is a system call too
  ++trapped.system_calls;
}

void note_heap() noexcept {
  if (armed) ++trapped.heap;
}

void note_lock() noexcept {
  if (armed) ++trapped.locks;
}

}  // namespace

bool watch_system_calls() {
  if (sanitized) return false;
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  return prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &selector) == 0;
}

void arm_trap() noexcept {
  armed = true;
  selector = SYSCALL_DISPATCH_FILTER_BLOCK;
}

void disarm_trap() noexcept {
  selector = SYSCALL_DISPATCH_FILTER_ALLOW;
  armed = false;
}

trap_counts take_trapped() noexcept { return std::exchange(trapped, {}); }

}  // namespace dashpot::tests

extern "C" {

void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* block, std::size_t size);
void __real_free(void* block);
int __real_pthread_mutex_lock(pthread_mutex_t* mutex);
int __real_pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex);

void* __wrap_malloc(std::size_t size) {
  dashpot::tests::note_heap();
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  dashpot::tests::note_heap();
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* block, std::size_t size) {
  dashpot::tests::note_heap();
  return __real_realloc(block, size);
}
void __wrap_free(void* block) {
  dashpot::tests::note_heap();
  __real_free(block);
}
int __wrap_pthread_mutex_lock(pthread_mutex_t* mutex) {
  dashpot::tests::note_lock();
  return __real_pthread_mutex_lock(mutex);
}
int __wrap_pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  dashpot::tests::note_lock();
  return __real_pthread_cond_wait(condition, mutex);
}

}  // extern "C"

// Also those of the standard library, whose calls of malloc the linker does not see.
void* operator new(std::size_t size) {
  if (void* const block = std::malloc(size != 0 ? size : 1)) return block;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
