// Emitted headers go into other people's programs, also those without a standard library: they compile there without a
// word, and ask for nothing that is not there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "emitted_headers.hpp"
#include "support/repetitions.hpp"

namespace dashpot::testing {
namespace {

const char* const strict =
    "-std=c++17 -ffreestanding -fno-exceptions -fno-rtti -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion "
    "-Wsign-conversion -Wold-style-cast -Wdouble-promotion -Wfloat-conversion -Wshadow -Wvla -Walloca -Werror";

struct Compiler {
  const char* name;
  const char* path;
  const char* flags;  // that this compiler alone has
};
const Compiler compilers[] = {{"gcc", DASHPOT_GXX, "-Wstack-usage=64"}, {"clang", DASHPOT_CLANGXX, ""}};

struct Choice {
  const char* name;
  const char* options;
};
const Choice choices[] = {
    {"exact", "--batch"},
    {"constant_time", "--constant-time --vector none"},
    {"velocity", "--state-input velocity"},
    {"nodal", "--scheme backward-euler --state-input nodal"},
    {"compensated", "--rate 1000000"},
    {"float_delta", "--scalar float"},
    {"float_compensated", "--scalar float --scheme backward-euler --state-input nodal --rate 1000000"},
};

// All levels of optimisation by both compilers for the first of the choices; for the others the one that most programs
// are built with, by one compiler and the other in turn. All of it in a thorough run.
std::vector<std::string> levels_for(std::size_t choice, std::size_t compiler) {
  if (choice == 0 || is_thorough()) return {"-O0", "-O2", "-O3"};
  return choice % 2 == compiler ? std::vector<std::string>{"-O2"} : std::vector<std::string>{};
}

std::vector<std::string> with_batches(std::vector<std::string> names) {
  for (std::size_t i = names.size(); i-- > 0;) names.push_back(names[i] + "_batch");
  return names;
}

// Calls everything that a batch offers, whose brake is constant or is one of the `outputs`.
std::string caller_of_batch(const std::string& name, const std::string& outputs = "f") {
  return fmt::format(
      "#include \"{0}_batch.hpp\"\n"
      "using batch = dashpot::generated::{0}_batch;\n"
      "dashpot::generated::{0}_points<19> own;\n"
      "void run(batch& points, batch::scalar* p, batch::scalar* v, [[maybe_unused]] batch::scalar* d, batch::scalar* "
      "f) "
      "{{\n"
      "  points.reset(*p); points.step(p, v, {1}); points.output(p, v, {1}); points.update(p, v); *f = "
      "points.stored_energy(3);\n"
      "}}\n",
      name, outputs);
}

// At each of the levels, by each of the compilers, with headers from a folder of theirs.
void expect_no_symbol_undefined(const std::filesystem::path& folder, const std::filesystem::path& headers,
                                const std::string& caller, const std::string& name,
                                const std::vector<std::string>& levels) {
  const std::filesystem::path source = folder / "caller.cpp", object = folder / "caller.o";
  write_text(source, caller);
  for (const Compiler& compiler : compilers)
    for (const std::string& level : levels) {
      const Finished built =
          run_command(fmt::format("'{}' {} {} -c '{}' -o '{}' {} -I'{}'", compiler.path, strict, level, source.string(),
                                  object.string(), runtime_include(), headers.string()));
      EXPECT_TRUE(built.status == 0 && built.output.empty()) << compiler.name << level << ":\n"
                                                             << built.output.substr(0, 4000);
      EXPECT_EQ(run_command(fmt::format("nm -C -u '{}'", object.string())).output, "")
          << compiler.name << " " << level << ", " << name;
    }
}

class StrictCompile : public ::testing::Test {
 protected:
  EmittedFolder emitted(const Choice& choice) const {
    return emit_headers(folder_.path() / choice.name, files_, choice.options);
  }

  const TemporaryFolder folder_;

 private:
  const std::vector<std::string> files_ = network_files(folder_.path());
};

// Fails if a header needs another one before it, or a compiler has anything to say about it: one compiler and the other
// in turn, both in a thorough run.
TEST_F(StrictCompile, TakesEveryHeaderAlone) {
  const EmittedFolder headers = emitted(choices[0]);
  const std::vector<std::string> names = with_batches(headers.classes);
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < std::size(compilers); ++k) {
      if (!is_thorough() && i % 2 != k) continue;
      const Compiler& compiler = compilers[k];
      const std::string& name = names[i];
      const std::string line = fmt::format("echo '#include \"{}.hpp\"' | '{}' {} -fsyntax-only {} -I'{}' -x c++ -",
                                           name, compiler.path, strict, runtime_include(), headers.path.string());
      const Finished finished = run_command(line);
      EXPECT_TRUE(finished.status == 0 && finished.output.empty()) << compiler.name << ", " << name << ":\n"
                                                                   << finished.output;
    }
}

// Fails if calling any member, at any level of optimisation, warns, needs a symbol from elsewhere (memset for a reset
// of many states, a run-time library for an object that is not initialised by constants), or uses much stack.
TEST_F(StrictCompile, LeavesNoSymbolUndefined) {
  for (std::size_t i = 0; i < std::size(choices); ++i) {
    const std::filesystem::path caller = folder_.path() / "caller.cpp", object = folder_.path() / "caller.o";
    const EmittedFolder headers = emitted(choices[i]);
    write_text(caller, caller_of(headers));
    for (std::size_t k = 0; k < std::size(compilers); ++k)
      for (const std::string& level : levels_for(i, k)) {
        const Compiler& compiler = compilers[k];
        const bool optimised = level == "-O2";  // stack is measured where code is laid out for small frames
        const Finished built = run_command(fmt::format("'{}' {} {} {} -c '{}' -o '{}' {} -I'{}'", compiler.path, strict,
                                                       level, optimised ? compiler.flags : "", caller.string(),
                                                       object.string(), runtime_include(), headers.path.string()));
        EXPECT_TRUE(built.status == 0 && built.output.empty())
            << compiler.name << level << ", " << choices[i].name << ":\n"
            << built.output.substr(0, 4000);
        const Finished undefined = run_command(fmt::format("nm -C -u '{}'", object.string()));
        EXPECT_EQ(undefined.output, "") << compiler.name << " " << level << ", " << choices[i].name;
        const Finished initialisers = run_command(fmt::format("nm -C '{}' | grep -c GLOBAL__sub_I", object.string()));
        EXPECT_EQ(initialisers.output, "0\n") << "an object of static storage is initialised at run time";
      }
  }
}

// Fails likewise for a batch, but that storage of its own is put to rest before a program begins.
TEST_F(StrictCompile, LeavesNoSymbolOfABatchUndefined) {
  const EmittedFolder headers = emitted(choices[0]);
  for (const char* name : {"second_order_maxwell", "twenty_branches"})
    expect_no_symbol_undefined(folder_.path(), headers.path, caller_of_batch(name), name, {"-O0", "-O2", "-O3"});
}

// Fails likewise where slips of each point are solved together; at -O0 clang clears whatever array by memset.
TEST(StrictBatch, OfCoupledSlipsLeavesNoSymbolUndefined) {
  const TemporaryFolder folder;
  const EmittedFolder emitted = emit_headers(
      folder.path() / "out",
      {DASHPOT_NETWORKS "/tissues/needle_in_liver.json", DASHPOT_NETWORKS "/tunable/layers_tunable.json"}, "--batch");
  for (const char* name : {"needle_in_liver", "layers_tunable"})
    expect_no_symbol_undefined(folder.path(), emitted.path, caller_of_batch(name, "d, f"), name, {"-O2", "-O3"});
}

// Fails likewise where what only the single class remembers, the least of three ports' shares, is worked out here too.
TEST(StrictBatch, OfPortsThatShedLeavesNoSymbolUndefined) {
  const TemporaryFolder folder;
  std::string ports;
  for (const char* name : {"a", "b", "c"})
    ports += fmt::format(R"({}{{"name": "{}", "network": {{"parallel": [{{"spring": 100}},
                         {{"series": [{{"spring": 50}}, {{"damper": 5}}]}}]}}}})",
                         ports.empty() ? "" : ", ", name);
  write_text(folder.path() / "three.json",
             fmt::format(R"({{"dashpot": 1, "name": "three", "motion": "translation", "ports": [{}]}})", ports));
  const EmittedFolder emitted = emit_headers(folder.path() / "out", {folder.path() / "three.json"},
                                             "--batch --uncertified --device '" DASHPOT_NETWORKS
                                             "/../runtime/devices/pantograph_brake_2009.json'");
  expect_no_symbol_undefined(folder.path(), emitted.path, caller_of_batch("three"), "three", {"-O2"});
}

}  // namespace
}  // namespace dashpot::testing
