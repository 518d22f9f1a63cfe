// contest [--equal | --count | --places | Google Benchmark's options]: the contenders, held against each other first.
//   --equal   only that
//   --count   under callgrind: for each contender one profile of 1,000 steps of its chain, called NETWORK/NAME
//   --places  where in the program each contender's functions are: NETWORK/NAME, tab, addresses as in its table of
//   symbols
#include <benchmark/benchmark.h>
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "equality.hpp"
#include "machine.hpp"
#include "measures.hpp"

namespace {

using namespace dashpot::contest;

std::string title(const contender& c) { return c.network + "/" + c.name; }

bool all_equal(const std::vector<contender>& contenders) {
  bool equal = true;
  for (const verdict& v : compare(contenders)) {
    equal = equal && v.is_equal();
    std::fprintf(stderr, "%-50s differs by %.1e N and %.1e N s/m, tolerance %.1e%s\n", title(v.who).c_str(),
                 v.force_difference, v.damping_difference, v.tolerance, v.is_equal() ? "" : ": NOT THE SAME JOB");
  }
  return equal;
}

int count(const std::vector<contender>& contenders) {
  for (const contender& c : contenders) {
    const std::shared_ptr<void> law = c.make();
    const motion tool = motion_for(c.network);
    const std::string name = title(c);
    asm volatile("" : : "r"(name.c_str()) : "memory");  // callgrind reads it behind the compiler's back
    CALLGRIND_ZERO_STATS;
    benchmark::DoNotOptimize(run_chain(c, law.get(), tool, 1000));
    CALLGRIND_DUMP_STATS_AT(name.c_str());
  }
  return 0;
}

extern "C" const char __ehdr_start;  // of the linker: where the program's first byte is

std::uintptr_t place(const void* function) {
  return reinterpret_cast<std::uintptr_t>(function) - reinterpret_cast<std::uintptr_t>(&__ehdr_start);
}

int places(const std::vector<contender>& contenders) {
  for (const contender& c : contenders) {
    std::printf("%s\t%lx", title(c).c_str(), place(reinterpret_cast<const void*>(c.output)));
    if (c.update != nullptr) std::printf("\t%lx", place(reinterpret_cast<const void*>(c.update)));
    std::printf("\n");
  }
  return 0;
}

using Run = double (*)(const contender&, void*, const motion&, long);
using Tick = double (*)(const contender&, void*, const motion&, int);

void many(benchmark::State& state, const contender& c, Run run) {
  constexpr long steps = 4096;
  const std::shared_ptr<void> law = c.make();
  const motion tool = motion_for(c.network);
  for (auto _ : state) benchmark::DoNotOptimize(run(c, law.get(), tool, steps));
  state.counters["step"] =
      benchmark::Counter(steps, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void single(benchmark::State& state, const contender& c, Tick tick, int ticks) {
  const std::shared_ptr<void> law = c.make();
  const motion tool = motion_for(c.network);
  double time = 0;
  for (auto _ : state) state.SetIterationTime(time = tick(c, law.get(), tool, ticks));
  state.counters["step"] = time;
}

void announce(const contender& c) {
  const auto named = [&](const char* measure) { return title(c) + "/" + measure; };
  benchmark::RegisterBenchmark(named("chain").c_str(), many, c, run_chain);
  benchmark::RegisterBenchmark(named("throughput").c_str(), many, c, run_stream);
  benchmark::RegisterBenchmark(named("latency").c_str(), single, c, command_latency, 1001)
      ->UseManualTime()
      ->Iterations(3);
  benchmark::RegisterBenchmark(named("cold").c_str(), single, c, cold_tick, 15)->UseManualTime()->Iterations(1);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<contender> contenders = all_contenders();
  const auto asked = [&](const char* option) { return argc == 2 && std::strcmp(argv[1], option) == 0; };
  if (asked("--places")) return places(contenders);
  if (!asked("--count") && !all_equal(contenders)) return 1;
  if (asked("--equal")) return 0;
  contenders.push_back(nothing());
  if (asked("--count")) return count(contenders);
  benchmark::Initialize(&argc, argv);
  for (const contender& c : contenders) announce(c);
  announce_machine();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
