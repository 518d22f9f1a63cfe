// One step of the emitted laws of Fig. 5 and Fig. 10 against the paper's as printed, timed in turn within one run: the ratio does not
// depend on how busy the machine is at the time.
#include <benchmark/benchmark.h>

#include <chrono>

#include "printed_law.hpp"
#include "printed_slip.hpp"
#include "runs.hpp"
#include "second_order_maxwell.hpp"
#include "second_order_maxwell_euler.hpp"
#include "visco_elasto_plastic.hpp"

namespace {

using namespace dashpot::benchmarks;
using dashpot::generated::second_order_maxwell;
using dashpot::generated::second_order_maxwell_euler;
using dashpot::generated::visco_elasto_plastic;
using Clock = std::chrono::steady_clock;

constexpr long steps = 20'000;

template <class Law, class Run>
double seconds(Law& law, Run run) {
  const auto start = Clock::now();
  benchmark::DoNotOptimize(run(law, steps));
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <class Law, class Printed = printed_law, class Run>
void compare(benchmark::State& state, Run run) {
  Law emitted;
  Printed printed;
  double emitted_time = 0, printed_time = 0;
  for (auto _ : state) {
    emitted_time += seconds(emitted, run);
    printed_time += seconds(printed, run);
  }
  const double nanoseconds = 1e9 / (static_cast<double>(steps) * static_cast<double>(state.iterations()));
  state.counters["emitted_ns"] = emitted_time * nanoseconds;
  state.counters["printed_ns"] = printed_time * nanoseconds;
  state.counters["printed_per_emitted"] = printed_time / emitted_time;
}

template <class Run>
void compare_exact(benchmark::State& state, Run run) {
  compare<second_order_maxwell>(state, run);
}

template <class Run>
void compare_euler(benchmark::State& state, Run run) {
  compare<second_order_maxwell_euler>(state, run);
}

template <class Run>
void compare_slip(benchmark::State& state, Run run) {
  compare<visco_elasto_plastic, printed_slip>(state, run);
}

const auto chain = [](auto& law, long count) { return run_chain(law, count); };
const auto stream = [](auto& law, long count) { return run_stream(law, count); };

BENCHMARK_CAPTURE(compare_exact, exact_chain, chain)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(compare_exact, exact_stream, stream)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(compare_euler, euler_chain, chain)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(compare_euler, euler_stream, stream)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(compare_slip, slip_chain, chain)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(compare_slip, slip_stream, stream)->Unit(benchmark::kMicrosecond);

}  // namespace
