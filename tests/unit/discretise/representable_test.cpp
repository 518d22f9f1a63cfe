#include "discretise/representable.hpp"

#include <gtest/gtest.h>

#include "compiled.hpp"

namespace dashpot::compiler {
namespace {

bool overflows(const std::string& structure, const Choices& choices = {}) {
  try {
    Compiled compiled(network_text(structure), choices);
    return false;
  } catch (const std::invalid_argument& diagnostics) {
    return std::string(diagnostics.what()).find("[constant-overflows]") != std::string::npos;
  }
}

// Fails if a header with an infinite constant is written, or one whose constants are merely large is not.
TEST(Representable, refuses_constants_beyond_the_scalar) {
  EXPECT_TRUE(overflows(R"({ "parallel": [ { "spring": 1e308 }, { "spring": 1e308 } ] })"));
  EXPECT_FALSE(overflows(R"({ "parallel": [ { "spring": 8e307 }, { "spring": 8e307 } ] })"));
  Choices in_float;
  in_float.scalar = ScalarType::float32;
  EXPECT_TRUE(overflows(R"({ "spring": 1e39 })", in_float));
  EXPECT_FALSE(overflows(R"({ "spring": 1e38 })", in_float));
  in_float.decomposition = 1e300;
  EXPECT_TRUE(overflows(R"({ "spring": 1 })", in_float));
}

}  // namespace
}  // namespace dashpot::compiler
