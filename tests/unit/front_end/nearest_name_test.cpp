#include "source/nearest_name.hpp"

#include <gtest/gtest.h>

namespace dashpot::compiler {
namespace {

// If this fails, misspelt names get no suggestion, or a misleading one.
TEST(NearestName, IsTheOneThatWasProbablyMeant) {
  const std::vector<std::string> names = {"spring", "damper", "slip", "series", "parallel"};
  EXPECT_EQ(nearest_name("sprign", names), "spring");     // neighbours swapped
  EXPECT_EQ(nearest_name("Damper", names), "damper");     // case
  EXPECT_EQ(nearest_name("paralel", names), "parallel");  // letter left out
  EXPECT_EQ(nearest_name("serries", names), "series");    // letter too many
  EXPECT_EQ(nearest_name("slop", names), "slip");         // another letter
  EXPECT_EQ(nearest_name("mass", names), std::nullopt);
  EXPECT_EQ(nearest_name("", names), std::nullopt);
  EXPECT_EQ(nearest_name("spring", {}), std::nullopt);
}

// If this fails, the suggestion depends on the order of a container instead of the file.
TEST(NearestName, IsTheFirstOfEquals) {
  EXPECT_EQ(nearest_name("K3", {"K1", "K2"}), "K1");
  EXPECT_EQ(nearest_name("K3", {"B4", "k3", "K2"}), "k3");  // case counts half
}

// If this fails, single letters are suggested for each other.
TEST(NearestName, OfOneLetterIsAnotherCaseOnly) {
  EXPECT_EQ(nearest_name("a", {"b"}), std::nullopt);
  EXPECT_EQ(nearest_name("a", {"A"}), "A");
}

// If this fails, a megabyte of text in place of a name costs a megabyte squared.
TEST(NearestName, OfAVeryLongNameIsNotSought) {
  const std::string name(1 << 20, 'a');
  EXPECT_EQ(nearest_name(name, {name + "a"}), std::nullopt);
  EXPECT_EQ(nearest_name("ab", {name, "abc"}), "abc");
}

}  // namespace
}  // namespace dashpot::compiler
