// `--constant-time`, read in the assembly that two compilers make of it: comments of compilers are not believed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "emitted_headers.hpp"

namespace dashpot::testing {
namespace {

struct Machine {
  const char* name;
  const char* path;
  const char* flags;
};
const Machine machines[] = {{"gcc", DASHPOT_GXX, "-O2"},
                            {"gcc", DASHPOT_GXX, "-O3"},
                            {"gcc", DASHPOT_GXX, "-O3 -march=x86-64-v4"},
                            {"clang", DASHPOT_CLANGXX, "-O2"},
                            {"clang", DASHPOT_CLANGXX, "-O3"},
                            {"clang", DASHPOT_CLANGXX, "-O3 -march=x86-64-v4"}};

struct Jumps {
  int back = 0;     // a loop's own
  int forward = 0;  // over something, or out of it
  int calls = 0;
  int divisions = 0;
};

bool is_jump(const std::string& instruction) { return instruction.size() > 1 && instruction[0] == 'j'; }

struct Line {
  std::string first, second;
  bool is_label() const { return !first.empty() && first.back() == ':'; }
};

std::vector<Line> lines_of(const std::string& assembly) {
  std::vector<Line> lines;
  std::istringstream text(assembly);
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    words >> lines.emplace_back().first >> lines.back().second;
  }
  return lines;
}

// Of all functions in the assembly. A jump to a function that is there too goes on in a phase that was not inlined.
Jumps jumps_in(const std::string& assembly) {
  const std::vector<Line> lines = lines_of(assembly);
  std::map<std::string, std::size_t> labels;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].is_label()) labels[lines[i].first.substr(0, lines[i].first.size() - 1)] = i;
  Jumps jumps;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& [instruction, target] = lines[i];
    const bool is_local = target.rfind(".L", 0) == 0;
    if (is_jump(instruction) && is_local) ++(labels.at(target) < i ? jumps.back : jumps.forward);
    jumps.calls +=
        instruction.rfind("call", 0) == 0 || (is_jump(instruction) && !is_local && labels.count(target) == 0);
    jumps.divisions += instruction.find("div") != instruction.npos || instruction.find("sqrt") != instruction.npos;
  }
  return jumps;
}

std::string assembly_of(const std::filesystem::path& folder, const std::string& network, const std::string& scalar,
                        const Machine& machine) {
  write_text(folder / "phases.cpp", fmt::format("#include \"{0}.hpp\"\n"
                                                "dashpot::command<{1}> output(dashpot::generated::{0}& model, {1} p, "
                                                "{1} v) {{ return model.output(p, v); }}\n"
                                                "void update(dashpot::generated::{0}& model) {{ model.update(); }}\n",
                                                network, scalar));
  const Finished finished = run_command(
      fmt::format("'{}' -std=c++17 {} -ffp-contract=off -fno-asynchronous-unwind-tables {} -I'{}' -S -o - '{}'",
                  machine.path, machine.flags, runtime_include(), folder.string(), (folder / "phases.cpp").string()));
  EXPECT_EQ(finished.status, 0) << finished.output;
  return finished.output;
}

int loops_in(const std::string& header) {
  const std::size_t output = header.find(" output(scalar position"), end = header.find(" step(scalar position");
  int loops = 0;
  for (std::size_t at = header.find("for (int i", output); at < end; at = header.find("for (int i", at + 1)) ++loops;
  return loops;
}

// Linear, with slips of every closed form, with a contact, with parameters that change; few states and many.
std::vector<std::string> networks(const std::filesystem::path& folder) {
  write_text(folder / "branches.json", parallel_branches("branches", 512));
  std::vector<std::string> files = {(folder / "branches.json").string()};
  for (const char* name : {"second_order_maxwell", "visco_elasto_plastic", "visco_elasto_plastic_organ",
                           "maxwell_slip_ten", "virtual_wall"})
    files.push_back(fmt::format(DASHPOT_NETWORKS "/paper/{}.json", name));
  for (const char* name : {"second_order_maxwell", "standard_solid", "friction"})
    files.push_back(fmt::format(DASHPOT_NETWORKS "/tunable/{}_tunable.json", name));
  return files;
}

void expect_constant_time(const std::string& scalar) {
  const TemporaryFolder folder;
  const EmittedFolder emitted =
      emit_headers(folder.path(), networks(folder.path()), "--constant-time --scalar " + scalar);
  for (const std::string& name : emitted.classes)
    for (const Machine& machine : machines) {
      const Jumps jumps = jumps_in(assembly_of(folder.path(), name, scalar, machine));
      const std::string what = fmt::format("{} in {} by {} {}", name, scalar, machine.name, machine.flags);
      EXPECT_EQ(jumps.forward, 0) << what;
      EXPECT_LE(jumps.back, loops_in(text_of(folder.path() / (name + ".hpp")))) << what;
      EXPECT_EQ(jumps.calls, 0) << what;
      EXPECT_EQ(jumps.divisions, 0) << what;
    }
}

// Fails if either compiler makes a jump, a call or a division of a phase's decisions, at -O2 or -O3: the time of a
// sample would tell what it was, and the worst one be longer than those that were timed.
TEST(ConstantTime, DoubleHasNoJumpButItsLoops) { expect_constant_time("double"); }

// Fails likewise in float.
TEST(ConstantTime, FloatHasNoJumpButItsLoops) { expect_constant_time("float"); }

// Fails if the reader above sees no jumps where there are some.
TEST(ConstantTime, IsNotWhatIsEmittedOtherwise) {
  const TemporaryFolder folder;
  const EmittedFolder emitted = emit_headers(folder.path(), networks(folder.path()), "");
  for (const std::string& name : emitted.classes)
    EXPECT_GT(jumps_in(assembly_of(folder.path(), name, "double", machines[0])).forward, 0) << name;
}

}  // namespace
}  // namespace dashpot::testing
