// The stages of the compiler over the size of the network: 1 to 1,000 Maxwell branches, random graphs of 10 to 100
// nodes.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>

#include "compile.hpp"
#include "linear/linear_form.hpp"
#include "support/random_network.hpp"

namespace {

using namespace dashpot::compiler;

std::string branches(std::int64_t count) {
  std::string text = R"({ "dashpot": 1, "name": "branches", "network": { "parallel": [ { "spring": 5 })";
  for (std::int64_t i = 1; i <= count; ++i)
    text += fmt::format(R"(, {{ "series": [ {{ "damper": {} }}, {{ "spring": 12 }} ] }})", static_cast<double>(i) / 8);
  return text + " ] } }";
}

// The first random graph of that very size.
std::string graph(std::int64_t nodes) {
  dashpot::testing::NetworkRecipe recipe;
  recipe.topology = dashpot::testing::Topology::graph;
  recipe.most_nodes = static_cast<std::size_t>(nodes);
  for (std::uint64_t seed = 1;; ++seed)
    if (const Network network = dashpot::testing::random_network(seed, recipe);
        network.nodes.size() == recipe.most_nodes)
      return dashpot::testing::json_text(network);
}

using Text = std::string (*)(std::int64_t);

Network checked(const SourceFile& file) {
  Diagnostics diagnostics;
  return check(file, diagnostics).value();
}

void front_end(benchmark::State& state, Text text) {
  const SourceFile file("network.json", text(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(checked(file));
}

void linear(benchmark::State& state, Text text) {
  const SourceFile file("network.json", text(state.range(0)));
  const Network network = checked(file);
  for (auto _ : state) benchmark::DoNotOptimize(linear_form(network));
}

void kelvin(benchmark::State& state, Text text) {
  const SourceFile file("network.json", text(state.range(0)));
  const LinearForm form = linear_form(checked(file));
  for (auto _ : state) benchmark::DoNotOptimize(kelvin_form(form));
}

void whole(benchmark::State& state, Text text) {
  const SourceFile file("network.json", text(state.range(0)));
  for (auto _ : state) {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(compile(file, {}, std::nullopt, diagnostics).value());
  }
}

void emission(benchmark::State& state, Text text) {
  const SourceFile file("network.json", text(state.range(0)));
  Diagnostics diagnostics;
  const Compilation compilation = compile(file, {}, std::nullopt, diagnostics).value();
  for (auto _ : state) benchmark::DoNotOptimize(emit_cpp(compilation, {}, diagnostics).value());
}

void with_branches(benchmark::internal::Benchmark* b) {
  b->RangeMultiplier(10)->Range(1, 1000)->Unit(benchmark::kMillisecond);
}
void with_graphs(benchmark::internal::Benchmark* b) { b->Arg(10)->Arg(30)->Arg(100)->Unit(benchmark::kMillisecond); }

BENCHMARK_CAPTURE(front_end, branches, branches)->Apply(with_branches);
BENCHMARK_CAPTURE(linear, branches, branches)->Apply(with_branches);
BENCHMARK_CAPTURE(kelvin, branches, branches)->Apply(with_branches);
BENCHMARK_CAPTURE(emission, branches, branches)->Apply(with_branches);
BENCHMARK_CAPTURE(whole, branches, branches)->Apply(with_branches);
BENCHMARK_CAPTURE(front_end, graph, graph)->Apply(with_graphs);
BENCHMARK_CAPTURE(linear, graph, graph)->Apply(with_graphs);
BENCHMARK_CAPTURE(kelvin, graph, graph)->Apply(with_graphs);
BENCHMARK_CAPTURE(whole, graph, graph)->Apply(with_graphs);

}  // namespace
