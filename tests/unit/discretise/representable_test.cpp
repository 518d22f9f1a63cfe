#include "law/representable.hpp"

#include <gtest/gtest.h>

#include "compile.hpp"
#include "compiled.hpp"
#include "source/render.hpp"

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
TEST(Representable, RefusesConstantsBeyondTheScalar) {
  EXPECT_TRUE(overflows(R"({ "parallel": [ { "spring": 1e308 }, { "spring": 1e308 } ] })"));
  EXPECT_FALSE(overflows(R"({ "parallel": [ { "spring": 8e307 }, { "spring": 8e307 } ] })"));
  Choices in_float;
  in_float.scalar = ScalarType::float32;
  EXPECT_TRUE(overflows(R"({ "spring": 1e39 })", in_float));
  EXPECT_FALSE(overflows(R"({ "spring": 1e38 })", in_float));
  in_float.decomposition = 1e300;
  EXPECT_TRUE(overflows(R"({ "spring": 1 })", in_float));
}

std::optional<Compilation> compiled_whole(const SourceFile& source, ScalarType scalar, Diagnostics& diagnostics) {
  Choices choices;
  choices.scalar = scalar;
  return compile(source, choices, std::nullopt, diagnostics);
}

// Fails if a number that set() or coupled slips begin with is written that is none.
TEST(Representable, RefusesWhatFollowsFromParametersAndSlips) {
  const SourceFile tuned("thin.json", R"({"dashpot": 1, "name": "thin",
    "parameters": {"Y": {"value": 0.1, "tunable": true, "min": 0, "max": 1}},
    "network": {"series": [{"slip": "Y"}, {"damper": 1e-312}]}})");
  const SourceFile coupled("thin.json", R"({"dashpot": 1, "name": "thin", "network": {"series": [
    {"slip": 1}, {"spring": 1e-39}, {"parallel": [{"slip": 1}, {"spring": 1e-39}]}]}})");
  for (const auto& [text, scalar] : {std::pair(&tuned, ScalarType::float64), {&coupled, ScalarType::float32}}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(compiled_whole(*text, scalar, diagnostics));
    EXPECT_NE(render_text(diagnostics).find("[constant-overflows]"), std::string::npos) << render_text(diagnostics);
  }
}

// Fails if a parameter may be set to what the scalar cannot hold.
TEST(Representable, RefusesRangesBeyondTheScalar) {
  const SourceFile text(
      "far.json",
      R"({"dashpot": 1, "name": "far", "parameters": {"K": {"value": 1, "tunable": true, "min": 0, "max": 1e39}},
    "network": {"series": [{"damper": 1}, {"spring": "K"}]}})");
  Diagnostics diagnostics;
  EXPECT_FALSE(compiled_whole(text, ScalarType::float32, diagnostics));
  EXPECT_NE(render_text(diagnostics).find("'K'"), std::string::npos);
  EXPECT_NE(render_text(diagnostics).find("[constant-overflows]"), std::string::npos);
  EXPECT_TRUE(compiled_whole(text, ScalarType::float64, diagnostics));
}

// Fails if a law whose constants are finite, but not what is proved of it, ends in anything but words.
TEST(Representable, IsNotCertifiedBeyondADouble) {
  const SourceFile text(
      "far.json", R"({"dashpot": 1, "name": "far", "network": {"series": [{"spring": 1e308}, {"damper": 1e308}]}})");
  Diagnostics diagnostics;
  const auto compilation = compiled_whole(text, ScalarType::float64, diagnostics);
  ASSERT_TRUE(compilation);
  EXPECT_FALSE(compilation->certificate.certified);
  EXPECT_NE(compilation->certificate.bound.reason, "");
  Choices choices;
  choices.rate = 0.001;
  const SourceFile held(
      "held.json", R"({"dashpot": 1, "name": "held", "network": {"parallel": [{"spring": 1e308}, {"damper": 1}]}})");
  EXPECT_FALSE(compile(held, choices, std::nullopt, diagnostics)->certificate.certified);
}

}  // namespace
}  // namespace dashpot::compiler
