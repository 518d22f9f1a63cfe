// Several ports on one axis, against each of them by itself.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "law/evaluate.hpp"
#include "static_case.hpp"
#include "support/random.hpp"
#include "support/repetitions.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

std::string side_by_side(const std::string& ports) {
  return R"({ "dashpot": 1, "name": "both", "ports": [ )" + ports + " ] }";
}

// Linear with relaxations, behind a curve, in contact, with slips in a tree and in a mesh of them.
std::string random_port(Random& random, int number) {
  const double stiffness = random.log_uniform(50, 1000);
  const std::string relaxing =
      fmt::format(R"({{ "spring": {:.9g} }}, {{ "series": [ {{ "spring": {:.9g} }}, {{ "damper": {:.9g} }} ] }})",
                  stiffness, random.log_uniform(50, 1000), random.log_uniform(1, 50));
  std::string inside;
  switch (random.index(4)) {
    case 0: inside = fmt::format(R"("network": {{ "parallel": [ {}, {{ "damper": 2 }} ] }})", relaxing); break;
    case 1:
      inside = fmt::format(
          R"("static": {{ "power": {:.6g}, "force": 2, "at": 0.005 }}, "network": {{ "parallel": [ {} ] }})",
          random.uniform(1, 3), relaxing);
      break;
    case 2:
      inside = fmt::format(R"("network": {{ "parallel": [ {} ] }}, "contact": {{ "at": {:.6g} }})", relaxing,
                           random.uniform(-2e-3, 2e-3));
      break;
    default:
      inside = fmt::format(
          R"("network": {{ "parallel": [ {}, {{ "series": [ {{ "spring": 900 }}, {{ "slip": {:.6g} }} ] }} ] }})",
          relaxing, random.uniform(0.1, 2));
  }
  return fmt::format(R"({{ "name": "port_{}", {} }})", number, inside);
}

// If this fails, what several ports make is not the sum of what each makes by itself.
TEST(Ports, AddUp) {
  for (std::uint64_t seed = 1; seed <= repetitions(24, 1000); ++seed) {
    Random random(seed);
    std::string ports;
    for (int i = 0, count = 1 + int(random.index(4)); i < count; ++i)
      ports += (i == 0 ? "" : ", ") + random_port(random, i);
    const Compilation c = compiled(side_by_side(ports));
    Evaluation<double> all(c.law);
    std::vector<Evaluation<double>> each;
    for (const Compilation& port : c.ports) each.emplace_back(port.law);
    const double start = random.uniform(-3e-3, 3e-3);
    all.reset(start);
    for (Evaluation<double>& port : each) port.reset(start);
    for (int k = 0; k < 300; ++k) {
      const double u = start + 4e-3 * std::sin(0.05 * k) * std::sin(0.011 * k), v = random.uniform(-1, 1);
      const command<double> now = all.step(u, v);
      double force = 0, damping = 0, size = 0, stored = 0;
      for (Evaluation<double>& port : each) {
        const command<double> part = port.step(u, v);
        force += part.force, damping += part.damping, size += std::abs(part.force);
        stored += port.stored_energy();
      }
      // Constant dampings are added up when they are written, the others at each sample: up to a rounding for each
      // port.
      ASSERT_NEAR(now.force, force, 4e-16 * size * double(each.size())) << seed << " " << ports;
      ASSERT_NEAR(now.damping, damping, 4e-16 * damping * double(each.size())) << seed << " " << ports;
      ASSERT_NEAR(all.stored_energy(), stored, 4e-16 * stored * double(each.size())) << seed << " " << ports;
    }
  }
}

// If this fails, a NaN or infinite sample reaches a port, or one that is makes another answer after it.
TEST(Ports, RefuseWhatIsNoNumber) {
  Random random(3);
  const Compilation c = compiled(side_by_side(random_port(random, 0) + ", " + random_port(random, 1) + ", " +
                                              R"({ "name": "soft", "static": { "power": 2, "force": 1, "at": 0.005 },
                                                   "network": { "spring": 100 }, "contact": { "at": 0.001 } })"));
  Evaluation<double> law(c.law), untouched(c.law);
  law.reset(std::numeric_limits<double>::quiet_NaN());
  untouched.reset(0);
  for (int k = 1; k <= 20; ++k) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(law.step(bad, 0).force, 0);
      EXPECT_EQ(law.step(0, bad).force, 0);
    }
    const command<double> now = law.step(3e-4 * k, 0.3), expected = untouched.step(3e-4 * k, 0.3);
    EXPECT_EQ(now.force, expected.force);
    EXPECT_EQ(now.damping, expected.damping);
  }
}

// If this fails, one port alone is another law than the same network without ports.
TEST(Ports, OneIsTheNetworkItself) {
  const std::string inside = R"("static": { "power": 1.5, "force": 2, "at": 0.005 },
    "network": { "parallel": [ { "spring": 400 }, { "series": [ { "spring": 200 }, { "damper": 40 } ] }, { "damper": 3 } ] })";
  const Compilation one = compiled(side_by_side(R"({ "name": "only", )" + inside + " }"));
  const Compilation itself = compiled(R"({ "dashpot": 1, "name": "itself", )" + inside + " }");
  Evaluation<double> port(one.law), law(itself.law);
  port.reset(1e-3), law.reset(1e-3);
  for (int k = 0; k < 500; ++k) {
    const double u = 4e-3 * std::sin(0.02 * k), v = std::cos(0.03 * k);
    const command<double> now = port.step(u, v), expected = law.step(u, v);
    ASSERT_EQ(now.force, expected.force);
    ASSERT_EQ(now.damping, expected.damping);
  }
}

Device limited_rig() {
  Diagnostics diagnostics;
  const SourceFile file("rig.json", R"({ "dashpot_device": 1, "name": "rig", "motion": "translation",
    "loop": { "rate": "2 kHz", "band": ["0.1 Hz", "20 Hz"] },
    "encoder": { "resolution": "1 um", "range": ["-6 mm", "6 mm"], "max_speed": "0.2 m/s" },
    "velocity": { "estimator": "backward_difference", "window": 4 },
    "motor": { "max_torque": "1 N" },
    "brake": { "kind": "eddy_current", "max_damping": "10 N s/m", "tolerance": "10 %" },
    "mechanics": { "inertia": "0.1 kg", "damping": "3 N s/m" } })");
  const std::optional<DeviceDecl> decl = parse_device(file, diagnostics);
  std::optional<Device> device = decl ? build_device(*decl, diagnostics) : std::nullopt;
  EXPECT_TRUE(device);
  return *device;
}

// If this fails, the ports together ask for more than the motor has, the shares do not make the whole, or what is told
// of what is kept is not the least of the ports.
TEST(Ports, KeepToTheirSharesOfTheMotor) {
  const std::string ports = R"({ "name": "spring_back", "network": { "spring": "3 kN/m" } },
    { "name": "pad", "static": { "power": 1.5, "force": "2 N", "at": "5 mm" }, "network": { "spring": "400 N/m" } },
    { "name": "guide", "network": { "parallel": [ { "damper": 1 }, { "series": [ { "spring": "2 kN/m" }, { "slip": "0.4 N" } ] } ] } })";
  const Device rig = limited_rig();
  const SourceFile file("both.json", side_by_side(ports));
  // A spring that no estimate moves may be clipped, and what slips or lies behind a curve sheds.
  for (const char* decomposition : {"", "velocity-free"}) {
    Diagnostics diagnostics;
    Choices choices;
    choices.decomposition = decomposition;
    const std::optional<Compilation> c = compile(file, choices, rig, diagnostics);
    ASSERT_TRUE(c);
    double brake = 0, own = 0, motor = 0, most_damping = 0;
    for (const Compilation& port : c->ports) {
      brake += port.share.brake, own += port.share.own_damping, motor += port.share.motor;
      most_damping += port.law.largest_damping;
    }
    for (const double sum : {brake, own, motor}) EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LE(most_damping, 10);
    EXPECT_EQ(c->certificate.limits.rule, LimitRule::sheds);
    const bool is_clipped = c->ports.front().certificate.limits.rule == LimitRule::clamps;
    EXPECT_EQ(is_clipped, std::string(decomposition) == "velocity-free");
    Evaluation<double> law(c->law);
    law.reset(0);
    double largest = 0, least_share = 1;
    for (int k = 0; k < 4000; ++k) {
      largest = std::max(largest, std::abs(law.step(5e-3 * std::sin(0.01 * k), 0.1 * std::cos(0.01 * k)).force));
      least_share = std::min(least_share, law.kept_share());
    }
    EXPECT_LE(largest, 1);
    EXPECT_GT(largest, 0.9);  // 15 N would be wanted
    EXPECT_LT(least_share, 1);
  }
}

}  // namespace
}  // namespace dashpot::testing
