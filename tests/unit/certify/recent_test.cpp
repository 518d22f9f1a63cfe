#include "certify/recent.hpp"

#include <gtest/gtest.h>

namespace dashpot::compiler {
namespace {

// Otherwise every search that is asked for twice would be made twice, or one would get the answer of another.
TEST(Recent, FindsOnceAndKeepsQuestionsApart) {
  Recent<int, int> squares;
  int searches = 0;
  const auto square = [&](int of) { return squares.at(of, [&, of] { return ++searches, of * of; }); };
  for (int round = 0; round < 3; ++round)
    for (int of = 1; of <= 8; ++of) EXPECT_EQ(square(of), of * of);
  EXPECT_EQ(searches, 8);
}

// Otherwise a process that compiles many networks would grow for ever.
TEST(Recent, ForgetsTheOldest) {
  Recent<int, int> squares;
  int searches = 0;
  const auto square = [&](int of) { return squares.at(of, [&, of] { return ++searches, of * of; }); };
  for (int of = 1; of <= 9; ++of) square(of);
  square(9);
  EXPECT_EQ(searches, 9);
  EXPECT_EQ(square(1), 1);
  EXPECT_EQ(searches, 10);
}

}  // namespace
}  // namespace dashpot::compiler
