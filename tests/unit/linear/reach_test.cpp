// Networks beyond what the extended precision resolves, or beyond what is eliminated in minutes, are refused with
// numbers.
#include "linear/reach.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compile.hpp"
#include "source/render.hpp"

namespace {

using namespace dashpot::compiler;

std::string said_of(const std::string& structure) {
  const SourceFile file("test.json", "{ \"dashpot\": 1, \"name\": \"written\", " + structure + " }");
  Diagnostics diagnostics;
  compile(file, {}, std::nullopt, diagnostics);
  return render_text(diagnostics);
}

std::string ladder(std::size_t inner_nodes) {
  std::string text, here = "tool";
  for (std::size_t i = 0; i < inner_nodes; ++i) {
    const std::string next = fmt::format("n{}", i);
    text += fmt::format(
        "{}{{ \"spring\": 1, \"nodes\": [\"{}\", \"{}\"] }}, {{ \"damper\": 1, \"nodes\": [\"{}\", \"ground\"] }}",
        i == 0 ? "" : ", ", here, next, next);
    here = next;
  }
  return "\"elements\": [ " + text + " ]";
}

// Fails if digits that are lost to cancellation come out as forces, or values that are resolved are refused.
TEST(Reach, EndsWhereValuesAreTooFarApart) {
  const auto springs = [](const char* soft) {
    return fmt::format(R"("network": {{ "series": [ {{ "spring": {} }}, {{ "spring": 1e12 }}, {{ "damper": 1 }} ] }})",
                       soft);
  };
  EXPECT_EQ(said_of(springs("1.01e-12")).find("values-far-apart"), std::string::npos);
  EXPECT_NE(said_of(springs("0.99e-12")).find("[values-far-apart]"), std::string::npos);
  EXPECT_NE(said_of(R"("network": { "series": [ { "damper": 1e30 }, { "damper": 1e-5 }, { "spring": 1 } ] })")
                .find("dampers 'damper_2'"),
            std::string::npos);
}

// Fails if a part of very many nodes is begun, or one that is just large is refused.
TEST(Reach, EndsWhereAPartHasTooManyNodes) {
  EXPECT_EQ(said_of(ladder(40)), "");
  EXPECT_NE(said_of(ladder(most_inner_nodes + 1)).find("has 401 inner nodes; at most 400"), std::string::npos);
}

}  // namespace
