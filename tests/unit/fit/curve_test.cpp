// Tissue that stiffens: static curves, alone and with networks behind them, found again.
#include <gtest/gtest.h>

#include <cmath>

#include "compile.hpp"
#include "fit/fit.hpp"
#include "law/evaluate.hpp"
#include "recordings.hpp"
#include "synthetic.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr std::size_t all_rows = 1'000'000;
constexpr double curve_end = 3e-3;

std::vector<CurveShape> some_curves() {
  return {CurveShape::power(1, curve_end),
          CurveShape::power(1.5, curve_end),
          CurveShape::power(4, curve_end),
          CurveShape::exponential(0.01, curve_end),
          CurveShape::exponential(5, curve_end),
          CurveShape::table({-3, -1, 0.5}, curve_end),
          CurveShape::exponential(3, curve_end).sampled(8)};
}

// Fails if w' is not the slope of w, force not k w w', or the scale of a curve not that of its network.
TEST(CurveShapes, AreMapsWithTheirSlopes) {
  for (const CurveShape& curve : some_curves()) {
    EXPECT_NEAR(curve.at(curve_end).value, curve_end, 1e-12 * curve_end);
    for (const double u : {-0.9 * curve_end, 0.02 * curve_end, 0.3 * curve_end, 0.8 * curve_end}) {
      const double step = 1e-5 * curve_end;
      const CurveShape::Place place = curve.at(u);
      const double slope = (curve.at(u + step).value - curve.at(u - step).value) / (2 * step);
      EXPECT_NEAR(place.tangent, slope, 1e-6 * (1 + slope)) << word_of(curve.kind()) << " " << u;
      EXPECT_NEAR(std::abs(place.value) * place.tangent, curve.force_at(std::abs(u)), 1e-12 * curve_end);
      EXPECT_EQ(curve.at(-u).value, -place.value);
    }
  }
  EXPECT_NEAR(CurveShape::power(2, curve_end).at(curve_end / 4).value, curve_end / 8, 1e-15);  // (u/R)^{3/2} R
  EXPECT_NEAR(CurveShape::exponential(0.01, curve_end).at(1e-9).tangent, 1, 0.01);
}

// Force of a spring, a damper and one relaxation behind a power or an exponential, by steps of 1/400 of each row's: f =
// w' (k w + b ẇ + q), q' = k1 ẇ − q/τ.
struct Tissue {
  CurveShape curve;
  double spring, damper, branch, time;
};

std::vector<double> forces_of(const Tissue& tissue, const Recording& recording) {
  std::vector<double> forces{0};
  double q = 0;
  for (std::size_t i = 1; i < recording.time.size(); ++i) {
    constexpr int parts = 400;
    const double step = (recording.time[i] - recording.time[i - 1]) / parts;
    const double way = (recording.position[i] - recording.position[i - 1]) / parts;
    double u = recording.position[i - 1];
    for (int part = 0; part < parts; ++part, u += way) {
      const double rate = tissue.curve.at(u + way / 2).tangent * way / step;
      const double middle = q + step / 2 * (tissue.branch * rate - q / tissue.time);
      q += step * (tissue.branch * rate - middle / tissue.time);
    }
    const CurveShape::Place place = tissue.curve.at(recording.position[i]);
    forces.push_back(place.tangent * (tissue.spring * place.value + tissue.damper * place.tangent * way / step + q));
  }
  return forces;
}

// With noise of a share of the largest force.
Recording recorded(const Tissue& tissue, double share, Noise kind, std::uint64_t seed) {
  Recording recording = probing_motion();
  recording.force = forces_of(tissue, recording);
  double largest = 0;
  for (const double force : recording.force) largest = std::max(largest, std::abs(force));
  const std::vector<double> added = noise(recording.time.size(), share * largest, kind, seed);
  for (std::size_t i = 0; i < added.size(); ++i) recording.force[i] += added[i];
  recording.name = "made.csv";
  return recording;
}

std::vector<Tissue> tissues() {
  return {{CurveShape::power(2.2, curve_end), 300, 0, 200, 0.4},
          {CurveShape::exponential(4, curve_end), 200, 0, 300, 2}};
}

ReductionChoices with_shape(ShapeChoice shape) {
  ReductionChoices choices;
  choices.shape = shape;
  return choices;
}

// Fails if a curve that was put in is not the one that comes out, its network is not found behind it, or what is said
// to hold 95 of 100 holds fewer than 85: of what 12 recordings can tell about that, this is three deviations below.
TEST(CurveShapes, AreFoundAgain) {
  int values = 0, held = 0, spurious = 0;
  for (const Tissue& tissue : tissues())
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const std::vector<Recording> files{
          recorded(tissue, 0.005, seed % 2 == 0 ? Noise::white : Noise::autoregressive, seed)};
      const Problem problem(files, Form::stiffness, Weighting::uniform, all_rows);
      const Reduction found = reduce(problem, with_shape(ShapeChoice::automatic));
      ASSERT_TRUE(found.model.curve);
      EXPECT_EQ(found.model.curve->kind(), tissue.curve.kind()) << seed;
      EXPECT_EQ(found.model.count(TermKind::maxwell), 1u) << seed;
      spurious += found.model.count(TermKind::damper) > 0 ? 1 : 0;
      if (found.model.curve->kind() != tissue.curve.kind() || found.model.terms.size() != 2) continue;
      const Uncertainty uncertainty(problem, found.model, found.effective_samples, false);
      const auto count = [&](const std::optional<Interval>& interval, double truth) {
        ASSERT_TRUE(interval);
        ++values;
        held += interval->low <= truth && truth <= interval->high ? 1 : 0;
      };
      const bool is_power = tissue.curve.kind() == CurveShape::Kind::power;
      const std::vector<CurveQuantity> quantities = curve_quantities(*found.model.curve);
      count(uncertainty.interval(quantities[0]), is_power ? 2.2 : 4 / curve_end);
      count(uncertainty.interval(quantities[1]), tissue.spring * tissue.curve.force_at(curve_end));
      count(uncertainty.interval(ElementQuantity{0}), tissue.spring);
      count(uncertainty.interval(ElementQuantity{1}), tissue.branch);
    }
  EXPECT_LE(spurious, 2);  // of 12; one noise for both tissues
  EXPECT_GE(values, 40);
  EXPECT_GE(held, 0.85 * values) << "of " << values;
}

// Fails if a straight tissue is said to stiffen, or one that stiffens to be straight.
TEST(CurveShapes, AreLeftOutWhereNothingStiffens) {
  const std::vector<Recording> files{answered(sample_networks()[0], 0.005, Noise::white, 5)};
  const Problem problem(files, Form::stiffness, Weighting::uniform, all_rows);
  const Reduction found = reduce(problem, with_shape(ShapeChoice::automatic));
  EXPECT_FALSE(found.model.curve);
  ASSERT_EQ(found.shapes.size(), 4u);
  EXPECT_FALSE(found.shapes[0].kind);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(found.shapes[i].criterion, found.shapes[0].criterion);
}

// Fails if a few rows far apart are not reproduced: with the secant to the row before in place of the tangent, 20 rows
// of Hertz' curve come out with a power of 1.489.
TEST(CurveShapes, AreExactAtRowsFarApart) {
  Recording recording;
  for (int i = 0; i <= 20; ++i) {
    const double u = curve_end * i / 20;
    recording.time.push_back(i);
    recording.position.push_back(u);
    recording.force.push_back(2 * std::pow(u / curve_end, 1.5));
  }
  const std::vector<Recording> files{recording};
  const Problem problem(files, Form::stiffness, Weighting::uniform, all_rows);
  ReductionChoices choices = with_shape(ShapeChoice::power);
  choices.is_elastic = true;
  const Model model = reduce(problem, choices).model;
  ASSERT_EQ(model.terms.size(), 1u);
  EXPECT_NEAR(model.curve->parameters()[0], 1.5, 1e-6);
  EXPECT_NEAR(value_of(model, CurveQuantity{CurveQuantity::Kind::force, curve_end}), 2, 1e-6);
}

// Fails if a muscle that is known to stiffen leaves more behind a curve than another implementation found: with a power
// R² 0.97982 and 0.3767 kPa, relaxations on a grid of two a decade; with a map that is an exponential, which makes a
// curve that is none, 0.98607 and 0.3130 kPa.
TEST(CurveShapes, Titin) {
  const std::vector<Recording> files = titin();
  const Problem problem(files, Form::stiffness, Weighting::uniform, all_rows);
  std::vector<Term> terms = plain_terms(problem);
  for (const double time : even_grid({0.002, 2000}, 2)) terms.push_back({TermKind::maxwell, time, 0, 0, 0});
  const auto rms_behind = [&](const CurveShape& curve) {
    return 1e3 * std::sqrt(solve_weights(problem, terms, {}, curve).residual_sum / problem.weighed_rows());
  };
  double of_powers = 1, of_exponentials = 1;
  for (double p = 2.6; p < 3.6; p += 0.02)
    of_powers = std::min(of_powers, rms_behind(CurveShape::power(p, problem.curve_reach())));
  for (double x = 2; x < 8; x += 0.1)
    of_exponentials = std::min(of_exponentials, rms_behind(CurveShape::exponential(x, problem.curve_reach())));
  EXPECT_NEAR(of_powers, 0.3767, 0.005 * 0.3767);
  EXPECT_LE(of_exponentials, 0.3130);
}

// Three sines whose sum turns often, at one period, pressed in all the time.
Recording pressed_motion() {
  Recording recording;
  for (int i = 0; i < 1200; ++i) {
    const double t = i / 200.0;
    recording.time.push_back(t);
    recording.position.push_back(1.3e-3 * (1 - std::cos(0.9 * t)) + 2e-4 * std::sin(7 * t) * std::sin(0.3 * t));
  }
  recording.name = "made.csv";
  return recording;
}

// Fails if the file that is written is not the law that was told, up to what the compiler's cubics are off by: a
// two-thousandth of the largest force at rest, and here all of it may relax.
TEST(CurveShapes, StandInTheFileAsTheyAreTold) {
  for (const ShapeChoice shape : {ShapeChoice::power, ShapeChoice::exponential, ShapeChoice::table})
    for (const double spring : {200.0, 0.0}) {
      std::vector<Recording> files{pressed_motion()};
      const CurveShape curve =
          shape == ShapeChoice::power ? CurveShape::power(1.8, curve_end) : CurveShape::exponential(3, curve_end);
      files[0].force = forces_of({curve, spring, 0, 300, spring > 0 ? 0.5 : 5}, files[0]);
      const std::vector<double> added = noise(files[0].force.size(), 1e-3, Noise::white, 3);
      for (std::size_t i = 0; i < added.size(); ++i) files[0].force[i] += added[i];
      FitChoices choices;
      choices.reduction = with_shape(shape);
      Diagnostics diagnostics;
      const auto found = fit(files, {}, choices, diagnostics);
      ASSERT_TRUE(found) << render_text(diagnostics);
      EXPECT_EQ(found->text.find("instantaneous") == std::string::npos, spring > 0) << found->text;
      const SourceFile source("fitted.json", found->text);
      Choices compiled;
      compiled.rate = 200;
      const auto compilation = compile(source, compiled, std::nullopt, diagnostics);
      ASSERT_TRUE(compilation && !diagnostics.has_errors()) << render_text(diagnostics) << found->text;
      Evaluation<double> law(compilation->law);
      law.reset(0);
      double peak = 0, worst = 0, last = 0;
      for (std::size_t i = 0; i < files[0].time.size(); ++i) {
        const double u = files[0].position[i], velocity = (u - last) * 200;
        last = u;
        const command<double> now = law.step(u, velocity);
        peak = std::max(peak, std::abs(now.force));
        worst = std::max(worst, std::abs(now.damping * velocity + now.force - found->files[0].answer[i]));
      }
      EXPECT_LE(worst, 1e-3 * peak) << found->text;
    }
}

}  // namespace
}  // namespace dashpot::compiler::fitting
