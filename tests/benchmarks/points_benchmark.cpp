// A million points of Fig. 5's network in a stream, against copying the same memory, in turn within one run. Bytes are
// those that the program reads and writes: of a point its two inputs, its force, and each state twice.
#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "second_order_maxwell_batch.hpp"

namespace {

using dashpot::generated::second_order_maxwell_batch;

constexpr double bytes_a_point = 8.0 * (2 + 1 + 2 * second_order_maxwell_batch::states);

double thread_time() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of the processor: what others do meanwhile slows the memory for all, but takes no time of ours.
template <class Work>
double seconds(Work work) {
  const double start = thread_time();
  work();
  benchmark::ClobberMemory();
  return thread_time() - start;
}

// The C library's copy goes past the caches where it is long; a plain one through them. The machine's is the faster.
void copy_plainly(const std::vector<double>& from, std::vector<double>& to) {
  for (std::size_t i = 0; i < from.size(); i += 8) {
    for (std::size_t j = i; j < i + 8; ++j) to[j] = from[j];
    asm volatile("" ::: "memory");  // no call of the library's
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Medians of rounds in which all three are timed in turn.
void stream(benchmark::State& state) {
  const auto points = static_cast<std::size_t>(state.range(0));
  const std::size_t copied =
      static_cast<std::size_t>(bytes_a_point) / 16 * points / 8 * 8;  // doubles, read once, written once
  std::vector<double> storage(static_cast<std::size_t>(second_order_maxwell_batch::storage_size(state.range(0))));
  std::vector<double> positions(points, 1e-3), velocities(points, 0.01), forces(points), from(copied, 1), to(copied, 2);
  second_order_maxwell_batch batch(storage.data(), state.range(0));
  std::vector<double> steps, library_copies, plain_copies;
  for (auto _ : state) {
    library_copies.push_back(seconds([&] { std::memcpy(to.data(), from.data(), 8 * copied); }));
    steps.push_back(seconds([&] { batch.step(positions.data(), velocities.data(), forces.data()); }));
    plain_copies.push_back(seconds([&] { copy_plainly(from, to); }));
  }
  benchmark::DoNotOptimize(forces.data());
  benchmark::DoNotOptimize(to.data());
  const double step = bytes_a_point * static_cast<double>(points) / median(steps);
  const double copy = 16 * static_cast<double>(copied) / std::min(median(library_copies), median(plain_copies));
  state.counters["step_GB_per_s"] = step * 1e-9;
  state.counters["copy_GB_per_s"] = copy * 1e-9;
  state.counters["ns_per_point"] = median(steps) / static_cast<double>(points) * 1e9;
  state.counters["of_copy_bandwidth"] = step / copy;
}
BENCHMARK(stream)->Arg(4'000)->Arg(1'000'000)->Iterations(101)->Unit(benchmark::kMicrosecond);

}  // namespace
