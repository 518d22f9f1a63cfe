// Emitted laws with tunable parameters: the bits of evaluate(), and what a board without a standard library asks of
// them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "emit/emission.hpp"
#include "support/shell_command.hpp"
#include "support/shrink.hpp"
#include "support/tunable_run.hpp"

namespace dashpot::testing {
namespace {

namespace fs = std::filesystem;

constexpr double emitted_period = 1e-3;  // [s]

struct Sample {
  double position, velocity;
  bool sets;
  std::vector<double> values;
};

std::vector<Sample> schedule(const std::vector<compiler::Tunable>& tunables, std::vector<double> values,
                             std::uint64_t seed) {
  Random random(seed);
  std::vector<Sample> samples;
  double last = 0;
  for (double position : random_walk(random, 250)) {
    const bool sets = random.chance(0.3);
    if (sets) values = next_values(tunables, values, random);
    std::vector<double> given = values;
    if (sets && random.chance(0.1))
      given[random.index(given.size())] = random.chance(0.5) ? std::numeric_limits<double>::quiet_NaN() : 1e30;
    samples.push_back({random.chance(0.02) ? std::numeric_limits<double>::infinity() : position,
                       (position - last) / emitted_period, sets, given});
    last = position;
  }
  return samples;
}

template <class Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string bytes_of(const std::vector<Sample>& samples) {
  std::string bytes;
  for (const Sample& sample : samples) {
    append(bytes, sample.position), append(bytes, sample.velocity), append(bytes, sample.sets ? 1.0 : 0.0);
    for (double value : sample.values) append(bytes, value);
  }
  return bytes;
}

template <class Scalar>
std::string evaluated(const compiler::UpdateLaw& law, const std::vector<Sample>& samples) {
  compiler::Evaluation<Scalar> run(law);
  run.reset(0);
  std::string bytes;
  for (const Sample& sample : samples) {
    const unsigned clamped = sample.sets ? run.set({sample.values.begin(), sample.values.end()}) : 0;
    const auto now = run.step(static_cast<Scalar>(sample.position), static_cast<Scalar>(sample.velocity));
    append(bytes, double(now.damping)), append(bytes, double(now.force)), append(bytes, double(run.stored_energy())),
        append(bytes, double(clamped));
  }
  return bytes;
}

const char* const decompositions[] = {"paper",         "zero-frequency",   "quietest-passive",
                                      "velocity-free", "largest-observer", "virtual"};

TunableLaw law_of(std::uint64_t seed) {
  compiler::Choices choices;
  choices.scheme = seed % 3 == 0 ? compiler::Scheme::backward_euler : compiler::Scheme::exact;
  choices.scalar = seed % 4 == 0 ? compiler::ScalarType::float32 : compiler::ScalarType::float64;
  choices.decomposition = decompositions[seed % std::size(decompositions)];
  choices.state_input = compiler::StateInput::position;
  return TunableLaw(tunable_network(seed, Kind((seed % 4 == 0 ? seed / 4 : seed - seed / 4) % kinds)), choices);
}

void emit(const TunableLaw& law, const fs::path& folder) {
  compiler::Diagnostics diagnostics;
  const auto files = compiler::emit_cpp(law.compilation(), {}, diagnostics);
  ASSERT_TRUE(files);
  for (const compiler::OutputFile& file : *files) write_text(folder / file.name, file.text);
}

void run_or_fail(const std::string& line) {
  const Finished finished = run_command(line);
  ASSERT_TRUE(finished.status == 0 && finished.output.empty()) << line << "\n" << finished.output.substr(0, 4000);
}

const char* const strict =
    "-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion "
    "-Wsign-conversion -Wold-style-cast -Wdouble-promotion -Wfloat-conversion -Wshadow -Wvla -Walloca -Werror";

// If this failed, what `simulate` shows would not be what runs in the loop.
TEST(TunableEmission, HasTheBitsOfEvaluate) {
  const TemporaryFolder folder;
  const std::uint64_t count = repetitions(20, 400);
  std::string includes = "#include \"emitted_driver.hpp\"\n", calls;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const TunableLaw law = law_of(seed);
    emit(law, folder.path());
    write_text(folder.path() / fmt::format("{}.in", seed), bytes_of(schedule(law.tunables(), law.defaults(), seed)));
    includes += fmt::format("#include \"tunable_{}.hpp\"\n", seed);
    calls += fmt::format("  tunables::run<dashpot::generated::tunable_{0}, {1}>(\"{2}/{0}.in\", \"{2}/{0}.out\");\n",
                         seed, law.tunables().size(), folder.path().string());
  }
  write_text(folder.path() / "run.cpp", includes + "int main() {\n" + calls + "}\n");
  run_or_fail(
      fmt::format("'{0}' -std=c++17 -O1 -ffp-contract=off -I'{1}' -I'{2}' '{3}/run.cpp' -o '{3}/run' && '{3}/run'",
                  DASHPOT_GXX, DASHPOT_RUNTIME_INCLUDE, DASHPOT_DRIVER, folder.path().string()));
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const TunableLaw law = law_of(seed);
    const auto samples = schedule(law.tunables(), law.defaults(), seed);
    const bool is_double = law.law().scalar == compiler::ScalarType::float64;
    const std::string expected =
        is_double ? evaluated<double>(law.law(), samples) : evaluated<float>(law.law(), samples);
    const std::string emitted = text_of(folder.path() / fmt::format("{}.out", seed));
    ASSERT_EQ(emitted.size(), expected.size());
    EXPECT_EQ(std::memcmp(emitted.data(), expected.data(), expected.size()), 0) << "seed " << seed;
  }
}

// If this failed, a board would lack what the code asks for, or a global object would be made before main().
TEST(TunableEmission, CompilesStrictlyAndLeavesNoSymbolUndefined) {
  const TemporaryFolder folder;
  std::string source;
  for (std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 24, 28}) {
    emit(law_of(seed), folder.path());
    source += fmt::format(
        "#include \"tunable_{0}.hpp\"\nstatic dashpot::generated::tunable_{0} law_{0};\n"
        "double step_{0}(double u, double v) {{ return "
        "static_cast<double>(law_{0}.step(static_cast<decltype(law_{0})::scalar>(u), "
        "static_cast<decltype(law_{0})::scalar>(v)).force); }}\n"
        "unsigned set_{0}(const dashpot::generated::tunable_{0}::parameters& p) {{ return law_{0}.set(p); }}\n"
        "void reset_{0}() {{ law_{0}.reset(0); }}\n"
        "double energy_{0}() {{ return static_cast<double>(law_{0}.stored_energy()); }}\n",
        seed);
  }
  const fs::path caller = folder.path() / "caller.cpp", object = folder.path() / "caller.o";
  write_text(caller, source);
  for (const char* compiler : {DASHPOT_GXX, DASHPOT_CLANGXX})
    for (const char* level : {"-O0", "-O2", "-O3"}) {
      const bool is_usual = compiler == std::string(DASHPOT_GXX) || level == std::string("-O2");
      if (!is_usual && !is_thorough()) continue;
      run_or_fail(fmt::format("'{}' {} {} -Wno-missing-declarations -c '{}' -o '{}' -I'{}' -I'{}'", compiler, strict,
                              level, caller.string(), object.string(), DASHPOT_RUNTIME_INCLUDE,
                              folder.path().string()));
      EXPECT_EQ(run_command(fmt::format("nm -C -u '{}'", object.string())).output, "") << compiler << " " << level;
      EXPECT_EQ(run_command(fmt::format("nm -C '{}' | grep -c GLOBAL__sub_I", object.string())).output, "0\n")
          << compiler << " " << level;
    }
}

// If this failed, a global law would be made while the program starts, after others that use it: no division by zero is
// a constant. All kinds, and a branch whose damper is nothing to begin with.
TEST(TunableEmission, IsMadeByConstantsAlone) {
  const TemporaryFolder folder;
  const char* const nothing = R"({ "dashpot": 1, "name": "tunable_0",
    "parameters": { "B": { "value": 0, "tunable": true, "min": 0, "max": 5 } },
    "network": { "parallel": [ { "spring": 3 }, { "series": [ { "spring": 10 }, { "damper": "B" } ] } ] } })";
  std::string source =
      "#ifdef __clang__\n#define CONSTANT [[clang::require_constant_initialization]]\n#else\n#define CONSTANT "
      "__constinit\n#endif\n";
  for (std::uint64_t seed = 0; seed <= 18; ++seed) {
    emit(seed == 0 ? TunableLaw(nothing) : TunableLaw(tunable_network(seed, Kind(seed % kinds))), folder.path());
    source += fmt::format("#include \"tunable_{0}.hpp\"\nCONSTANT dashpot::generated::tunable_{0} law_{0};\n", seed);
  }
  write_text(folder.path() / "globals.cpp", source);
  for (const char* compiler : {DASHPOT_GXX, DASHPOT_CLANGXX})
    run_or_fail(fmt::format("'{}' -std=c++17 -fsyntax-only -I'{}' -I'{}' '{}/globals.cpp'", compiler,
                            DASHPOT_RUNTIME_INCLUDE, folder.path().string(), folder.path().string()));
}

// If this failed, a step would take as long as a processor's division, which on a board is a call.
TEST(TunableEmission, DividesOnlyInSetAndReset) {
  const TemporaryFolder folder;
  std::string source;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const TunableLaw law(tunable_network(seed, Kind(seed % 3)));
    emit(law, folder.path());
    source += fmt::format(
        "#include \"tunable_{0}.hpp\"\n"
        "double step(dashpot::generated::tunable_{0}& law, double u, double v) {{ return law.step(u, v).force; }}\n"
        "double energy(const dashpot::generated::tunable_{0}& law) {{ return law.stored_energy(); }}\n",
        seed);
  }
  write_text(folder.path() / "caller.cpp", source);
  run_or_fail(fmt::format("'{0}' {1} -O2 -c '{2}/caller.cpp' -o '{2}/caller.o' -I'{3}' -I'{2}'", DASHPOT_GXX, strict,
                          folder.path().string(), DASHPOT_RUNTIME_INCLUDE));
  const std::string disassembly = run_command(fmt::format("objdump -d '{}/caller.o'", folder.path().string())).output;
  EXPECT_NE(disassembly.find("mulsd"), disassembly.npos);
  const std::size_t division = disassembly.find("div");
  EXPECT_EQ(division, disassembly.npos) << disassembly.substr(division == disassembly.npos ? 0 : division - 200, 300);
}

}  // namespace
}  // namespace dashpot::testing
