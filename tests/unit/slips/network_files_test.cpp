// The networks with slips and contact that dashpot brings along, against their closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "compile.hpp"
#include "law/evaluate.hpp"
#include "source/render.hpp"
#include "support/shell_command.hpp"

namespace dashpot::testing {
namespace {

constexpr double period = 1e-3;  // [s]

// A file of networks/, through all stages at 1 kHz.
class NetworkFile {
 public:
  NetworkFile(const std::string& name, const std::string& decomposition)
      : source_(std::make_unique<compiler::SourceFile>(name, text_of(std::string(DASHPOT_NETWORKS) + "/" + name))) {
    compiler::Choices choices;
    choices.decomposition = decomposition;
    compiler::Diagnostics diagnostics;
    compilation_ = compiler::compile(*source_, choices, std::nullopt, diagnostics);
    if (!compilation_) throw std::runtime_error(compiler::render_text(diagnostics));
  }
  const compiler::UpdateLaw& law() const { return compilation_->law; }

 private:
  std::unique_ptr<compiler::SourceFile> source_;
  std::optional<compiler::Compilation> compilation_;
};

double whole_force(compiler::Evaluation<double>& law, double position, double velocity) {
  const command<double> now = law.step(position, velocity);
  return now.damping * velocity + now.force;
}

const char* const laws[] = {"velocity-free", "most-dissipative"};

}  // namespace

// Fails if the element of Fig. 10 in a steady slide is another than its yield force and both its dampers.
TEST(NetworkFiles, Figure10SlidesWithBothDampers) {
  for (const char* decomposition : laws) {
    const NetworkFile file("paper/visco_elasto_plastic.json", decomposition);
    compiler::Evaluation<double> law(file.law());
    double force = 0;
    for (int n = 1; n <= 400; ++n) force = whole_force(law, 0.03 * n * period, 0.03);
    // What the motor takes back of the brake is 1e-6 less than it may be.
    EXPECT_NEAR(force, 0.5 + (2.5 + 0.8) * 0.03, 1e-14 + 1.01e-6 * 0.8 * 0.03) << decomposition;
  }
}

// Fails if the organ in series takes part of a steady slide, or holds another energy than its springs do at that force.
TEST(NetworkFiles, AnOrganBehindFigure10SettlesAtTheSameForce) {
  for (const char* decomposition : laws) {
    const NetworkFile file("paper/visco_elasto_plastic_organ.json", decomposition);
    compiler::Evaluation<double> law(file.law());
    double force = 0;
    for (int n = 1; n <= 6000; ++n) force = whole_force(law, 0.03 * n * period, 0.03);
    // The slower Kelvin element has 45 relaxation times.
    const double whole = 0.5 + (2.5 + 0.8) * 0.03, through_spring = 0.5 + 0.8 * 0.03;
    // What the motor takes back of the brake, no more than 3.3 N·s/m, is 1e-6 less than it may be.
    EXPECT_NEAR(force, whole, 1e-11 + 1e-6 * 3.3 * 0.03) << decomposition;
    EXPECT_NEAR(law.stored_energy(),
                whole * whole / 2 * (1 / 400.0 + 1 / 150.0) + through_spring * through_spring / 2000, 1e-13)
        << decomposition;
  }
}

// Fails if a branch of the ten yields elsewhere than at Y_i/K_i on the virgin curve.
TEST(NetworkFiles, TenBranchesDrawTheVirginCurve) {
  const NetworkFile file("paper/maxwell_slip_ten.json", "most-dissipative");
  const double yields[] = {0.02, 0.038, 0.054, 0.068, 0.08, 0.09, 0.098, 0.104, 0.108, 0.11};
  compiler::Evaluation<double> law(file.law());
  for (int n = 1; n <= 1500; ++n) {
    const double u = 1e-6 * n;
    double expected = 0;
    for (int i = 0; i < 10; ++i) expected += std::min((200 - 10 * i) * u, yields[i]);
    EXPECT_NEAR(whole_force(law, u, 1e-3), expected, 1e-13) << n;
  }
}

// Fails if friction, presliding, drag or the organ's relaxation of the needle is off at any sample of an insertion: for
// a motion that is linear between samples all are exact.
TEST(NetworkFiles, TheNeedleGoesInByItsClosedForm) {
  const NetworkFile file("tissues/needle_in_liver.json", "most-dissipative");
  compiler::Evaluation<double> law(file.law());
  const double speed = 0.02, rate = 105.9 / 0.392;
  for (int n = 1; n <= 2000; ++n) {
    const double t = n * period, u = speed * t;
    const double expected = std::min(1000 * u, 1.5) + 5 * speed + 62.4 * u + 0.392 * speed * (1 - std::exp(-rate * t));
    ASSERT_NEAR(whole_force(law, u, speed), expected, 1e-12) << n;
  }
  EXPECT_EQ(whole_force(law, -0.01, -1), 0);
}

// Fails if the wall is anything but its spring and damper inside, or anything at all outside.
TEST(NetworkFiles, TheWallIsSpringAndDamper) {
  const NetworkFile file("paper/virtual_wall.json", "most-dissipative");
  compiler::Evaluation<double> law(file.law());
  for (int n = 1; n <= 100; ++n) EXPECT_EQ(whole_force(law, -0.01 + 1e-4 * n, 0.1), n < 100 ? 0 : 0.5);
  for (int n = 1; n <= 100; ++n) EXPECT_NEAR(whole_force(law, 1e-4 * n, 0.1), 500 * 1e-4 * n + 0.5, 1e-14);
}

}  // namespace dashpot::testing
