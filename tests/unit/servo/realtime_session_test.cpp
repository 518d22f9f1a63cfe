#include <gtest/gtest.h>

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include <dashpot/servo/realtime_session.hpp>

namespace dashpot {
namespace {

int policy_of_this_thread() {
  int policy = -1;
  sched_param parameters{};
  pthread_getschedparam(pthread_self(), &policy, &parameters);
  return policy;
}

// Broken, the thread would go on at real-time priority after its loop has ended.
TEST(RealtimeSession, GivesTheSchedulingBack) {
  const int before = policy_of_this_thread();
  {
    const realtime_session session({50, false, false});
    ASSERT_TRUE(session.report().scheduling.asked);
    if (session.report().scheduling.is_granted()) {
      EXPECT_EQ(policy_of_this_thread(), SCHED_FIFO);
    } else {
      EXPECT_EQ(policy_of_this_thread(), before);
    }
  }
  EXPECT_EQ(policy_of_this_thread(), before);
}

// Broken, what was not wished for would be done all the same.
TEST(RealtimeSession, DoesNothingUnasked) {
  const int before = policy_of_this_thread();
  const realtime_session session({0, false, false});
  EXPECT_EQ(policy_of_this_thread(), before);
  EXPECT_EQ(to_text(session.report(), {0, false, false}), "");
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_can_be_refused = false;  // sanitizers turn mlockall into a call that always succeeds
#else
constexpr bool memory_can_be_refused = true;
#endif

// In a process without privileges and limits: exits with 0 when every wish is refused and told.
[[noreturn]] void ask_without_privileges() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &none);
  if (geteuid() == 0 && setuid(65534) != 0) std::_Exit(2);
  const realtime_wishes wishes;
  const realtime_session session(wishes);
  std::fputs(to_text(session.report(), wishes).c_str(), stderr);
  const realtime_report& report = session.report();
  const bool refused = report.scheduling.error != 0 && report.latency.error != 0;
  const bool memory_refused = report.memory.error != 0 || !memory_can_be_refused;
  std::_Exit(refused && memory_refused ? 0 : 1);
}

// Broken, a program without the rights for real time would fail, or believe that it has them.
TEST(RealtimeSessionDeathTest, RefusedWishesAreToldAndSurvived) {
  EXPECT_EXIT(ask_without_privileges(), testing::ExitedWithCode(0),
              "SCHED_FIFO priority 80: refused .Operation not permitted., running without\n"
              "locked memory: .*\n"
              "no deep processor sleep: refused .*, running without");
}

}  // namespace
}  // namespace dashpot
