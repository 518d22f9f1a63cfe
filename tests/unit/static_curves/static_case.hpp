// Networks behind static curves, compiled from their text.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "compile.hpp"

namespace dashpot::testing {

// 400 N/m that stay and 200 N/m that relax within 0.2 s, 3 N at 5 mm where nothing else is said.
inline std::string behind(const std::string& curve, const std::string& more = "",
                          const std::string& network =
                              R"({ "parallel": [ { "spring": "400 N/m" },
                                   { "series": [ { "spring": "200 N/m" }, { "damper": "40 N s/m" } ] } ] })") {
  return R"({ "dashpot": 1, "name": "curved", "static": )" + curve + R"(, "network": )" + network + more + " }";
}

inline const char* const hertz = R"({ "power": 1.5, "force": "2 N", "at": "5 mm" })";
inline const char* const exponential = R"({ "exponential": "1 1/mm", "force": "2 N", "at": "5 mm" })";
inline const char* const table =
    R"({ "table": [["0 mm", "0 N"], ["1 mm", "0.1 N"], ["3 mm", "0.9 N"], ["5 mm", "2 N"]] })";

inline compiler::Compilation compiled(const std::string& text, compiler::Choices choices = {}) {
  compiler::Diagnostics diagnostics;
  const compiler::SourceFile file("curved.json", text);
  std::optional<compiler::Compilation> c = compiler::compile(file, choices, std::nullopt, diagnostics);
  EXPECT_TRUE(c && !diagnostics.has_errors()) << text;
  return std::move(*c);
}

}  // namespace dashpot::testing
