// `--vector neon`, read in the assembly that clang makes of it for AArch64: no machine here runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "emitted_headers.hpp"

namespace dashpot::testing {
namespace {

struct Arithmetic {
  int packed = 0;  // of two doubles or four floats at once
  int scalar = 0;
  int calls = 0;
  int divisions = 0;
};

// Of sums, products and comparisons; `registers` is how the assembly calls a register that is full of them.
Arithmetic arithmetic_in(const std::string& assembly, const std::string& registers) {
  Arithmetic count;
  std::istringstream lines(assembly);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string instruction, target;
    words >> instruction >> target;
    const bool computes = instruction == "fadd" || instruction == "fsub" || instruction == "fmul" ||
                          instruction.rfind("fcm", 0) == 0 || instruction.rfind("facg", 0) == 0;
    const bool is_full = target.find(registers) != target.npos;
    count.packed += computes && is_full;
    count.scalar += computes && !is_full;
    count.calls += instruction == "bl" || instruction == "blr";
    count.divisions += instruction == "fdiv";
  }
  return count;
}

std::string assembly_of_update(const std::filesystem::path& folder, const std::string& network) {
  write_text(folder / "update.cpp",
             fmt::format("#include \"{0}.hpp\"\nvoid update(dashpot::generated::{0}& model) {{ model.update(); }}\n",
                         network));
  const Finished finished =
      run_command(fmt::format("'{}' --target=aarch64-linux-gnu -std=c++17 -O2 -ffreestanding -ffp-contract=off -Wall "
                              "-Wextra -Wpedantic -Wconversion "
                              "-Wdouble-promotion -Wshadow -Werror {} -I'{}' -S -o - '{}'",
                              DASHPOT_CLANGXX, runtime_include(), folder.string(), (folder / "update.cpp").string()));
  EXPECT_EQ(finished.status, 0) << finished.output;
  return finished.output;
}

// A round of the loop: for every register of `lanes` sums two products, their sum and the partial sum, and before the
// loop as many guards in turn, or in float a guard each; what is left is the total of the partial sums.
void expect_full_registers(const char* scalar, const std::string& registers, int in_register, int lanes) {
  const TemporaryFolder folder;
  write_text(folder.path() / "many.json", parallel_branches("many", 64));
  emit_headers(folder.path(), {(folder.path() / "many.json").string()},
               fmt::format("--vector neon --scalar {}", scalar));
  const Arithmetic count = arithmetic_in(assembly_of_update(folder.path(), "many"), registers);
  EXPECT_GE(count.packed, 5 * lanes / in_register);
  EXPECT_LE(count.scalar, lanes) << "more than a total is left over";
  EXPECT_EQ(count.calls, 0);
  EXPECT_EQ(count.divisions, 0);
}

// Fails if a loop laid out for NEON computes one double at a time there, calls or divides.
TEST(Neon, ComputesTwoDoublesAtOnce) { expect_full_registers("double", ".2d", 2, 8); }

// Fails likewise of four floats.
TEST(Neon, ComputesFourFloatsAtOnce) { expect_full_registers("float", ".4s", 4, 16); }

// Fails if a compiler for AArch64 has anything to say about an emitted header.
TEST(Neon, TakesEveryHeader) {
  const TemporaryFolder folder;
  const EmittedFolder emitted =
      emit_headers(folder.path() / "neon", network_files(folder.path()), "--vector neon --batch");
  write_text(folder.path() / "caller.cpp", caller_of(emitted));
  const Finished finished = run_command(fmt::format(
      "'{}' --target=aarch64-linux-gnu -std=c++17 -fsyntax-only -ffreestanding -Wall -Wextra -Wpedantic -Wconversion "
      "-Wdouble-promotion -Wshadow -Werror {} -I'{}' '{}'",
      DASHPOT_CLANGXX, runtime_include(), emitted.path.string(), (folder.path() / "caller.cpp").string()));
  EXPECT_TRUE(finished.status == 0 && finished.output.empty()) << finished.output.substr(0, 4000);
}

}  // namespace
}  // namespace dashpot::testing
