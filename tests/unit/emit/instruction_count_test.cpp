// What a step costs, counted in the assembly that a compiler makes of it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "emitted_headers.hpp"

namespace dashpot::testing {
namespace {

struct Instructions {
  int multiplications = 0;
  int additions = 0;  // and subtractions
  int divisions = 0;
  int calls = 0;
};

// Of the function `step` alone; scalar instructions only, so that each is one operation.
Instructions instructions_of_step(const std::filesystem::path& folder, const std::string& network) {
  write_text(folder / "step.cpp", fmt::format("#include \"{0}.hpp\"\n"
                                              "dashpot::command<double> step(dashpot::generated::{0}& model, double p, double v) "
                                              "{{ return model.step(p, v); }}\n",
                                              network));
  const Finished finished = run_command(
      fmt::format("'{}' -std=c++17 -O2 -ffp-contract=off -fno-tree-vectorize -mno-avx {} -I'{}' -S -o - '{}'", DASHPOT_GXX,
                  runtime_include(), folder.string(), (folder / "step.cpp").string()));
  EXPECT_EQ(finished.status, 0) << finished.output;
  Instructions count;
  std::istringstream lines(finished.output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string instruction;
    words >> instruction;
    count.multiplications += instruction == "mulsd";
    count.additions += instruction == "addsd" || instruction == "subsd";
    count.divisions += instruction == "divsd";
    count.calls += instruction == "call";
  }
  return count;
}

constexpr int finite_check = 5;  // (p − p) + (v − v) + (m − m), counted apart

// Fails if a step of the paper's Fig. 5 network costs more than two multiplications and two additions a mode, three
// products and four sums for what all modes share (k0 u, Σc Δu and Δu itself, (b∞ − b) u̇, the modes' sum), or a division.
TEST(InstructionCount, of_figure_5_is_two_and_two_a_mode) {
  const TemporaryFolder folder;
  emit_headers(folder.path(), {DASHPOT_NETWORKS "/paper/second_order_maxwell.json"}, "");
  const Instructions count = instructions_of_step(folder.path(), "second_order_maxwell");
  constexpr int modes = 2;
  EXPECT_LE(count.multiplications, 2 * modes + 3);
  EXPECT_LE(count.additions - finite_check, 2 * modes + 4);
  EXPECT_GE(count.multiplications, 2 * modes + 1) << "the instructions are not those of the step";
  EXPECT_EQ(count.divisions, 0);
  EXPECT_EQ(count.calls, 0);
}

// Fails if the banner states other numbers than the code has.
TEST(InstructionCount, is_what_the_banner_states) {
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
                          &more_multiplications), 2);
    additions += more_additions;
    multiplications += more_multiplications;
  }
  EXPECT_EQ(count.multiplications, multiplications);
  EXPECT_EQ(count.additions - finite_check, additions);
}

}  // namespace
}  // namespace dashpot::testing
