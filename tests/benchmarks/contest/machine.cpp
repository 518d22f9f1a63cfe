#include "machine.hpp"

#include <benchmark/benchmark.h>

#include <array>

namespace dashpot::contest {
namespace {

// Sixty-four of an instruction, each waiting for the one before.
#define CHAIN(instruction) \
  [](double& value) { asm volatile(".rept 64\n\t" instruction "\n\t.endr" : "+x"(value) : "x"(1.0)); }

template <class Chain>
void announce(const char* name, Chain chain) {
  benchmark::RegisterBenchmark(name, [chain](benchmark::State& state) {
    double value = 1;
    for (auto _ : state) chain(value);
    state.counters["step"] =
        benchmark::Counter(64, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  });
}

#if defined(__AVX512F__)
#define LOAD "vmovapd (%0), %%zmm"
#define STORE "vmovapd %%zmm0, (%0)"
constexpr std::size_t width = 64;
#elif defined(__AVX2__)
#define LOAD "vmovapd (%0), %%ymm"
#define STORE "vmovapd %%ymm0, (%0)"
constexpr std::size_t width = 32;
#else
#define LOAD "movapd (%0), %%xmm"
#define STORE "movapd %%xmm0, (%0)"
constexpr std::size_t width = 16;
#endif

// 12 KiB over and over, as 512 branches read.
alignas(64) std::array<char, 12288> memory{};

void loads(benchmark::State& state) {
  for (auto _ : state)
    for (const char* place = memory.data(); place < memory.data() + memory.size(); place += 4 * width) {
      asm volatile(LOAD "0" : : "r"(place) : "xmm0");
      asm volatile(LOAD "1" : : "r"(place + width) : "xmm1");
      asm volatile(LOAD "2" : : "r"(place + 2 * width) : "xmm2");
      asm volatile(LOAD "3" : : "r"(place + 3 * width) : "xmm3");
    }
  state.counters["step"] = benchmark::Counter(
      memory.size() / width, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void stores(benchmark::State& state) {
  for (auto _ : state)
    for (char* place = memory.data(); place < memory.data() + memory.size(); place += 2 * width) {
      asm volatile(STORE : : "r"(place) : "memory");
      asm volatile(STORE : : "r"(place + width) : "memory");
    }
  state.counters["step"] = benchmark::Counter(
      memory.size() / width, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

void announce_machine() {
#if defined(__AVX2__)
  announce("machine/add", CHAIN("vaddsd %1, %0, %0"));
  announce("machine/multiply", CHAIN("vmulsd %1, %0, %0"));
  announce("machine/least", CHAIN("vminsd %1, %0, %0"));
  announce("machine/fused", CHAIN("vfmadd132sd %1, %1, %0"));
#else
  announce("machine/add", CHAIN("addsd %1, %0"));
  announce("machine/multiply", CHAIN("mulsd %1, %0"));
  announce("machine/least", CHAIN("minsd %1, %0"));
#endif
  benchmark::RegisterBenchmark("machine/load", loads);
  benchmark::RegisterBenchmark("machine/store", stores);
}

}  // namespace dashpot::contest
