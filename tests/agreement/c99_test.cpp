// What --target c99 writes is C99 and C++17 without a warning, and gives the bits that `dashpot simulate` gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "compile.hpp"
#include "emit/emission.hpp"
#include "law/evaluate.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/shell_command.hpp"
#include "support/shrink.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

constexpr int rows = 160;

struct Row {
  double position, velocity;
};

// Moves of all sizes, rests, and what is no number; as a float takes it.
std::vector<Row> motion() {
  Random random(11);
  std::vector<Row> all;
  double position = 0;
  for (int n = 0; n < rows; ++n) {
    if (n % 40 < 30) position += random.uniform(-1, 1) * random.log_uniform(1e-8, 1e-2);
    all.push_back({float(position), float(random.uniform(-1, 1) * random.log_uniform(1e-6, 1))});
    if (n % 53 == 52) all.back().position = NAN;
    if (n % 59 == 58) all.back().velocity = INFINITY;
  }
  return all;
}

// Maxwell branches enough for loops; every other time all relax slowly, so that their guards take turns.
compiler::Network many_branches(std::uint64_t seed) {
  Random random(seed);
  const bool is_slow = seed % 2 == 0;
  compiler::Network network;
  network.nodes = {"ground", "tool"};
  for (std::size_t i = 0; i < 17 + seed % 30; ++i) {
    const std::size_t inner = network.nodes.size();
    network.nodes.push_back(fmt::format("n{}", i));
    network.elements.push_back({fmt::format("K{}", i),
                                compiler::Spring{random.log_uniform(1e-2, is_slow ? 10 : 1e4)},
                                compiler::tool,
                                inner,
                                {},
                                {}});
    network.elements.push_back({fmt::format("B{}", i),
                                compiler::Damper{random.log_uniform(is_slow ? 1 : 1e-4, 1e2)},
                                inner,
                                compiler::ground,
                                {},
                                {}});
  }
  return network;
}

// Trees and graphs without slips and with one, contacts, and loops.
compiler::Network network_of(std::uint64_t seed) {
  if (seed % 8 == 0) return many_branches(seed / 8);
  NetworkRecipe recipe;
  recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
  recipe.most_nodes = 8;
  recipe.most_slips = seed % 4 == 2 ? 1 : 0;
  compiler::Network network = random_network(seed, recipe);
  if (seed % 4 == 1) network.contact = compiler::Contact{seed % 3 == 0 ? 0 : 1e-3, {}};
  return network;
}

struct Emitted {
  compiler::Compilation compilation;
  std::string header;
};

std::vector<Emitted> all_emitted(compiler::ScalarType scalar) {
  std::vector<Emitted> all;
  for (std::uint64_t seed = 1; seed <= repetitions(40, 400); ++seed) {
    compiler::Network network = network_of(seed);
    network.name = fmt::format("random_{}", seed);
    compiler::Choices choices;
    choices.scalar = scalar;
    choices.scheme = seed % 3 == 0 ? compiler::Scheme::backward_euler : compiler::Scheme::exact;
    compiler::StageTimes times;
    compiler::Diagnostics diagnostics;
    auto compilation = compiler::compile(std::move(network), choices, std::nullopt, diagnostics, times);
    if (!compilation) throw std::runtime_error(compiler::render_text(diagnostics));
    const auto files = compiler::emit_c99(*compilation, {}, diagnostics);
    if (!files) throw std::runtime_error(compiler::render_text(diagnostics));
    all.push_back({std::move(*compilation), files->front().text});
  }
  return all;
}

// Each law over the motion; damping and force of every row, and the energy in the end.
std::string program_of(const std::vector<Emitted>& all) {
  std::string text = "#include <stdio.h>\n#include <stdlib.h>\n";
  for (const Emitted& one : all) text += fmt::format("#include \"{}.h\"\n", one.compilation.network.name);
  text +=
      "int main(void) {\n  double position[1000], velocity[1000];\n  int rows = 0;\n"
      "  while (scanf(\"%la %la\", &position[rows], &velocity[rows]) == 2) ++rows;\n";
  for (const Emitted& one : all)
    text += fmt::format(
        "  {{\n    {0} law;\n    {0}_reset(&law, ({1})0.002);\n    for (int n = 0; n < rows; ++n) {{\n"
        "      const dashpot_command now = {0}_step(&law, ({1})position[n], ({1})velocity[n]);\n"
        "      printf(\"%a %a\\n\", now.damping, now.force);\n    }}\n"
        "    printf(\"%a\\n\", (double){0}_stored_energy(&law));\n  }}\n",
        one.compilation.network.name, name_of(one.compilation.law.scalar));
  return text + "  return 0;\n}\n";
}

template <class... Numbers>
std::string printed(const char* format, Numbers... numbers) {
  char line[100];
  std::snprintf(line, sizeof line, format, numbers...);
  return line;
}

template <class Scalar>
std::string simulated(const compiler::UpdateLaw& law) {
  compiler::Evaluation<Scalar> run(law);
  run.reset(Scalar(0.002));
  std::string text;
  for (const Row& row : motion()) {
    const auto now = run.step(Scalar(row.position), Scalar(row.velocity));
    text += printed("%a %a\n", double(now.damping), double(now.force));
  }
  return text + printed("%a\n", double(run.stored_energy()));
}

std::string first_difference(const std::string& one, const std::string& other) {
  const auto [at, there] = std::mismatch(one.begin(), one.end(), other.begin(), other.end());
  if (at == one.end() && there == other.end()) return "";
  const auto from = std::size_t(std::max<std::ptrdiff_t>(0, at - one.begin() - 60));
  return fmt::format("line {}: {} instead of {}", std::count(one.begin(), at, '\n') + 1, one.substr(from, 120),
                     other.substr(from, 120));
}

void expect_same_bits(compiler::ScalarType scalar) {
  const std::vector<Emitted> all = all_emitted(scalar);
  const TemporaryFolder folder;
  for (const Emitted& one : all) write_text(folder.path() / (one.compilation.network.name + ".h"), one.header);
  write_text(folder.path() / "laws.c", program_of(all));
  std::string input, expected;
  for (const Row& row : motion()) input += printed("%a %a\n", row.position, row.velocity);
  write_text(folder.path() / "input", input);
  for (const Emitted& one : all)
    expected += scalar == compiler::ScalarType::float64 ? simulated<double>(one.compilation.law)
                                                        : simulated<float>(one.compilation.law);
  const char* const strict =
      "-pedantic -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Werror -O1 -ffp-contract=off";
  for (const char* compiler : {DASHPOT_GCC " -std=c99", DASHPOT_CLANG " -std=c99", DASHPOT_GXX " -x c++ -std=c++17"}) {
    const Finished done = run_command(fmt::format("cd '{}' && {} {} -I'{}' laws.c -o laws && ./laws < input",
                                                  folder.path().string(), compiler, strict, DASHPOT_RUNTIME_INCLUDE));
    ASSERT_EQ(done.status, 0) << compiler << "\n" << done.output.substr(0, 4000);
    EXPECT_EQ(first_difference(done.output, expected), "") << compiler;
  }
}

// Fails if a header in C does not compile where the strictest read it, or a bit differs from what is simulated.
TEST(C99, AgreesInDouble) { expect_same_bits(compiler::ScalarType::float64); }

// Fails likewise in float.
TEST(C99, AgreesInFloat) { expect_same_bits(compiler::ScalarType::float32); }

}  // namespace
}  // namespace dashpot::testing
