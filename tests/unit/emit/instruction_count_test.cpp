// What a step costs, counted in the assembly that a compiler makes of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <sstream>

#include "emitted_headers.hpp"

namespace dashpot::testing {
namespace {

struct Instructions {
  int multiplications = 0;
  int additions = 0;  // and subtractions
  int divisions = 0;
  int comparisons = 0;  // and least and greatest of two
  int packed = 0;       // additions, multiplications and comparisons of several numbers at once
  int calls = 0;
};

constexpr const char* scalar_code = "-O2 -fno-tree-vectorize -mno-avx";
constexpr const char* vector_code = "-O3 -march=x86-64-v3";

void count_instruction(const std::string& instruction, Instructions& count) {
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), instruction) != names.end();
  };
  count.multiplications += is_one_of({"mulsd"});
  count.additions += is_one_of({"addsd", "subsd"});
  count.divisions += is_one_of({"divsd", "vdivsd", "vdivpd", "sqrtsd"});
  count.comparisons += is_one_of({"comisd", "ucomisd", "minsd", "maxsd"}) ||
                       (instruction.rfind("cmp", 0) == 0 && instruction.ends_with("sd"));
  count.packed +=
      is_one_of({"vaddpd", "vsubpd", "vmulpd"}) || (instruction.rfind("vcmp", 0) == 0 && instruction.ends_with("pd"));
  count.calls += is_one_of({"call"});
}

// Of the function `step` alone, by default of scalar instructions only, so that each is one operation.
Instructions instructions_of_step(const std::filesystem::path& folder, const std::string& network,
                                  const char* kind = scalar_code) {
  write_text(folder / "step.cpp",
             fmt::format("#include \"{0}.hpp\"\n"
                         "dashpot::command<double> step(dashpot::generated::{0}& model, double p, double v) "
                         "{{ return model.step(p, v); }}\n",
                         network));
  const Finished finished =
      run_command(fmt::format("'{}' -std=c++17 {} -ffp-contract=off {} -I'{}' -S -o - '{}'", DASHPOT_GXX, kind,
                              runtime_include(), folder.string(), (folder / "step.cpp").string()));
  EXPECT_EQ(finished.status, 0) << finished.output;
  Instructions count;
  std::istringstream lines(finished.output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string instruction;
    words >> instruction;
    count_instruction(instruction, count);
  }
  return count;
}

// Counted apart.
constexpr int finite_check = 1;  // m − m: the force shows what its inputs are
constexpr int dead_forces = 2;   // drive + 0 of each of Fig. 5's modes, where the force before is below the threshold

// Fails if a step of the paper's Fig. 5 network costs more than two multiplications and two additions a mode, three
// products and four sums for what all modes share (k0 u, Σc Δu and Δu itself, (b∞ − b) u̇, the modes' sum), or a
// division.
TEST(InstructionCount, OfFigure5IsTwoAndTwoAMode) {
  const TemporaryFolder folder;
  emit_headers(folder.path(), {DASHPOT_NETWORKS "/paper/second_order_maxwell.json"}, "");
  const Instructions count = instructions_of_step(folder.path(), "second_order_maxwell");
  constexpr int modes = 2;
  EXPECT_LE(count.multiplications, 2 * modes + 3);
  EXPECT_LE(count.additions - finite_check - dead_forces, 2 * modes + 4);
  EXPECT_GE(count.multiplications, 2 * modes + 1) << "the instructions are not those of the step";
  EXPECT_EQ(count.divisions, 0);
  EXPECT_EQ(count.calls, 0);
}

// Fails if the banner states other numbers than the code has.
TEST(InstructionCount, IsWhatTheBannerStates) {
  const TemporaryFolder folder;
  emit_headers(folder.path(), {DASHPOT_NETWORKS "/paper/second_order_maxwell.json"}, "");
  const Instructions count = instructions_of_step(folder.path(), "second_order_maxwell");
  const std::string text = text_of(folder.path() / "second_order_maxwell.hpp");
  int additions = 0, multiplications = 0;
  for (const char* phase : {"cost of output(): ", "cost of update(): "}) {
    const std::size_t place = text.find(phase);
    ASSERT_NE(place, text.npos);
    int more_additions = 0, more_multiplications = 0;
    ASSERT_EQ(std::sscanf(text.c_str() + place, "cost of %*[a-z]():%d additions, %d multiplications", &more_additions,
                          &more_multiplications),
              2);
    additions += more_additions;
    multiplications += more_multiplications;
  }
  EXPECT_EQ(count.multiplications, multiplications);
  EXPECT_EQ(count.additions - finite_check - dead_forces, additions);
}

// Fails if a step of Fig. 10 costs more than 25 operations on floating-point numbers, checks of its inputs included, or
// divides.
TEST(InstructionCount, OfFigure10Is25AtMost) {
  const TemporaryFolder folder;
  emit_headers(folder.path(), {DASHPOT_NETWORKS "/paper/visco_elasto_plastic.json"}, "");
  const Instructions count = instructions_of_step(folder.path(), "visco_elasto_plastic");
  EXPECT_LE(count.multiplications + count.additions + count.comparisons, 25);
  EXPECT_GE(count.comparisons, 3) << "the instructions are not those of the step";
  EXPECT_EQ(count.divisions, 0);
  EXPECT_EQ(count.calls, 0);
}

// Fails if ten springs with slips are not computed several at once.
TEST(InstructionCount, OfTenSlipsIsVectorised) {
  const TemporaryFolder folder;
  emit_headers(folder.path(), {DASHPOT_NETWORKS "/paper/maxwell_slip_ten.json"}, "");
  const Instructions count = instructions_of_step(folder.path(), "maxwell_slip_ten", vector_code);
  EXPECT_GE(count.packed, 12);  // three or four vectors of four: product, sum, two comparisons of the clamp in each
  EXPECT_EQ(count.divisions, 0);
  EXPECT_EQ(count.calls, 0);
}

}  // namespace
}  // namespace dashpot::testing
