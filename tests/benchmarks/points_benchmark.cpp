// A million points of Fig. 5's network in a stream, against copying the same memory, in turn within one run. Bytes are those that the
// program reads and writes: of a point its two inputs, its force, and each state twice.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

#include "second_order_maxwell_batch.hpp"

namespace {

using dashpot::generated::second_order_maxwell_batch;
using Clock = std::chrono::steady_clock;

constexpr double bytes_a_point = 8.0 * (2 + 1 + 2 * second_order_maxwell_batch::states);

template <class Work>
double seconds(Work work) {
  const auto start = Clock::now();
  work();
  benchmark::ClobberMemory();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Median of the ratio of each round: both halves of a round are timed in the same moment.
void stream(benchmark::State& state) {
  const auto points = static_cast<std::size_t>(state.range(0));
  const auto copied = static_cast<std::size_t>(bytes_a_point) * points / 2;  // read once, written once
  std::vector<double> storage(static_cast<std::size_t>(second_order_maxwell_batch::storage_size(state.range(0))));
  std::vector<double> positions(points, 1e-3), velocities(points, 0.01), forces(points);
  std::vector<char> from(copied, 1), to(copied, 2);
  second_order_maxwell_batch batch(storage.data(), state.range(0));
  std::vector<double> ratios, step_times, copy_times;
  for (auto _ : state) {
    copy_times.push_back(seconds([&] { std::memcpy(to.data(), from.data(), copied); }));
    step_times.push_back(seconds([&] { batch.step(positions.data(), velocities.data(), forces.data()); }));
    ratios.push_back(copy_times.back() / step_times.back());
  }
  benchmark::DoNotOptimize(forces.data());
  benchmark::DoNotOptimize(to.data());
  const double bytes = bytes_a_point * static_cast<double>(points);
  state.counters["step_GB_per_s"] = bytes / median(step_times) * 1e-9;
  state.counters["copy_GB_per_s"] = bytes / median(copy_times) * 1e-9;
  state.counters["ns_per_point"] = median(step_times) / static_cast<double>(points) * 1e9;
  state.counters["of_copy_bandwidth"] = median(ratios);
}
BENCHMARK(stream)->Arg(4'000)->Arg(1'000'000)->Iterations(101)->Unit(benchmark::kMicrosecond);

}  // namespace
