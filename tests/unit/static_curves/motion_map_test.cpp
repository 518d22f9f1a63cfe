// The map of a static curve: its known values, and that w and w′ are one function and its derivative.
#include <cmath>

#include "linear/motion_map.hpp"
#include "source/render.hpp"
#include "static_case.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

MotionMap map_of(const std::string& curve, double error = most_static_error) {
  const Compilation c = compiled(behind(curve));
  Diagnostics diagnostics;
  return *motion_map(c.network, c.form.linear, diagnostics, error);
}

// Errors of the force at rest over the largest, with 33 and 65 ends of cells, to the two digits of theory, section 11.
TEST(MotionMap, StaticErrorsAreThoseOfTheTheory) {
  const MotionMap coarse = map_of(hertz), fine = map_of(hertz, 2e-4);
  EXPECT_EQ(coarse.cubics(), 32u);
  EXPECT_NEAR(coarse.static_error, 4.8e-4, 0.06e-4);
  EXPECT_EQ(fine.cubics(), 64u);
  EXPECT_NEAR(fine.static_error, 1.7e-4, 0.06e-4);
  const MotionMap steep = map_of(exponential), steeper = map_of(exponential, 1e-6);  // x = a u up to 5
  EXPECT_NEAR(steep.static_error, 3.5e-6, 0.06e-6);
  EXPECT_EQ(steeper.cubics(), 64u);
  EXPECT_NEAR(steeper.static_error, 4.6e-7, 0.06e-7);
}

// w = √(4c/5k) u^{5/4} of Hertz's curve c u^{3/2}.
TEST(MotionMap, HertzHasItsClosedForm) {
  const MotionMap map = map_of(hertz);
  const double c = 2 / std::pow(5e-3, 1.5);
  for (std::size_t i = 0; i <= map.cubics(); ++i) {
    const double u = double(i) * map.width(), w = std::sqrt(4 * c / (5 * 400)) * std::pow(u, 1.25);
    EXPECT_NEAR(map.cell[i].a, w, 1e-15 * std::max(w, 1e-3));
    EXPECT_NEAR(map.cell[i].b, 1.25 * std::sqrt(4 * c / (5 * 400)) * std::pow(u, 0.25), 1e-14);
  }
  EXPECT_EQ(map.stiffness, 400);
}

TEST(MotionMap, ForceAtRestIsTheCurve) {
  for (const char* curve :
       {hertz, exponential, table, R"({ "power": 1, "force": "2 N", "at": "5 mm" })",
        R"({ "power": 1.1, "force": "2 N", "at": "5 mm" })", R"({ "power": 3, "force": "2 N", "at": "5 mm" })"}) {
    const Compilation c = compiled(behind(curve));
    const MotionMap& map = *c.network.map;
    EXPECT_LE(map.static_error, most_static_error) << curve;
    for (const double u : {0.3e-3, 1.7e-3, 3.3e-3, 4.99e-3})
      EXPECT_NEAR(map.stiffness * map.value_at(u) * map.tangent_at(u), to_double(force_at(*c.network.static_curve, u)),
                  2.0 * map.static_error + 1e-12)
          << curve << " at " << u;
  }
}

// Of a curve at once all springs that a step meets are in k.
TEST(MotionMap, InstantaneousCurveTakesAllSprings) {
  const MotionMap map = map_of(R"({ "power": 1.5, "force": "2 N", "at": "5 mm", "is": "instantaneous" })");
  EXPECT_EQ(map.stiffness, 600);
}

// Fails if a curve at once leaves out springs in front of slips, which hold in a step, or takes one that a stuck slip
// bridges; or if a curve at rest takes them.
TEST(MotionMap, InstantaneousCurveTakesSlipsForStuck) {
  const std::string behind_slips = R"({ "parallel": [ { "spring": "400 N/m" }, { "damper": "3 N s/m" },
      { "series": [ { "slip": "1 N" }, { "spring": "200 N/m" } ] },
      { "series": [ { "parallel": [ { "slip": "1 N" }, { "spring": "70 N/m" } ] }, { "spring": "50 N/m" },
                    { "damper": "2 N s/m" } ] } ] })";
  const std::string at_once = R"({ "power": 1.5, "force": "2 N", "at": "5 mm", "is": "instantaneous" })";
  EXPECT_EQ(compiled(behind(at_once, "", behind_slips)).network.map->stiffness, 650);
  EXPECT_EQ(compiled(behind(hertz, "", behind_slips)).network.map->stiffness, 400);
  const std::string slips_alone = R"({ "series": [ { "slip": "1 N" }, { "spring": "200 N/m" } ] })";
  EXPECT_EQ(compiled(behind(at_once, "", slips_alone)).network.map->stiffness, 200);
}

TEST(MotionMap, TangentIsTheDerivativeOfTheValue) {
  for (const char* curve : {hertz, exponential, table}) {
    const MotionMap map = map_of(curve);
    for (double u = 0.11e-3; u < 6e-3; u += 0.23e-3) {
      const double step = 1e-8, slope = (map.value_at(u + step) - map.value_at(u - step)) / (2 * step);
      EXPECT_NEAR(slope, map.tangent_at(u), 1e-6 * map.steepest()) << curve << " at " << u;
    }
  }
}

// The range of a file counts, from the surface of a contact on; without one the curve's own point.
TEST(MotionMap, ReachesAsFarAsTheFileIsValid) {
  const auto reach = [](const std::string& more) { return compiled(behind(hertz, more)).network.map->reach; };
  EXPECT_EQ(reach(""), 5e-3);
  EXPECT_EQ(reach(R"(, "valid": { "displacement": ["-9 mm", "4 mm"] })"), 9e-3);
  EXPECT_DOUBLE_EQ(reach(R"(, "contact": { "at": "3 mm" }, "valid": { "displacement": "10 mm" })"), 7e-3);
}

// A power above 5 makes a first cubic whose slope dips below 0.
TEST(MotionMap, TangentBoundsHoldInEveryInterval) {
  for (const char* curve : {hertz, exponential, table, R"({ "power": 9, "force": "2 N", "at": "5 mm" })"}) {
    const MotionMap map = map_of(curve);
    for (double from = 0; from < 6e-3; from += from == 0 ? 1e-6 : 0.37e-3)
      for (double length : {1e-6, 1e-5, 3e-4, 2e-3}) {
        const double least = map.least_tangent(from, from + length), most = map.largest_tangent(from, from + length);
        for (int i = 0; i <= 50; ++i) {
          const double tangent = std::abs(map.tangent_at(from + length * i / 50));
          EXPECT_LE(least, tangent * (1 + 1e-12));
          EXPECT_GE(most, tangent * (1 - 1e-12));
        }
      }
  }
}

std::string refusal_of(const std::string& text) {
  Diagnostics diagnostics;
  const SourceFile file("curved.json", text);
  EXPECT_FALSE(compile(file, Choices(), std::nullopt, diagnostics));
  return render_text(diagnostics);
}

TEST(MotionMap, RefusesNetworksWithoutAMap) {
  const std::string maxwell = R"({ "series": [ { "spring": "200 N/m" }, { "damper": "40 N s/m" } ] })";
  const std::string at_rest = refusal_of(behind(hertz, "", maxwell));
  EXPECT_NE(at_rest.find("static-without-rest"), std::string::npos) << at_rest;
  EXPECT_NE(at_rest.find("instantaneous"), std::string::npos) << "the way out";
  const std::string at_once = R"({ "power": 1.5, "force": "2 N", "at": "5 mm", "is": "instantaneous" })";
  EXPECT_EQ(compiled(behind(at_once, "", maxwell)).network.map->stiffness, 200);
  EXPECT_NE(refusal_of(behind(at_once, "", R"({ "damper": "40 N s/m" })")).find("static-without-springs"),
            std::string::npos);
  const std::string bent = R"({ "table": [[0, 0], [1e-9, 1e-12], [1.00001e-9, 1], [1e-2, 1.00001]] })";
  EXPECT_NE(refusal_of(behind(bent)).find("static-too-bent"), std::string::npos);
}

}  // namespace
}  // namespace dashpot::testing
