#include "network/name_rules.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

// The remedy that is offered for a name; empty where the name is legal or nothing can be offered.
std::string proposal_for(const std::string& name) {
  Diagnostics diagnostics;
  if (check_name({name, {}}, "element", diagnostics)) return {};
  const std::vector<Note> notes = diagnostics.in_file_order().front().notes;
  if (notes.empty()) return {};
  const std::string& text = notes.front().text;
  return text.substr(text.find('\'') + 1, text.rfind('\'') - text.find('\'') - 1);
}

bool is_accepted(const std::string& name) {
  Diagnostics diagnostics;
  return check_name({name, {}}, "element", diagnostics);
}

// If this fails, emitted code does not compile because of a name, or names are refused that would do.
TEST(NameRules, SeparateLegalFromIllegal) {
  for (const char* name : {"K1", "k", "second_order_maxwell", "B1_", "Double", "Step", "a1_2_b"})
    EXPECT_TRUE(is_accepted(name)) << name;
  for (const char* name : {"",       "1K",     "_K",     "K 1",           "K-1",           "K__1",
                           "é",      "double", "and",    "co_await",      "char8_t",       "linux",
                           "typeof", "step",   "set",    "stored_energy", "sample_period", "parameters",
                           "reset",  "scalar", "dashpot"})
    EXPECT_FALSE(is_accepted(name)) << name;
}

// If this fails, a name that the compiler recommends is refused when it is taken up.
TEST(NameRules, ProposalsAreLegal) {
  constexpr std::string_view alphabet = "aZ09__  -é.dois";
  testing::Random random(7);
  for (int i = 0; i < 5000; ++i) {
    std::string name;
    for (std::size_t length = random.index(8); length > 0; --length) name += alphabet[random.index(alphabet.size())];
    const std::string proposal = proposal_for(name);
    EXPECT_TRUE(proposal.empty() || is_accepted(proposal)) << name << " -> " << proposal;
  }
  EXPECT_EQ(proposal_for("liver (grade 3)"), "liver_grade_3");
  EXPECT_EQ(proposal_for("2nd"), "n2nd");
  EXPECT_EQ(proposal_for("double"), "double_1");
  EXPECT_EQ(proposal_for("__"), "");
}

// If this fails, generated names clash with given ones that differ by case.
TEST(NameRules, FreeNamesAreFree) {
  Diagnostics diagnostics;
  UniqueNames names;
  EXPECT_EQ(names.free_name("spring_1"), "spring_1");
  names.add({"Spring_1", {}}, diagnostics);
  names.add({"spring_1_2", {}}, diagnostics);
  EXPECT_EQ(names.free_name("spring_1"), "spring_1_3");
  EXPECT_FALSE(diagnostics.has_errors());
}

}  // namespace
}  // namespace dashpot::compiler
