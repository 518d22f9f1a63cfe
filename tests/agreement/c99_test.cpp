// What --target c99 writes is C99 and C++17 without a warning, and gives the bits that `dashpot simulate` gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "compile.hpp"
#include "emit/emission.hpp"
#include "law/evaluate.hpp"
#include "network/device.hpp"
#include "source/render.hpp"
#include "support/random.hpp"
#include "support/random_network.hpp"
#include "support/shell_command.hpp"
#include "support/shrink.hpp"
#include "support/tunable_run.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

constexpr int rows = 160;

struct Row {
  double position, velocity;
};

// Moves of all sizes, rests, NaN and infinity; as a float takes it.
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

// Trees and graphs without slips, with one and with several that meet at inner nodes, contacts, and loops.
compiler::Network network_of(std::uint64_t seed) {
  if (seed % 8 == 0) return many_branches(seed / 8);
  NetworkRecipe recipe;
  recipe.topology = seed % 2 == 0 ? Topology::tree : Topology::graph;
  recipe.most_nodes = 8;
  recipe.most_slips = seed % 4 == 2 ? 1 : seed % 4 == 3 ? 4 : seed % 8 == 4 ? 6 : 0;
  compiler::Network network = random_network(seed, recipe);
  if (seed % 4 == 1 || seed % 16 == 3 || seed % 16 == 12)
    network.contact = compiler::Contact{1e-3 * (double(seed % 3) - 1), {}};
  return network;
}

struct Emitted {
  compiler::Compilation compilation;
  std::string header;
  std::vector<std::vector<double>> schedule;  // values of parameters before every row, where there are any

  const std::string& name() const { return compilation.network.name; }
  std::size_t parameters() const { return compilation.law.parameters().size(); }
};

// A motor that gives little of what is asked for, so that laws shed, and a brake that takes its time.
std::optional<compiler::Device> weak_device(bool has_slew) {
  const compiler::SourceFile file("weak.json",
                                  fmt::format(R"({{ "dashpot_device": 1, "name": "weak", "motion": "translation",
                                     "loop": {{ "rate": 1000 }}, "encoder": {{ "resolution": 1e-3 }},
                                     "motor": {{ "max_torque": 0.05{} }},
                                     "brake": {{ "kind": "eddy_current", "max_damping": 40, "coil_lag": 0.002 }},
                                     "velocity": {{ "estimator": "backward_difference", "window": 1 }} }})",
                                              has_slew ? R"(, "slew": 20)" : ""));
  compiler::Diagnostics diagnostics;
  const auto decl = compiler::parse_device(file, diagnostics);
  auto device = decl ? compiler::build_device(*decl, diagnostics) : std::nullopt;
  if (!device) throw std::runtime_error(compiler::render_text(diagnostics));
  return device;
}

// Steps within the ranges and beyond them, and now and then NaN or infinity.
std::vector<std::vector<double>> schedule_of(const compiler::UpdateLaw& law, std::uint64_t seed) {
  if (!law.tunable) return {};
  Random random(seed);
  const std::vector<compiler::Tunable>& tunables = law.tunable->tunables;
  std::vector<double> values;
  for (const compiler::Tunable& tunable : tunables) values.push_back(tunable.range.value);
  std::vector<std::vector<double>> schedule;
  for (int n = 0; n < rows; ++n) {
    if (random.chance(0.3)) values = next_values(tunables, values, random);
    schedule.push_back(values);
    if (n % 17 == 16) schedule.back()[0] = n % 2 == 0 ? double(NAN) : 2 * tunables[0].range.max;
    for (double& value : schedule.back()) value = float(value);
  }
  return schedule;
}

compiler::Choices choices_for(compiler::ScalarType scalar, std::uint64_t seed, bool is_limited) {
  compiler::Choices choices;
  choices.scalar = scalar;
  choices.scheme = seed % 3 == 0 ? compiler::Scheme::backward_euler : compiler::Scheme::exact;
  if (is_limited) choices.decomposition = "paper";
  return choices;
}

// In C; refuses, by an exception, what was not compiled.
Emitted emitted(std::optional<compiler::Compilation> compilation, compiler::Diagnostics& diagnostics,
                std::vector<std::vector<double>> schedule) {
  if (!compilation) throw std::runtime_error(compiler::render_text(diagnostics));
  const auto files = compiler::emit_c99(*compilation, {}, diagnostics);
  if (!files) throw std::runtime_error(compiler::render_text(diagnostics));
  return {std::move(*compilation), files->front().text, std::move(schedule)};
}

Emitted emitted(const compiler::SourceFile& source, compiler::ScalarType scalar, std::uint64_t seed,
                const std::string& name) {
  const bool is_limited = seed % 2 == 0;
  const compiler::Choices choices = choices_for(scalar, seed, is_limited);
  compiler::Diagnostics diagnostics;
  auto compilation =
      compiler::compile(source, choices, is_limited ? weak_device(seed % 4 == 0) : std::nullopt, diagnostics);
  if (!compilation) throw std::runtime_error(compiler::render_text(diagnostics));
  compilation->network.name = name;
  auto schedule = schedule_of(compilation->law, seed);
  return emitted(std::move(compilation), diagnostics, std::move(schedule));
}

Emitted emitted(compiler::Network network, compiler::ScalarType scalar, std::uint64_t seed) {
  network.name = fmt::format("random_{}", seed);
  const bool is_limited = seed % 5 == 0;
  const compiler::Choices choices = choices_for(scalar, seed, is_limited);
  compiler::StageTimes times;
  compiler::Diagnostics diagnostics;
  auto compilation = compiler::compile(std::move(network), choices,
                                       is_limited ? weak_device(seed % 2 == 0) : std::nullopt, diagnostics, times);
  return emitted(std::move(compilation), diagnostics, {});
}

// The networks of one axis that dashpot ships, without the measured ones: those are many more of the same kinds.
std::vector<fs::path> network_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(DASHPOT_NETWORKS)) {
    const std::string path = entry.path().generic_string();
    if (path.ends_with(".json") && !path.ends_with("schema.json") && path.find("/measured/") == path.npos &&
        path.find("/axes/") == path.npos)
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Behind a static curve springs let go of what they cannot hold.
const char* const curved = R"({ "dashpot": 1, "name": "curved",
  "static": { "power": 1.5, "force": "2 N", "at": "5 mm" },
  "parameters": { "K": { "value": 300, "tunable": true, "min": 0, "max": 2000 },
                  "k1": { "value": 200, "tunable": true, "min": 10, "max": 900 },
                  "B": { "value": 5, "tunable": true, "min": 0, "max": 50 },
                  "Y": { "value": 0.3, "tunable": true, "min": 0.1, "max": 1 } },
  "network": { "parallel": [ { "spring": "K" }, { "series": [ { "spring": "k1" }, { "damper": "B" } ] },
                             { "series": [ { "spring": 150 }, { "slip": "Y" } ] } ] } })";

std::vector<Emitted> all_emitted(compiler::ScalarType scalar) {
  std::vector<Emitted> all;
  for (std::uint64_t seed = 1; seed <= repetitions(12, 400); ++seed)
    all.push_back(emitted(network_of(seed), scalar, seed));
  for (std::uint64_t seed = 1; seed <= repetitions(16, 320); ++seed) {
    const compiler::SourceFile source("tunable.json", tunable_network(seed, Kind((seed + seed / 8) % kinds)));
    all.push_back(emitted(source, scalar, seed, fmt::format("tunable_{}", seed)));
  }
  for (const std::uint64_t seed : {1u, 2u, 4u})
    all.push_back(emitted(compiler::SourceFile("curved.json", curved), scalar, seed, fmt::format("curved_{}", seed)));
  for (const fs::path& file : network_files()) {
    const compiler::SourceFile source(file.string(), text_of(file));
    all.push_back(emitted(source, scalar, 1, file.stem().string()));
  }
  return all;
}

// The position given to reset() [m]; for about half of the laws a NaN.
double start_of(const Emitted& one) { return one.name().size() % 2 == 0 ? 0.002 : double(NAN); }

// Each law over the motion; damping, force and kept share of every row, what set() said before, and the energy in the
// end.
std::string program_of(const std::vector<Emitted>& all) {
  std::string text = "#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n";
  for (const Emitted& one : all) text += fmt::format("#include \"{}.h\"\n", one.name());
  text +=
      "int main(void) {\n  double position[1000], velocity[1000];\n  int rows = 0;\n"
      "  while (scanf(\"%la %la\", &position[rows], &velocity[rows]) == 2) ++rows;\n"
      "  if (scanf(\" values\") != 0) return 1;\n";
  for (const Emitted& one : all) {
    const auto& law = one.compilation.law;
    text += fmt::format(
        "  {{\n    {0} law;\n    {0}_init(&law);\n    {0}_reset(&law, ({1})strtod(\"{2}\", NULL));\n"
        "    for (int n = 0; n < rows; ++n) {{\n",
        one.name(), name_of(law.scalar), start_of(one));
    if (one.parameters() > 0)
      text += fmt::format(
          "      {1} values[{2}];\n      for (int i = 0; i < {0}_parameter_count(); ++i) {{\n"
          "        double value;\n        if (scanf(\"%la\", &value) != 1) return 1;\n"
          "        values[i] = ({1})value;\n      }}\n"
          "      {0}_parameters wanted = {0}_parameters_at_first();\n"
          "      memcpy(&wanted, values, sizeof wanted);\n"
          "      printf(\"%x\\n\", n % 2 == 0 ? {0}_set(&law, &wanted) : {0}_set_values(&law, values));\n",
          one.name(), name_of(law.scalar), one.parameters());
    text += fmt::format(
        "      const dashpot_command now = {0}_step(&law, ({1})position[n], ({1})velocity[n]);\n"
        "      printf(\"%a %a %a\\n\", now.damping, now.force, (double){0}_kept_share(&law));\n    }}\n"
        "    printf(\"%a\\n\", (double){0}_stored_energy(&law));\n  }}\n",
        one.name(), name_of(law.scalar));
  }
  return text + "  return 0;\n}\n";
}

template <class... Numbers>
std::string printed(const char* format, Numbers... numbers) {
  char line[100];
  std::snprintf(line, sizeof line, format, numbers...);
  return line;
}

template <class Scalar>
std::string simulated(const Emitted& one) {
  compiler::Evaluation<Scalar> run(one.compilation.law);
  run.reset(Scalar(start_of(one)));
  std::string text;
  std::size_t n = 0;
  for (const Row& row : motion()) {
    if (one.parameters() > 0) {
      const std::vector<double>& wanted = one.schedule[n++];
      text += printed("%x\n", run.set(std::vector<Scalar>(wanted.begin(), wanted.end())));
    }
    const auto now = run.step(Scalar(row.position), Scalar(row.velocity));
    text += printed("%a %a %a\n", double(now.damping), double(now.force), double(run.kept_share()));
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

// Fails if none of these headers has one of the parts that only some laws have.
void expect_all_parts(const std::vector<Emitted>& all) {
  for (const char* part :
       {"_tree_step(", "_tree_push(", "_network_step(", "_mean_decay(", "_square_root(", "_take_value(",
        // What parameters change: meshes, their viscosity, regimes in trees and outside, slides that are remembered, a
        // motor's limit and step, dents, and what the static spring makes up for.
        "_port_share", "_slow_next", " now_coupled_", "_is_with_", "self->sampled_", "_slid_at", "motor_limit",
        "self->last_command", "self->dent", "missing_force"})
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Emitted& one) {
      return one.header.find(part) != std::string::npos;
    })) << part;
}

void expect_same_bits(compiler::ScalarType scalar) {
  const std::vector<Emitted> all = all_emitted(scalar);
  expect_all_parts(all);
  const TemporaryFolder folder;
  for (const Emitted& one : all) write_text(folder.path() / (one.name() + ".h"), one.header);
  write_text(folder.path() / "laws.c", program_of(all));
  std::string input, expected;
  for (const Row& row : motion()) input += printed("%a %a\n", row.position, row.velocity);
  input += "values\n";
  for (const Emitted& one : all)
    for (const std::vector<double>& values : one.schedule)
      for (const double value : values) input += printed("%a\n", value);
  write_text(folder.path() / "input", input);
  for (const Emitted& one : all)
    expected += scalar == compiler::ScalarType::float64 ? simulated<double>(one) : simulated<float>(one);
  const char* const strict =
      "-pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion -Werror -O1 "
      "-ffp-contract=off";
  const auto finished = [&](const char* compiler, const char* and_then) {
    const Finished done =
        run_command(fmt::format("cd '{}' && {} {} laws.c {}", folder.path().string(), compiler, strict, and_then));
    EXPECT_EQ(done.status, 0) << compiler << "\n" << done.output.substr(0, 4000);
    return done.output;
  };
  const char* const run = "-o laws && ./laws < input";
  const char* const gcc = DASHPOT_GCC " -std=c99";
  const char* const clang = DASHPOT_CLANG " -std=c99";
  // In float the code is the same, with other numbers.
  std::vector<const char*> compilers{scalar == compiler::ScalarType::float64 ? gcc : clang};
  if (is_thorough()) compilers = {gcc, clang};
  for (const char* compiler : compilers) EXPECT_EQ(first_difference(finished(compiler, run), expected), "") << compiler;
  // Only the reading of the text differs in C++; the code is gcc's as before.
  const char* const as_cpp = DASHPOT_GXX " -x c++ -std=c++17";
  if (is_thorough()) EXPECT_EQ(first_difference(finished(as_cpp, run), expected), "") << as_cpp;
  else finished(as_cpp, "-fsyntax-only");
}

// Fails if a header in C does not compile under the strictest warnings, or a bit differs from what is simulated.
TEST(C99, AgreesInDouble) { expect_same_bits(compiler::ScalarType::float64); }

// Fails likewise in float.
TEST(C99, AgreesInFloat) { expect_same_bits(compiler::ScalarType::float32); }

// What the object file of a law would be linked with.
std::string undefined_symbols(const Emitted& one, const std::string& compiler) {
  const TemporaryFolder folder;
  write_text(folder.path() / "law.h", one.header);
  std::string text = fmt::format(
      "#include \"law.h\"\nvoid begin({0} *law) {{ {0}_init(law); {0}_reset(law, 0); }}\n"
      "dashpot_command first({0} *law, {1} u, {1} v) {{ return {0}_output(law, u, v); }}\n"
      "void then({0} *law) {{ {0}_update(law); }}\n"
      "dashpot_command both({0} *law, {1} u, {1} v) {{ return {0}_step(law, u, v); }}\n"
      "unsigned set({0} *law, const {1} *values) {{ return {0}_set_values(law, values); }}\n"
      "{1} energy(const {0} *law) {{ return {0}_stored_energy(law) + {0}_kept_share(law); }}\n",
      one.name(), name_of(one.compilation.law.scalar));
  write_text(folder.path() / "law.c", text);
  const Finished done = run_command(fmt::format(
      "cd '{}' && {} -std=c99 -O2 -fno-stack-protector -c law.c && nm -u law.o | awk '{{ print $2 }}' | sort -u",
      folder.path().string(), compiler));
  return done.status == 0 ? done.output : "does not compile: " + done.output;
}

// Fails if a law in C needs a library.
TEST(C99, NeedsNothingButToCopyAndToClear) {
  const std::vector<Emitted> all = all_emitted(compiler::ScalarType::float64);
  for (std::size_t i = 0; i < all.size(); i += 6)
    for (const char* compiler : {DASHPOT_GCC, DASHPOT_CLANG}) {
      std::string left = undefined_symbols(all[i], compiler);
      for (const char* known : {"memcpy\n", "memmove\n", "memset\n"})
        if (const std::size_t at = left.find(known); at != left.npos) left.erase(at, std::string(known).size());
      EXPECT_EQ(left, "") << all[i].name() << " by " << compiler;
    }
}

}  // namespace
}  // namespace dashpot::testing
