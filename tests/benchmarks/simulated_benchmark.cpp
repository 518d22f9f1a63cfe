// How much faster than real time the simulated device runs: an arm with everything that a real one has, at 10 kHz, led
// by a hand against an end stop. Processor time of one thread, so that it does not depend on how busy the machine is.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include <dashpot/simulated/simulated_device.hpp>

#include "plain_device.hpp"

namespace {

using namespace dashpot;
using namespace dashpot::simulated;

constexpr double duration = 1;  // [s]

scenario lively_scene() {
  scenario scene;
  scene.user = firm_hand();
  scene.intended = smoothly_through({{0, 0}, {0.2, 0.03}, {0.5, -0.02}, {0.8, 0.015}});
  scene.high = end_stop{0.02, 3000, 4};
  return scene;
}

// A motor that swings and a brake that rises and falls: one second of commands.
std::vector<actuation> commands(double sample_period) {
  std::vector<actuation> all;
  for (double time = 0; time < duration; time += sample_period) {
    all.push_back({0.02 * std::sin(80 * time), 3e-3 + 3e-3 * std::sin(50 * time)});
  }
  return all;
}

void one_second(benchmark::State& state, const scenario& scene) {
  const device_description arm = imperfect_arm();
  const std::vector<actuation> demands = commands(arm.loop.sample_period);
  device_sample sample;
  for (auto _ : state) {
    simulated_device device(arm, scene);
    for (const actuation& demand : demands) {
      device.read(sample);
      device.write(demand);
    }
    benchmark::DoNotOptimize(sample);
  }
  state.counters["times_real_time"] =
      benchmark::Counter(duration * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

BENCHMARK_CAPTURE(one_second, simulated_arm_with_hand, lively_scene())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(one_second, simulated_arm_alone, scenario())->Unit(benchmark::kMillisecond);

}  // namespace
