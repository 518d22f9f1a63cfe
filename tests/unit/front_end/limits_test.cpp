// The limits that are too large for a file among the cases of tests/diagnostics.
#include <gtest/gtest.h>

#include <string>

#include "front_end_run.hpp"

namespace dashpot::compiler {
namespace {

std::string springs_in_parallel(std::size_t count) {
  std::string text = R"({"dashpot": 1, "name": "many", "network": {"parallel": [{"damper": 1})";
  for (std::size_t i = 1; i < count; ++i) text += R"(,{"spring": "1 N/m"})";
  return text + "]}}";
}

// If this fails, the number of elements is not limited to what later stages can bear, or less is accepted.
TEST(Limits, TwentyThousandElements) {
  EXPECT_TRUE(NetworkRun(springs_in_parallel(20000)).network);
  const NetworkRun run(springs_in_parallel(20001));
  EXPECT_FALSE(run.network);
  EXPECT_NE(run.said().find("error: 20001 elements; at most 20000 are compiled [too-many-elements]"),
            std::string::npos);
}

// If this fails, a file of 16 MiB can take a hundred times as much memory.
TEST(Limits, HalfAMillionValues) {
  std::string text = "[0";
  for (int i = 0; i < 500000; ++i) text += ",0";
  const NetworkRun run(text + "]");
  EXPECT_FALSE(run.network);
  EXPECT_NE(run.said().find("error: more than 500000 values, the most that are read [too-many-values]"),
            std::string::npos);
}

// If this fails, a file with thousands of mistakes takes minutes to refuse.
TEST(Limits, ThousandsOfMistakesAreAllReported) {
  std::string text = R"({"dashpot": 1, "name": "many", "parameters": {)";
  for (int i = 0; i < 5000; ++i) text += (i > 0 ? ",\"p" : "\"p") + std::to_string(i) + "\": 1";
  text += R"(}, "network": {"parallel": [{"spring": "p0"})";
  for (int i = 0; i < 5000; ++i) text += R"(,{"spring": "q)" + std::to_string(i) + "\"}";
  const NetworkRun run(text + "]}}");
  EXPECT_EQ(run.diagnostics.error_count(), 5000u);
}

}  // namespace
}  // namespace dashpot::compiler
