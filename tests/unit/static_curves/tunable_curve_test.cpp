// What parameters that change behind a static curve do to forces, and what the certificate makes of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "law/evaluate.hpp"
#include "static_case.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

constexpr double period = 1e-3, speed = 0.05, travel = 6e-3;  // [s], [m/s], [m] to either side

Device device(const std::string& motor = "1 MN", unsigned delay = 0) {
  const SourceFile file("rig.json", fmt::format(R"({{ "dashpot_device": 1, "name": "rig", "motion": "translation",
        "loop": {{ "rate": "1 kHz", "delay_samples": {}, "band": ["0.1 Hz", "20 Hz"] }},
        "encoder": {{ "resolution": "1 um", "range": ["-6 mm", "6 mm"], "max_speed": "50 mm/s" }},
        "velocity": {{ "estimator": "backward_difference", "window": 4 }}, "motor": {{ "max_torque": "{}" }},
        "mechanics": {{ "inertia": "0.1 kg", "damping": "50 N s/m" }} }})",
                                                delay, motor));
  Diagnostics diagnostics;
  return build_device(parse_device(file, diagnostics).value(), diagnostics).value();
}

Compilation on(const std::string& text, const Device& device) {
  Diagnostics diagnostics;
  Choices choices;
  choices.decomposition = 0.0;
  const SourceFile file("curved.json", text);
  std::optional<Compilation> c = compile(file, choices, device, diagnostics);
  EXPECT_TRUE(c && !diagnostics.has_errors()) << text;
  return std::move(*c);
}

std::string tuned(const std::string& parameters, const std::string& network, double force = 3) {
  return fmt::format(R"({{ "dashpot": 1, "name": "curved", "parameters": {{ {} }}, "network": {},
      "static": {{ "exponential": "1 1/mm", "force": "{} N", "at": "5 mm" }} }})",
                     parameters, network, force);
}
std::string parameter(const char* name, double value, double least, double most) {
  return fmt::format(R"("{}": {{ "value": {}, "tunable": true, "min": {}, "max": {} }})", name, value, least, most);
}

// With a damper whose value changes what is needed would be less than some value in its range asks for, or more than
// the worst of them by more than the bend of a relaxation's force does.
TEST(TunableCurve, NeedsWhatTheWorstDamperNeeds) {
  const char* const solid = R"({{ "parallel": [ {{ "spring": 400 }},
                                {{ "series": [ {{ "spring": 300 }}, {{ "damper": {} }} ] }} ] }})";
  const double over_box = on(tuned(parameter("B", 1, 0.05, 20), fmt::format(fmt::runtime(solid), R"("B")")), device())
                              .certificate.bound.needed;
  double worst = 0;
  for (const double damping : {0.05, 0.2, 1.0, 5.0, 20.0})
    worst =
        std::max(worst, on(tuned("", fmt::format(fmt::runtime(solid), damping)), device()).certificate.bound.needed);
  EXPECT_GE(over_box, worst);
  EXPECT_LE(over_box, 1.1 * worst);
}

// If this failed, a spring that stays and is made stiffer would need other than the curve of its stiffness does, but
// for what it holds beyond that while the tool moves on by some samples: the same map w with all of the curve's forces
// K/K0 times as large.
TEST(TunableCurve, NeedsWhatTheStiffestSpringNeeds) {
  const double over_box =
      on(tuned(parameter("K", 400, 100, 1600), R"({ "spring": "K" })"), device()).certificate.bound.needed;
  const double stiffest = on(tuned("", R"({ "spring": 1600 })", 12), device()).certificate.bound.needed;
  EXPECT_GE(over_box, stiffest);
  EXPECT_LE(over_box, 1.1 * stiffest);
}

// If this failed, rounds of stretching stiff, softening, letting back and stiffening would make a spring hold more and
// more.
TEST(TunableCurve, NoSpringHoldsMoreThanItsStiffest) {
  const Compilation c = on(tuned(parameter("K", 400, 100, 1600), R"({ "spring": "K" })"), device());
  const MotionMap& map = *c.network.map;
  const double change = map.steepest() * speed * period;
  for (const int half : {1, 3, 20, 60}) {
    Evaluation<double> law(c.law);
    law.reset(0);
    for (int k = 0; k < 20000; ++k) {
      const bool is_out = k / half % 2 == 0;
      if (k % half == 0) law.set({is_out ? 1600.0 : 100.0});
      const double u =
          std::clamp(3e-3 + (is_out ? k % half : half - k % half) * speed * period - 0.5e-3, -travel, travel);
      const double force = law.step(u, 0).force, w = map.value_at(std::abs(u));
      ASSERT_LE(std::abs(force), map.tangent_at(std::abs(u)) * 1600 * std::max(w + 2 * change, 3 * change) * (1 + 1e-9))
          << half << " " << k;
    }
  }
}

// If this failed, a softer spring that is not paid for would not keep its elongation, or a stiffer one its force: then
// the energy that the held command gives out would not be there.
TEST(TunableCurve, KeepsForceOfAStifferAndElongationOfASofterSpring) {
  const Compilation c = on(tuned(parameter("K", 400, 100, 1600), R"({ "spring": "K" })"), device());
  Evaluation<double> law(c.law);
  law.reset(0);
  for (double u = 0; u < 4e-3; u += speed * period) law.step(u, 0);
  const double before = law.step(4e-3, 0).force, stored = law.stored_energy();
  law.set({200});
  EXPECT_NEAR(law.step(4e-3, 0).force, before / 2, 1e-3 * before);
  EXPECT_LE(law.stored_energy(), stored * (1 + 1e-12));
  EXPECT_GE(law.stored_energy(), 0.9 * stored) << "what was set free is lost";
  law.set({120});
  EXPECT_NEAR(law.step(4e-3, 0).force, before / 2, 2e-2 * before) << "what was set free has not paid for the force";
  law.set({1600});
  EXPECT_NEAR(law.step(4e-3, 0).force, before / 2, 0.1 * before) << "a stiffer spring's force";
}

// If this failed, a second change before the next sample would jump from what the first has left, with one command held
// for both.
TEST(TunableCurve, TwoSetCallsActAsOne) {
  const std::string text =
      tuned(parameter("K", 400, 100, 1600) + ", " + parameter("k1", 300, 0, 900),
            R"({ "parallel": [ { "spring": "K" }, { "series": [ { "spring": "k1" }, { "damper": 30 } ] } ] })");
  const Compilation c = on(text, device());
  Evaluation<double> once(c.law), twice(c.law);
  once.reset(0), twice.reset(0);
  for (int k = 0; k < 400; ++k) {
    const double u = 4e-3 * std::sin(0.03 * k);
    ASSERT_EQ(once.step(u, 0).force, twice.step(u, 0).force) << k;
    ASSERT_EQ(once.stored_energy(), twice.stored_energy()) << k;
    if (k % 7 != 0) continue;
    const std::vector<double> values = {k % 2 == 0 ? 100.0 : 1600.0, k % 3 == 0 ? 0 : 900.0};
    twice.set({values[0] == 100 ? 1600.0 : 100.0, 450});
    once.set(values), twice.set(values);
  }
}

// If this failed, the reason would not be told where nothing is proved.
TEST(TunableCurve, SaysWhatIsNotProved) {
  const std::string kelvin =
      R"({ "series": [ { "spring": "K" }, { "parallel": [ { "spring": 200 }, { "damper": 5 } ] } ] })";
  const auto reason = [](const Compilation& c) { return c.certificate.bound.reason; };
  EXPECT_NE(reason(on(tuned(parameter("K", 400, 100, 1600), kelvin), device())).find("neither beside each other"),
            std::string::npos);
  const std::string soft = tuned(parameter("K", 400, 100, 1600), R"({ "spring": "K" })");
  EXPECT_NE(reason(on(soft, device("1 MN", 1))).find("the loop is delayed"), std::string::npos);
  EXPECT_EQ(reason(on(soft, device())), "");
  EXPECT_TRUE(on(soft, device("5 N")).certificate.limits.is_covered);
}

}  // namespace
}  // namespace dashpot::testing
