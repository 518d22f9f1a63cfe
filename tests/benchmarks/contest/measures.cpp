#include "measures.hpp"

#include <malloc.h>
#include <unistd.h>
#include <x86intrin.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace dashpot::contest {
namespace {

constexpr std::size_t mask = 1023;
constexpr double almost_nothing = 0x1p-80;  // of a force, added to the next input: it waits, but stays the same

// A clock in the core itself; nothing before is still under way, nothing after has begun.
std::uint64_t now() {
  _mm_lfence();
  const std::uint64_t ticks = __rdtsc();
  _mm_lfence();
  return ticks;
}

double seconds_per_tick() {
  static const double period = [] {
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t first = now();
    while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(100)) continue;
    const std::uint64_t last = now();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() /
           static_cast<double>(last - first);
  }();
  return period;
}

// Without the tenth at either end. The clock of a virtual machine may move in steps of ten nanoseconds: only a mean is
// finer.
double middle_mean(std::vector<std::uint64_t> ticks) {
  std::sort(ticks.begin(), ticks.end());
  const auto cut = static_cast<std::ptrdiff_t>(ticks.size() / 10);
  const std::uint64_t sum = std::accumulate(ticks.begin() + cut, ticks.end() - cut, std::uint64_t{0});
  return seconds_per_tick() * static_cast<double>(sum) /
         static_cast<double>(ticks.size() - 2 * static_cast<std::size_t>(cut));
}

void keep(const command<double>& now) { asm volatile("" : : "x"(now.damping), "x"(now.force)); }

extern "C" const char __ehdr_start, _end;  // of the linker: the program's first byte, and behind its last

void flush(const char* first, const char* last) {
  for (const char* line = first; line < last; line += 64) _mm_clflush(line);
}

// The program itself, its constants, and all that it has on the heap: out of every level, down to memory.
void empty_caches() {
  static const char* const heap = [] {
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    const auto program_break = reinterpret_cast<std::uintptr_t>(sbrk(0));
    return reinterpret_cast<const char*>(program_break - mallinfo2().arena);
  }();
  flush(&__ehdr_start, &_end);
  flush(heap, static_cast<const char*>(sbrk(0)));
  _mm_mfence();
}

}  // namespace

double run_chain(const contender& c, void* law, const motion& tool, long steps) {
  double force = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i)
    force =
        c.step(law, tool.position[i & mask] + almost_nothing * force, tool.velocity[i & mask] + almost_nothing * force)
            .force;
  return force;
}

double run_stream(const contender& c, void* law, const motion& tool, long steps) {
  std::uint64_t all = 0;  // in a register that calls leave alone
  for (std::size_t i = 0; i < static_cast<std::size_t>(steps); ++i) {
    const double force = c.step(law, tool.position[i & mask], tool.velocity[i & mask]).force;
    std::uint64_t bits = 0;
    std::memcpy(&bits, &force, sizeof bits);
    all ^= bits;
  }
  return static_cast<double>(all);
}

double command_latency(const contender& c, void* law, const motion& tool, int ticks) {
  std::vector<std::uint64_t> taken;
  for (std::size_t i = 0; i < static_cast<std::size_t>(ticks); ++i) {
    const double position = tool.position[i & mask], velocity = tool.velocity[i & mask];
    const std::uint64_t start = now();
    keep(c.output(law, position, velocity));
    taken.push_back(now() - start);
    if (c.update != nullptr) c.update(law);
  }
  return middle_mean(taken);
}

double cold_tick(const contender& c, void* law, const motion& tool, int ticks) {
  std::vector<std::uint64_t> taken;
  for (std::size_t i = 0; i < static_cast<std::size_t>(ticks); ++i) {
    const double position = tool.position[i & mask], velocity = tool.velocity[i & mask];
    empty_caches();
    const std::uint64_t start = now();
    keep(c.output(law, position, velocity));
    if (c.update != nullptr) c.update(law);
    taken.push_back(now() - start);
  }
  return middle_mean(taken);
}

}  // namespace dashpot::contest
