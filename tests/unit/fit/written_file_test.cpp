// What `dashpot fit` writes: it compiles, and what is told of it is what the compiler makes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "fit/fit.hpp"
#include "fit/network_text.hpp"
#include "fit/written_network.hpp"
#include "recordings.hpp"
#include "synthetic.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr double rate = 200;  // [Hz]

// Three sines whose sum turns often, at one period.
Recording uniform_motion() {
  Recording recording;
  for (int i = 0; i < 2000; ++i) {
    const double t = i / rate;
    recording.time.push_back(t);
    recording.position.push_back(2e-3 * std::sin(0.9 * t) + 1e-3 * std::sin(7 * t) + 3e-4 * std::sin(31 * t));
  }
  recording.force.assign(recording.time.size(), 0.0);
  return recording;
}

Recording answering(const Model& network, double share) {
  Recording recording = uniform_motion();
  const std::vector<Recording> alone{recording};
  const Problem problem(alone, Form::stiffness, Weighting::uniform, 1'000'000);
  const Eigen::VectorXd force = problem.columns(network.terms) * network.weights;
  const std::vector<double> added = noise(recording.time.size(), share * force.cwiseAbs().maxCoeff(), Noise::white, 11);
  for (std::size_t i = 0; i < added.size(); ++i) recording.force[i] = force[static_cast<Eigen::Index>(i)] + added[i];
  recording.name = "made.csv";
  return recording;
}

Model with_stop(Model model, double stiffness, double threshold) {
  model.terms.push_back({TermKind::stop, 0, threshold, 0, 0});
  model.weights.conservativeResize(model.weights.size() + 1);
  model.weights[model.weights.size() - 1] = stiffness;
  return model;
}

// As `dashpot simulate` runs a law over a motion.
std::vector<double> simulated(const std::string& text, const Recording& recording) {
  const SourceFile source("fitted.json", text);
  Diagnostics diagnostics;
  Choices choices;
  choices.rate = rate;
  const auto compilation = compile(source, choices, std::nullopt, diagnostics);
  EXPECT_TRUE(compilation && !diagnostics.has_errors()) << render_text(diagnostics) << text;
  std::vector<double> forces;
  if (!compilation) return forces;
  Evaluation<double> law(compilation->law);
  law.reset(0);
  double last = 0;
  for (std::size_t i = 0; i < recording.time.size(); ++i) {
    const double velocity = i == 0 ? 0 : (recording.position[i] - last) * rate;
    last = recording.position[i];
    const command<double> now = law.step(recording.position[i], velocity);
    forces.push_back(now.damping * velocity + now.force);
  }
  return forces;
}

std::optional<Fit> fitted(const std::vector<Recording>& files, FitChoices choices = {}) {
  Diagnostics diagnostics;
  auto result = fit(files, {}, choices, diagnostics);
  EXPECT_TRUE(result) << render_text(diagnostics);
  return result;
}

// Fails if the residual that is told is not that of the file as the compiler runs it: exact for positions that are
// linear between rows, so but for rounding.
TEST(WrittenFile, IsWhatSimulateRuns) {
  std::vector<Model> networks = sample_networks();
  networks.push_back(with_stop(network_of(100, 1, {{150, 0.4}}), 400, 6e-4));
  for (const Model& network : networks)
    for (const double share : {0.0, 0.01}) {
      const std::vector<Recording> files{answering(network, share)};
      FitChoices choices;
      if (network.count(TermKind::stop) > 0) choices.reduction.slips = SlipChoice::stops;
      const auto result = fitted(files, choices);
      ASSERT_TRUE(result);
      const std::vector<double> forces = simulated(result->text, files[0]);
      ASSERT_EQ(forces.size(), files[0].time.size());
      double peak = 0, worst = 0, sum = 0;
      for (std::size_t i = 0; i < forces.size(); ++i) {
        peak = std::max(peak, std::abs(forces[i]));
        worst = std::max(worst, std::abs(forces[i] - result->files[0].answer[i]));
        sum += std::pow(forces[i] - files[0].force[i], 2);
      }
      EXPECT_LE(worst, 1e-9 * peak) << result->text;
      const double rms = std::sqrt(sum / static_cast<double>(forces.size()));
      EXPECT_NEAR(rms, result->rms, 1e-9 * peak);
    }
}

// Fails if a linear network is said to be impossible and is found all the same: with noise far below the force, a floor
// on a grid of times alone is above networks whose times are free.
TEST(WrittenFile, IsNotBelowTheFloor) {
  std::vector<std::vector<Recording>> sets = {titin(), adhesive()};
  for (const Model& network : sample_networks()) sets.push_back({answering(network, 1e-5)});
  for (const std::vector<Recording>& files : sets) {
    const auto result = fitted(files);
    ASSERT_TRUE(result);
    for (const PathEntry& entry : result->path)
      EXPECT_GE(entry.rms, result->floor_rms * (1 - 1e-9)) << entry.parameters;
    EXPECT_GE(result->rms, result->floor_rms * (1 - 1e-9));
  }
}

// Fails if a number in the file does not read back as the one that was told.
TEST(WrittenFile, HoldsWhatItTells) {
  const std::vector<Recording> files{answering(sample_networks()[2], 0.01)};
  FitChoices choices;
  choices.name = "two_branches";
  choices.source = "made \"up\"";
  const auto result = fitted(files, choices);
  ASSERT_TRUE(result);
  const SourceFile source("two_branches.json", result->text);
  Diagnostics diagnostics;
  const auto network = check(source, diagnostics);
  ASSERT_TRUE(network) << render_text(diagnostics);
  EXPECT_TRUE(render_text(diagnostics).empty()) << render_text(diagnostics);
  EXPECT_EQ(network->name, "two_branches");
  EXPECT_EQ(network->source, "made \"up\"");
  ASSERT_TRUE(network->valid.displacement && network->valid.rate && network->valid.frequency);
  for (const double position : files[0].position) EXPECT_TRUE(network->valid.displacement->contains(position));
  for (const FittedElement& element : result->elements) {
    ASSERT_TRUE(element.interval) << element.name;
    EXPECT_LT(element.interval->low, element.value);
    EXPECT_GT(element.interval->high, element.value);
    EXPECT_NE(result->text.find("\"" + element.text + "\""), std::string::npos);
  }
}

// Fails if the bootstrap is about another network than the one that was fitted: what that one leaves on average in a
// file must not be drawn.
TEST(WrittenFile, IsWithinItsBootstrap) {
  FitChoices choices;
  choices.reduction.slips = SlipChoice::stops;
  choices.reduction.modes = 2;
  choices.reduction.stops = 2;
  const auto result = fitted(adhesive(), choices);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->elements.size(), 9u);
  for (const FittedElement& element : result->elements) {
    ASSERT_TRUE(element.spread) << element.name;
    EXPECT_LT(element.spread->low, element.value) << element.name;
    EXPECT_GT(element.spread->high, element.value) << element.name;
  }
}

// Fails if a recorded set of several files, with a springpot, or over frequency, makes a file that does not compile.
TEST(WrittenFile, OfPublishedRecordingsCompiles) {
  struct Case {
    std::vector<Recording> files;
    FitChoices choices;
  };
  std::vector<Case> cases(4);
  cases[0].files = titin();
  cases[1].files = adhesive();
  cases[1].choices.reduction.slips = SlipChoice::viscous;
  cases[1].choices.reduction.gains_are_free = true;
  cases[2].files = recordings({"rheos/data_freq.csv"}, {"omega=1:rad/s,storage=2:N/m,loss=3:N/m", "", false});
  cases[2].choices.weighting = Weighting::relative;
  cases[2].choices.reduction.springpots = true;
  cases[3].files =
      recordings({"brain/brain_relax_amedieu2004.csv"}, {"time=t:s,modulus=relax_normalised:N/m", "", true, true});
  for (Case& one : cases) {
    const auto result = fitted(one.files, one.choices);
    ASSERT_TRUE(result);
    const SourceFile source("fitted.json", result->text);
    Diagnostics diagnostics;
    EXPECT_TRUE(compile(source, {}, std::nullopt, diagnostics)) << render_text(diagnostics) << result->text;
    EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics) << result->text;
    // The file's digits may cost a thousandth of the rms, as promised, and no more.
    double sum = 0;
    for (const FileScore& file : result->files) sum += file.rms * file.rms * static_cast<double>(file.rows);
    EXPECT_GT(sum, 0);
  }
}

// Fails if a creep recording does not give back the Kelvin elements that made it.
TEST(WrittenFile, OfCreepIsAChainOfKelvinElements) {
  Recording creep;
  creep.kind = RecordingKind::creep;
  creep.name = "creep.csv";
  for (int i = 0; i < 200; ++i) {
    const double t = 0.01 * std::pow(1e4, i / 199.0);
    creep.time.push_back(t);
    creep.force.push_back(1 / 500.0 + t / 4000 - std::expm1(-t / 0.5) / 300);
  }
  FitChoices choices;
  choices.form = Form::compliance;
  const auto result = fitted({creep}, choices);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->elements.size(), 4u) << result->text;
  const double expected[] = {500, 4000, 300, 150};  // K0, B0, K1, B1
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(result->elements[i].value / expected[i], 1, 1e-5);
  Diagnostics diagnostics;
  const SourceFile source("creep.json", result->text);
  EXPECT_TRUE(compile(source, {}, std::nullopt, diagnostics)) << render_text(diagnostics);
}

// Fails if a recording under controlled force is not fitted as compliance.
TEST(WrittenFile, OfControlledForce) {
  Recording recording = uniform_motion();
  recording.name = "pushed.csv";
  for (std::size_t i = 0; i < recording.time.size(); ++i) recording.force[i] = 1000 * recording.position[i];
  std::vector<Recording> files{recording};
  {
    const Problem problem(files, Form::compliance, Weighting::uniform, 1'000'000);
    const Eigen::VectorXd kelvin = problem.column({TermKind::maxwell, 0.2, 0, 0, 0});
    for (std::size_t i = 0; i < recording.time.size(); ++i)
      files[0].position[i] = kelvin[static_cast<Eigen::Index>(i)] / 250 + recording.force[i] / 800;
  }
  FitChoices choices;
  choices.form = Form::compliance;
  const auto result = fitted(files, choices);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->elements.size(), 3u) << result->text;
  EXPECT_NEAR(result->elements[0].value, 800, 0.01);
  EXPECT_NEAR(result->elements[1].value, 250, 0.01);
  EXPECT_NEAR(result->elements[2].value, 50, 0.01);
}

// Fails if an offset of the force sensor, or a record that begins in mid-motion, ends up in the network.
TEST(WrittenFile, KeepsTheSensorOutOfTheNetwork) {
  const Model truth = network_of(100, 0, {{150, 0.5}});
  Recording recording = answering(truth, 0.001);
  for (double& force : recording.force) force += 0.05;
  FitChoices choices;
  choices.reduction.beside = {{TermKind::offset, 0, 0, 0, 0}};
  const auto tared = fitted({recording}, choices);
  ASSERT_TRUE(tared);
  EXPECT_NEAR(tared->files[0].offset, 0.05, 0.001);
  ASSERT_EQ(tared->elements.size(), 3u);
  EXPECT_NEAR(tared->elements[0].value, 100, 1);
  Recording late = answering(truth, 0.001);
  for (std::vector<double>* values : {&late.time, &late.position, &late.force})
    values->erase(values->begin(), values->begin() + 300);
  const double origin = late.position.front();
  for (double& position : late.position) position -= origin;
  choices.reduction.in_motion = {0};
  const auto moving = fitted({late}, choices);
  ASSERT_TRUE(moving);
  ASSERT_EQ(moving->elements.size(), 3u) << moving->text;
  EXPECT_NEAR(moving->elements[0].value, 100, 2);
  EXPECT_NEAR(moving->elements[1].value, 150, 3);
}

// Fails if the place of the surface is not found.
TEST(WrittenFile, FindsTheSurface) {
  Recording recording = probing_motion();
  const double at = 4e-4;
  const Model truth = network_of(300, 0, {{200, 0.5}});
  const std::vector<Recording> pressed = behind_surface({recording}, at);
  const Problem problem(pressed, Form::stiffness, Weighting::uniform, 1'000'000);
  const Eigen::VectorXd force = problem.columns(truth.terms) * truth.weights;
  for (std::size_t i = 0; i < recording.force.size(); ++i) recording.force[i] = force[static_cast<Eigen::Index>(i)];
  EXPECT_NEAR(find_contact({recording}), at, 2e-6);
}

// Pressed in, held, let go of faster than the tissue comes back, pressed in again before it has, and withdrawn: from
// the tool's zero, the surface at 1 mm.
Recording pressing_motion() {
  constexpr double corners[][2] = {{0, 0},      {2, 4e-3},   {4, 4e-3}, {4.2, 0.5e-3},
                                   {4.6, 3e-3}, {6, 3.5e-3}, {6.3, 0},  {8, 0}};
  Recording recording;
  for (int i = 0; i <= 1600; ++i) {
    const double t = i / rate;
    int k = 0;
    while (t > corners[k + 1][0] && k < 6) ++k;
    const double share = (t - corners[k][0]) / (corners[k + 1][0] - corners[k][0]);
    recording.time.push_back(t);
    recording.position.push_back(corners[k][1] + share * (corners[k + 1][1] - corners[k][1]));
  }
  recording.force.assign(recording.time.size(), 0.0);
  recording.name = "pressed.csv";
  return recording;
}

std::string touched_tissue(const std::string& curve, const std::string& more) {
  return R"({ "dashpot": 1, "name": "touched", "contact": { "at": "1 mm" }, )" + curve +
         R"("network": { "parallel": [ { "spring": "300 N/m" }, )" + more +
         R"({ "series": [ { "spring": "200 N/m" }, { "damper": "100 N s/m" } ] } ] } })";
}

constexpr const char* stiffening = R"("static": { "exponential": "400 1/m", "force": "1 N", "at": "3 mm" }, )";

struct Touched {
  const char* what;
  std::string tissue;
  ShapeChoice shape;
};

std::vector<Touched> touched_tissues() {
  return {{"straight", touched_tissue("", ""), ShapeChoice::none},
          {"exponential", touched_tissue(stiffening, ""), ShapeChoice::exponential}};
}

// Fails if what is told of a fit behind a surface is not what the written file does, where it pushes and where the tool
// has left it; or if rows in which nothing touches are taken for the tissue's.
TEST(WrittenFile, IsWhatSimulateRunsBehindASurface) {
  for (const Touched& one : touched_tissues()) {
    Recording recorded = pressing_motion();
    recorded.force = simulated(one.tissue, recorded);
    FitChoices choices;
    choices.contact = 1e-3;
    choices.reduction.shape = one.shape;
    const auto result = fitted(behind_surface({recorded}, *choices.contact), choices);
    ASSERT_TRUE(result);
    const std::vector<double> forces = simulated(result->text, recorded);
    double peak = 0, worst = 0, wrong = 0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      peak = std::max(peak, std::abs(forces[i]));
      worst = std::max(worst, std::abs(forces[i] - result->files[0].answer[i]));
      wrong = std::max(wrong, std::abs(forces[i] - recorded.force[i]));
    }
    // A curve is compiled to cubics that are off by a two-thousandth, in what is fitted to as in what was fitted.
    const double off = (one.shape == ShapeChoice::none ? 1e-9 : 1e-3) * peak;
    EXPECT_LE(worst, off) << one.what << result->text;
    EXPECT_LE(wrong, 2 * off + 1e-4 * peak) << one.what << result->text;
    EXPECT_GT(result->files[0].free_rows, 20u) << one.what;
    EXPECT_LT(result->files[0].free_rows, 600u) << one.what;
    for (const FittedElement& element : result->elements)
      for (const auto& [name, value] : {std::pair("K0", 300.0), std::pair("K1", 200.0), std::pair("B1", 100.0)})
        if (one.shape == ShapeChoice::none && element.name == name) {
          EXPECT_NEAR(element.value, value, 1e-3 * value) << result->text;
        }
  }
}

// Fails if validity is told from anywhere but the tool's zero, from which all who read the file take it.
TEST(WrittenFile, IsValidWhereTheToolHasBeen) {
  Recording recorded = pressing_motion();
  recorded.force = simulated(touched_tissue("", ""), recorded);
  for (double& position : recorded.position) position -= 0.4e-3;
  FitChoices choices;
  choices.contact = 0.6e-3;
  const auto result = fitted(behind_surface({recorded}, *choices.contact), choices);
  ASSERT_TRUE(result);
  Diagnostics diagnostics;
  const SourceFile source("fitted.json", result->text);
  const auto network = check(source, diagnostics);
  ASSERT_TRUE(network) << render_text(diagnostics);
  EXPECT_NEAR(network->valid.displacement->low, -0.4e-3, 1e-9);
  EXPECT_NEAR(network->valid.displacement->high, 3.6e-3, 1e-9);
}

// Fails if the surface of tissue that stiffens, or that the tool leaves, is looked for behind a straight network alone,
// or with rows in which nothing touches. Cubics that are off by a two-thousandth of the force move it by some microns.
TEST(WrittenFile, FindsTheSurfaceTogetherWithTheShape) {
  std::vector<Touched> tissues = touched_tissues();
  // Powers between those that a scan begins with.
  for (const char* power : {"1.3", "1.7", "2.4"})
    tissues.push_back(
        {power,
         touched_tissue(std::string(R"("static": { "power": )") + power + R"(, "force": "1 N", "at": "3 mm" }, )", ""),
         ShapeChoice::power});
  for (const Touched& one : tissues) {
    Recording recorded = pressing_motion();
    recorded.force = simulated(one.tissue, recorded);
    ReductionChoices choices;
    choices.shape = one.shape == ShapeChoice::none ? ShapeChoice::none : ShapeChoice::automatic;
    EXPECT_NEAR(find_contact({recorded}, choices), 1e-3, 1e-5) << one.what;
  }
}

// Fails if an interval that is written or told does not hold the numbers that it is of.
TEST(WrittenFile, RoundsIntervalsOutwards) {
  const auto ends = [](double low, double high, const char* unit) { return interval_ends({low, high}, unit); };
  EXPECT_EQ(ends(60.014, 60.014, "N/m"), std::pair(std::string("60.01 N/m"), std::string("60.02 N/m")));
  EXPECT_EQ(ends(60.0137, 60.0143, "N/m"), std::pair(std::string("60.0137 N/m"), std::string("60.0143 N/m")));
  EXPECT_EQ(ends(249.99, 250.01, "1/m"), std::pair(std::string("249.99 1/m"), std::string("250.01 1/m")));
  EXPECT_EQ(ends(2.4999, 2.5001, ""), std::pair(std::string("2.4999"), std::string("2.5001")));
  EXPECT_EQ(ends(0.25, 0.5, "N"), std::pair(std::string("250 mN"), std::string("500 mN")));
}

}  // namespace
}  // namespace dashpot::compiler::fitting
