// The whole command as a shell starts it: wall time, processor time and the memory that it needed.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <stdexcept>

#include "support/random_network.hpp"
#include "support/shell_command.hpp"

namespace {

using dashpot::testing::TemporaryFolder;

std::string branches(int count) {
  std::string text = R"({ "dashpot": 1, "name": "branches", "network": { "parallel": [ { "spring": 5 })";
  for (int i = 1; i <= count; ++i)
    text += fmt::format(R"(, {{ "series": [ {{ "damper": {} }}, {{ "spring": 12 }} ] }})", i / 8.0);
  return text + " ] } }";
}

std::string graph_of_100_nodes() {
  dashpot::testing::NetworkRecipe recipe;
  recipe.topology = dashpot::testing::Topology::graph;
  recipe.most_nodes = 100;
  for (std::uint64_t seed = 1;; ++seed)
    if (const auto network = dashpot::testing::random_network(seed, recipe); network.nodes.size() == 100)
      return dashpot::testing::json_text(network);
}

struct Usage {
  double wall;       // [s]
  double processor;  // [s]
  double memory;     // [MB]
};

Usage run(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  if (::posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
    throw std::runtime_error("cannot start " + words[0]);
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  if (status != 0) throw std::runtime_error(words[0] + " failed");
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
          seconds(used.ru_utime) + seconds(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024};
}

void command(benchmark::State& state, const char* verb, const std::string& network) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "network.json").string();
  dashpot::testing::write_text(file, network);
  std::vector<std::string> words = {DASHPOT_EXECUTABLE, verb, file};
  if (std::string(verb) == "compile") words.insert(words.end(), {"-o", folder.path().string()});
  Usage sum{0, 0, 0};
  for (auto _ : state) {
    const Usage used = run(words);
    state.SetIterationTime(used.wall);
    sum.processor += used.processor;
    sum.memory = std::max(sum.memory, used.memory);
  }
  state.counters["processor_ms"] = 1000 * sum.processor / static_cast<double>(state.iterations());
  state.counters["memory_MB"] = sum.memory;
}

void prepare(benchmark::internal::Benchmark* b) { b->UseManualTime()->Unit(benchmark::kMillisecond); }

BENCHMARK_CAPTURE(command, compile_fig_5, "compile", dashpot::testing::text_of(DASHPOT_FIG_5))->Apply(prepare);
BENCHMARK_CAPTURE(command, compile_1000_branches, "compile", branches(1000))->Apply(prepare);
BENCHMARK_CAPTURE(command, compile_100_node_graph, "compile", graph_of_100_nodes())->Apply(prepare);

}  // namespace
