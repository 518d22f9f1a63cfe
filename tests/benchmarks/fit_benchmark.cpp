// Fits of the committed recordings, each beside non-negative least squares alone on the same columns: the ratio says
// what choosing few elements costs.
#include <benchmark/benchmark.h>

#include <chrono>

#include "fit/fit.hpp"
#include "fit/floor.hpp"
#include "unit/fit/recordings.hpp"

namespace {

using namespace dashpot::compiler;
using namespace dashpot::compiler::fitting;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void fit_of(benchmark::State& state, const std::vector<Recording>& files, const FitChoices& choices) {
  double whole = 0, alone = 0;
  for ([[maybe_unused]] auto _ : state) {
    const Problem problem(files, choices.form, choices.weighting, 1'000'000);
    std::vector<Term> terms = plain_terms(problem);
    for (const double time : even_grid(resolved_times(problem), 8)) terms.push_back({TermKind::maxwell, time, 0, 0, 0});
    alone += seconds([&] { benchmark::DoNotOptimize(solve_weights(problem, terms, {})); });
    whole += seconds([&] {
      Diagnostics diagnostics;
      benchmark::DoNotOptimize(fit(files, {}, choices, diagnostics));
    });
  }
  state.counters["over_least_squares"] = whole / alone;
  state.counters["seconds"] = whole / static_cast<double>(state.iterations());
}

void titin_muscle(benchmark::State& state) { fit_of(state, titin(), {}); }

void adhesive_with_slips(benchmark::State& state) {
  FitChoices choices;
  choices.reduction.slips = SlipChoice::stops;
  fit_of(state, adhesive(), choices);
}

void master_curve_of_31_terms(benchmark::State& state) {
  FitChoices choices;
  choices.reduction.modes = 31;
  fit_of(state, recordings({"polymer/time_user_master.csv"}, {"", "column:area=1m^2,length=1m", true, true}), choices);
}

BENCHMARK(titin_muscle)->Unit(benchmark::kMillisecond);
BENCHMARK(adhesive_with_slips)->Unit(benchmark::kMillisecond);
BENCHMARK(master_curve_of_31_terms)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace

BENCHMARK_MAIN();
