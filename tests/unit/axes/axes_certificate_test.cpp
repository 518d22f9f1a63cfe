// What is certified of laws of two axes (theory, section 12).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "compile_axes.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

using Directions = std::pair<std::string, std::string>;

AxesDevice arm(const std::string& kinematics, int delay, const Directions& brakes = {"[1, 0]", "[0, 1]"}) {
  const SourceFile file("arm.json", fmt::format(R"({{ "dashpot_device": 1, "axes": 2, "name": "arm",
      "kinematics": {},
      "loop": {{ "rate": 1000, "delay_samples": {} }}, "encoders": {{ "max_speed": 0.01 }},
      "velocity": {{ "estimator": "backward_difference", "window": 5 }},
      "brakes": [ {{ "along": {}, "kind": "eddy_current", "max_damping": 100 }},
                  {{ "along": {}, "kind": "eddy_current", "max_damping": 100 }} ] }})",
                                                kinematics, delay, brakes.first, brakes.second));
  Diagnostics diagnostics;
  const std::optional<AxesDeviceDecl> decl = parse_axes_device(file, diagnostics);
  return *build_axes_device(*decl, diagnostics);
}

const char* const serial = R"({ "kind": "serial", "links": [0.063, 0.075],
    "workspace": { "x": [-0.03, 0.03], "y": [0.07, 0.11] } })";

// Of a wall that begins at y [m], with a network behind it, and what else its port has.
AxesCertificate certificate_of(const std::string& network, double y, const AxesDevice& device,
                               const std::string& besides = "") {
  const SourceFile file("wall.json", fmt::format(R"({{ "dashpot": 1, "axes": 2, "name": "slipping", "ports": [
      {{ "name": "wall", "map": {{ "wall": {{ "through": [0, {}], "normal": [0, 1] }} }}, "network": {} {} }} ] }})",
                                                 y, network, besides));
  Diagnostics diagnostics;
  StageTimes times;
  return compile_axes(file, {}, device, diagnostics, times)->certificate;
}

// If this failed, the force of a spring that goes on pulling when the slip beside it has given way would not be counted
// where it turns with the joints: trembling to and fro would give out energy. Such a spring is at rest where the tool
// began, so that no less is needed than of one that is at rest at either end of the workspace.
TEST(SlipsInPorts, SpringsRoundThemCountAsSpringsDo) {
  const std::string round =
      R"({ "series": [ { "spring": 1000 }, { "parallel": [ { "slip": 0.01 }, { "spring": 99e3 } ] } ] })";
  for (const int delay : {0, 1}) {
    const AxesCertificate behind = certificate_of(round, 0.09, arm(serial, delay));
    EXPECT_TRUE(behind.certified);
    for (const double end : {0.07, 0.11})
      EXPECT_GE(behind.needed, certificate_of(R"({ "spring": 990 })", end, arm(serial, delay)).needed)
          << delay << " " << end;
  }
}

// If this failed, a joint would get less than x W from brakes that do not lie along the joints, or that lie along one
// of two unequal links: trembling of that joint would give out energy.
TEST(AxesCertificate, AddsToTheBrakesWhatEachJointNeeds) {
  const char* const unequal = R"({ "kind": "parallelogram", "links": [0.04, 0.16],
      "workspace": { "x": [-0.02, 0.02], "y": [0.15, 0.17] } })";
  const Directions pairs[] = {{"[1, 0]", "[0, 1]"}, {"[0, 2]", "[1, 0]"}, {"[1, 1]", "[1, -1]"}, {"[1, 1]", "[0, 1]"}};
  for (const Directions& brakes : pairs) {
    SCOPED_TRACE(brakes.first + brakes.second);
    const AxesDevice device = arm(unequal, 0, brakes);
    const AxesCertificate certificate = certificate_of(R"({ "spring": 500 })", 0.14, device);
    ASSERT_TRUE(certificate.certified);
    ASSERT_GT(certificate.missing, 0);
    axes::Symmetric<double> made{0, 0, 0};
    for (std::size_t k = 0; k < 2; ++k)
      made = made + certificate.added[k] * (1 - device.brakes[k].brake.tolerance) * axes::outer(device.brakes[k].along);
    const double x = certificate.missing, first = made.xx - x * certificate.weight[0],
                 second = made.yy - x * certificate.weight[1];
    EXPECT_GE(first, 0);
    EXPECT_GE(second, 0);
    EXPECT_GE(first * second - made.xy * made.xy, -1e-9 * x * x * certificate.weight[0] * certificate.weight[1]);
  }
}

// Fails if a contact that lets go by an estimate, or dampers behind slips, are certified where commands act later than
// their samples: no bound of two axes covers them there.
TEST(AxesCertificate, IsRefusedWhereDampersLetGoInALateLoop) {
  const char* const solid = R"({ "parallel": [ { "spring": 300 }, { "damper": 0.2 } ] })";
  const std::string slipping = fmt::format(R"({{ "series": [ {{ "slip": 1 }}, {} ] }})", solid);
  EXPECT_TRUE(certificate_of(solid, 0.09, arm(serial, 0), R"(, "contact": { "at": 0 })").certified);
  for (const int delay : {1, 3}) {
    const AxesDevice late = arm(serial, delay);
    EXPECT_FALSE(certificate_of(solid, 0.09, late, R"(, "contact": { "at": 0 })").certified) << delay;
    EXPECT_FALSE(certificate_of(slipping, 0.09, late).certified) << delay;
  }
}

}  // namespace
}  // namespace dashpot::compiler
