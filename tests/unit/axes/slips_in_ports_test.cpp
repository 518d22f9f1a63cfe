// What is certified of ports with slips (theory, section 12).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "compile_axes.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

AxesDevice serial_arm(int delay) {
  const SourceFile file("arm.json", fmt::format(R"({{ "dashpot_device": 1, "axes": 2, "name": "arm",
      "kinematics": {{ "kind": "serial", "links": [0.063, 0.075],
        "workspace": {{ "x": [-0.03, 0.03], "y": [0.07, 0.11] }} }},
      "loop": {{ "rate": 1000, "delay_samples": {} }}, "encoders": {{ "max_speed": 0.01 }},
      "velocity": {{ "estimator": "backward_difference", "window": 5 }},
      "brakes": [ {{ "along": [1, 0], "kind": "eddy_current", "max_damping": 100 }},
                  {{ "along": [0, 1], "kind": "eddy_current", "max_damping": 100 }} ] }})",
                                                delay));
  Diagnostics diagnostics;
  const std::optional<AxesDeviceDecl> decl = parse_axes_device(file, diagnostics);
  return *build_axes_device(*decl, diagnostics);
}

// Of a wall that begins at y [m], with a network behind it.
AxesCertificate certificate_of(const std::string& network, double y, int delay) {
  const SourceFile file("wall.json", fmt::format(R"({{ "dashpot": 1, "axes": 2, "name": "slipping", "ports": [
      {{ "name": "wall", "map": {{ "wall": {{ "through": [0, {}], "normal": [0, 1] }} }}, "network": {} }} ] }})",
                                                 y, network));
  Diagnostics diagnostics;
  StageTimes times;
  return compile_axes(file, {}, serial_arm(delay), diagnostics, times)->certificate;
}

// If this failed, the force of a spring that goes on pulling when the slip beside it has given way would not be counted
// where it turns with the joints: trembling to and fro would give out energy. Such a spring is at rest where the tool
// began, so that no less is needed than of one that is at rest at either end of the workspace.
TEST(SlipsInPorts, SpringsRoundThemCountAsSpringsDo) {
  const std::string round =
      R"({ "series": [ { "spring": 1000 }, { "parallel": [ { "slip": 0.01 }, { "spring": 99e3 } ] } ] })";
  for (const int delay : {0, 1}) {
    const AxesCertificate behind = certificate_of(round, 0.09, delay);
    EXPECT_TRUE(behind.certified);
    for (const double end : {0.07, 0.11})
      EXPECT_GE(behind.needed, certificate_of(R"({ "spring": 990 })", end, delay).needed) << delay << " " << end;
  }
}

}  // namespace
}  // namespace dashpot::compiler
