#include "network/springpot.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "front_end_run.hpp"
#include "support/random.hpp"

namespace dashpot::compiler {
namespace {

std::complex<double> ladder_at(const SpringpotLadder& ladder, double frequency) {
  const std::complex<double> s(0, frequency);
  std::complex<double> sum = 0;
  for (const MaxwellBranch& branch : ladder.branches) sum += branch.stiffness * s / (s + branch.relaxation_rate);
  return sum;
}

double largest_error(const SpringpotLadder& ladder, double exponent, double low, double high) {
  double largest = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double frequency = low * std::pow(high / low, i / 2000.0);
    const std::complex<double> exact = std::pow(std::complex<double>(0, frequency), exponent);
    largest = std::max(largest, std::abs(ladder_at(ladder, frequency) - exact) / std::abs(exact));
  }
  return largest;
}

// If this fails, the trapezoid rule or the lumping of its tails is not the one that the bound is for. Values: the rule
// at 1.5 points a decade, eight points, exponent ½, from 0.01 to 100 rad/s.
TEST(SpringpotLadder, HasTheKnownValues) {
  const double step = std::log(10.0) / 1.5;
  const SpringpotLadder ladder = springpot_ladder(0.5, 0.01, 100, SpringpotGrid{-3.5 * step, step, 8});
  ASSERT_EQ(ladder.branches.size(), 10u);
  EXPECT_NEAR(ladder.branches[0].relaxation_rate, 5.954e-4, 1e-7);
  EXPECT_NEAR(ladder.branches[1].relaxation_rate, 4.642e-3, 1e-6);
  EXPECT_NEAR(ladder.branches[8].relaxation_rate, 215.4, 0.1);
  EXPECT_NEAR(ladder.branches[9].relaxation_rate, 1679.6, 0.1);
  EXPECT_NEAR(ladder.branches[0].stiffness, 0.028836, 1e-6);
  EXPECT_NEAR(ladder.branches[1].stiffness, 0.033289, 1e-6);
  EXPECT_NEAR(ladder.branches[8].stiffness, 7.1720, 1e-4);
  EXPECT_NEAR(ladder.branches[9].stiffness, 48.433, 1e-3);
  EXPECT_NEAR(largest_error(ladder, 0.5, 0.01, 100), 3.295e-3, 1e-6);
}

// Runs for ever if the search for a step tries a grid whose tails are too small for a double, and takes their error for
// the least. That happens over wide bands.
TEST(SpringpotLadder, IsFoundOverTheWidestBands) {
  for (const double exponent : {0.01, 0.5, 0.99})
    for (const double width : {1e9, 1e15, 1e24})
      for (const double error : {1e-9, 1e-5}) {
        SCOPED_TRACE(fmt::format("{} {} {}", exponent, width, error));
        const SpringpotLadder ladder = springpot_ladder(exponent, 1e-6, 1e-6 * width, error);
        EXPECT_LE(ladder.error, error);
        EXPECT_LT(ladder.branches.size(), 400u);
      }
}

// If this fails, the error that explain states for a springpot is no bound, or is so wide that elements are wasted.
TEST(SpringpotLadder, KeepsItsBoundAndUsesFewElements) {
  // At most so many elements for 5 %, 1 % and 0.1 % over 2, 4 and 6 decades at exponent ½; others need no more.
  constexpr std::size_t most[3][3] = {{5, 7, 10}, {7, 9, 14}, {9, 12, 18}};
  constexpr double errors[] = {0.05, 0.01, 0.001};
  for (int decades = 2; decades <= 6; decades += 2)
    for (int e = 0; e < 3; ++e)
      for (const double exponent : {0.05, 0.2, 0.5, 0.7, 0.95}) {
        const double high = std::pow(10, decades);
        const SpringpotLadder ladder = springpot_ladder(exponent, 1, high, errors[e]);
        const std::string what = fmt::format("{} decades, {}, exponent {}", decades, errors[e], exponent);
        EXPECT_LE(ladder.error, errors[e]) << what;
        EXPECT_LE(largest_error(ladder, exponent, 1, high), ladder.error) << what;
        EXPECT_LE(ladder.branches.size(), most[decades / 2 - 1][e]) << what;
      }
}

// How far the trapezoid rule alone is from t^−α/Γ(1 − α), relative: 2 |Γ(α + iy)|/Γ(α) with y = 2π/η, by Stirling's
// formula, whose own error at these y is below 1 %.
double relaxation_ripple(double exponent, double step) {
  const double y = 2 * std::numbers::pi / step;
  return 2 * std::sqrt(2 * std::numbers::pi) * std::pow(y, exponent - 0.5) * std::exp(-std::numbers::pi * y / 2) /
         boost::math::tgamma(exponent);
}

// If this fails, a springpot does not relax as t^−α/Γ(1 − α) (Blair 1947), which an error over frequency alone might
// not show. Two decades inside the band the tails contribute less than a tenth of the rule's own ripple.
TEST(SpringpotLadder, RelaxesAsAPowerOfTime) {
  for (const double exponent : {0.2, 0.5, 0.8}) {
    const SpringpotLadder ladder = springpot_ladder(exponent, 1e-4, 1e4, 0.001);
    const double step = std::log(ladder.branches[2].relaxation_rate / ladder.branches[1].relaxation_rate);
    for (const double time : {0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
      double force = 0;
      for (const MaxwellBranch& branch : ladder.branches)
        force += branch.stiffness * std::exp(-branch.relaxation_rate * time);
      const double exact = std::pow(time, -exponent) / boost::math::tgamma(1 - exponent);
      EXPECT_NEAR(force, exact, 1.1 * relaxation_ripple(exponent, step) * exact) << exponent << " at " << time << " s";
    }
  }
}

// E_α(−x) by its series, Σ (−x)ⁿ/Γ(αn + 1): 50 terms are enough for x up to 2, where terms stay below 10.
double mittag_leffler(double exponent, double x) {
  double sum = 0;
  for (int n = 0; n < 120; ++n) sum += std::pow(-x, n) * std::exp(-boost::math::lgamma(exponent * n + 1));
  return sum;
}

// If this fails, springpots in series with springs are wrong: a fractional Maxwell element relaxes as E_α(−(t/τ)^α)
// (Mainardi 2010, section 3).
TEST(SpringpotLadder, InSeriesWithASpringRelaxesAsMittagLeffler) {
  const NetworkRun run(R"({ "dashpot": 1, "name": "sample", "network": { "series": [ { "spring": "1 N/m" },
    { "springpot": "1 N/m", "exponent": 0.5, "band": ["0.0001 Hz", "1 kHz"], "error": "0.1 %" } ] } })");
  ASSERT_TRUE(run.network) << run.said();
  // 1/(1 + s^-½) at real s on the Bromwich axis would need an inversion; the moments of the ladder do as well: at real
  // s the Laplace transform of E_½(−√t) is s^(−½)/(1 + s^½).
  const SpringpotLadder ladder = springpot_ladder(0.5, 2e-4 * std::numbers::pi, 2e3 * std::numbers::pi, 0.001);
  for (const double s : {0.05, 0.2, 1.0, 5.0, 20.0}) {
    double springpot = 0;
    for (const MaxwellBranch& branch : ladder.branches)
      springpot += branch.stiffness * s / (s + branch.relaxation_rate);
    const double series = 1 / (1 + 1 / springpot);
    EXPECT_NEAR(series / s, std::pow(s, -0.5) / (1 + std::sqrt(s)), 0.002 * series / s) << s;
  }
  EXPECT_NEAR(mittag_leffler(0.5, 1), std::exp(1.0) * std::erfc(1.0), 1e-13);
}

// If this fails, a springpot's parts carry other values than the formula gives, or names that clash.
TEST(SpringpotLeaf, BecomesMaxwellElements) {
  const NetworkRun run(R"({ "dashpot": 1, "name": "sample", "valid": { "frequency": ["0.1 Hz", "10 Hz"] },
    "network": { "parallel": [ { "spring": "3 N/m", "name": "core_spring_1" },
      { "springpot": "120 N/m", "exponent": 0.3, "time": "2 s", "name": "core" } ] } })");
  ASSERT_TRUE(run.network) << run.said();
  ASSERT_EQ(run.network->springpots.size(), 1u);
  const Springpot& springpot = run.network->springpots[0];
  EXPECT_EQ(run.network->elements.size(), 1 + 2 * springpot.elements);
  EXPECT_EQ(springpot.band.low, 0.1);
  EXPECT_EQ(springpot.band.high, 10);
  EXPECT_LE(springpot.error, 0.01);
  const double turn = 2 * std::numbers::pi;
  const SpringpotLadder unit = springpot_ladder(0.3, turn * 0.1, turn * 10, 0.01);
  EXPECT_EQ(run.network->elements[1].name, "core_spring_1_2");
  EXPECT_DOUBLE_EQ(std::get<Spring>(run.network->elements[1].law).stiffness,
                   unit.branches[0].stiffness * 120 * std::pow(2, 0.3));
  EXPECT_DOUBLE_EQ(std::get<Damper>(run.network->elements[2].law).damping,
                   unit.branches[0].stiffness * 120 * std::pow(2, 0.3) / unit.branches[0].relaxation_rate);
}

// If this fails, a device's band is not what a springpot without one holds over.
TEST(SpringpotLeaf, HoldsOverTheBandOfTheDevice) {
  Diagnostics diagnostics;
  const SourceFile file("network.json", R"({ "dashpot": 1, "name": "sample", "network":
    { "springpot": "1 N/m", "exponent": 0.3 } })");
  const auto network = build_network(parse_network(file, diagnostics).value(), diagnostics, Range{0.5, 50});
  ASSERT_TRUE(network);
  EXPECT_EQ(network->springpots[0].band.low, 0.5);
  EXPECT_EQ(network->springpots[0].band.high, 50);
}

// Spring beside the branches, then each branch's stiffness and time.
std::vector<double> numbers_of(const Network& network) {
  std::vector<double> numbers;
  for (const Element& element : network.elements)
    if (const Spring* spring = std::get_if<Spring>(&element.law)) numbers.push_back(spring->stiffness);
    else numbers.push_back(std::get<Damper>(element.law).damping / numbers.back());
  return numbers;
}

std::vector<double> prony(const std::string& of, const std::string& value, const std::string& terms) {
  const NetworkRun run(fmt::format(R"({{ "dashpot": 1, "name": "sample", "network":
    {{ "prony": "{}", "of": "{}", "terms": [ {} ] }} }})",
                                   value, of, terms));
  return run.network ? numbers_of(*run.network) : std::vector<double>();
}

// If this fails, a Prony series is read in another convention than the one that it names.
TEST(PronyLeaf, IsReadInTheConventionThatItNames) {
  const std::vector<double> expected{50, 30, 0.1, 20, 2};
  const auto is_expected = [&](const std::vector<double>& numbers, const char* what) {
    ASSERT_EQ(numbers.size(), expected.size()) << what;
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(numbers[i], expected[i], 1e-13 * expected[i]) << what;
  };
  is_expected(
      prony("instantaneous", "0.1 kN/m", R"({ "weight": 0.3, "time": "100 ms" }, { "weight": 0.2, "time": 2 })"),
      "instantaneous");
  is_expected(
      prony("long-term", "50 N/m", R"({ "weight": 0.6, "time": "0.1 s" }, { "weight": "40 %", "time": "2 s" })"),
      "long-term");
  is_expected(
      prony("absolute", "50 N/m", R"({ "weight": "30 N/m", "time": "0.1 s" }, { "weight": 20, "time": "2 s" })"),
      "absolute");
}

// If this fails, a series whose weights are 1 in all keeps a spring that rounding made, or is refused.
TEST(PronyLeaf, MayRelaxCompletely) {
  EXPECT_EQ(prony("instantaneous", "100 N/m", R"({ "weight": 0.1, "time": 1 }, { "weight": 0.2, "time": 2 },
    { "weight": 0.7, "time": 3 })")
                .size(),
            6u);
}

// If this fails, comments and schemas are refused, lost, or given to the wrong part.
TEST(Annotations, MayStandInEveryObject) {
  const NetworkRun run(
      R"({ "$schema": "network.schema.json", "dashpot": 1, "name": "sample", "comment": ["two", "lines"],
    "parameters": { "comment": "all assumed", "K": { "value": "5 N/m", "comment": "from a table" } },
    "network": { "parallel": [ { "spring": "K", "name": "skin", "comment": "thin" }, { "damper": 1, "comment": "fat" } ],
                 "comment": "both" } })");
  ASSERT_TRUE(run.network) << run.said();
  std::string all;
  for (const Comment& comment : run.network->comments) all += comment.about + ": " + comment.text + "; ";
  EXPECT_EQ(all,
            ": two; : lines; parameters: all assumed; parameters.K: from a table; network: both; skin: thin; "
            "network.parallel[2]: fat; ");
}

}  // namespace
}  // namespace dashpot::compiler
