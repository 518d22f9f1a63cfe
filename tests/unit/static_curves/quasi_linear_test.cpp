// Ramps in which the map and quasi-linear viscoelasticity are furthest apart (theory, section 11).
#include <cmath>

#include "linear/quasi_linear.hpp"
#include "static_case.hpp"

namespace dashpot::testing {
namespace {

using namespace dashpot::compiler;

const char* const relaxing = R"({ "parallel": [ { "spring": "100 N/m" },
    { "series": [ { "spring": "300 N/m" }, { "damper": "30 N s/m" } ] } ] })";

double distance(const std::string& curve, const std::string& network, double speed) {
  const Compilation c = compiled(behind(curve, "", network));
  return distance_from_quasi_linear(c.network, c.form.linear, speed);
}

// f = c (e^{au} − 1) behind 100 N/m and 300 N/m that relax at 10 1/s, at the end of a ramp to u, in closed form for
// the quasi-linear law and by Simpson's rule for the map.
struct EndOfRamp {
  double quasi_linear, mapped;
};

EndOfRamp end_of_ramp(double speed, double u) {
  const double a = 1e3, c = 2 / std::expm1(a * 5e-3), relaxation = 10, time = u / speed;
  const double drive = a * speed, shape = drive / (relaxation + drive);
  const double quasi_linear = c * std::expm1(a * u) + 3 * c * shape * (std::exp(a * u) - std::exp(-relaxation * time));
  const auto w = [&](double x) { return std::sqrt(2 * c / a * (std::expm1(a * x) - a * x) / 100); };
  const auto tangent = [&](double x) { return x == 0 ? std::sqrt(c * a / 100) : c * std::expm1(a * x) / (100 * w(x)); };
  constexpr int steps = 4000;
  double held = 0;
  for (int i = 0; i <= steps; ++i) {
    const double s = time * i / steps, weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    held += weight * std::exp(-relaxation * (time - s)) * tangent(speed * s) * speed;
  }
  return {quasi_linear, tangent(u) * (100 * w(u) + 300 * held * time / (3 * steps))};
}

// To the 2,000 steps of the ramp and the error of the emitted map, some 1e-3 in all.
TEST(QuasiLinear, DistanceIsThatOfBothForces) {
  for (const double speed : {2e-3, 2e-2, 2e-1}) {
    double furthest = 0, largest = 0;
    for (int i = 1; i <= 200; ++i) {
      const EndOfRamp end = end_of_ramp(speed, 5e-3 * i / 200);
      furthest = std::max(furthest, std::abs(end.mapped - end.quasi_linear));
      largest = std::max(largest, end.mapped);
    }
    EXPECT_NEAR(distance(exponential, relaxing, speed), furthest / largest, 2e-3) << speed;
  }
}

// Slow and fast ramps see springs alone.
TEST(QuasiLinear, IsTheSameWhereNothingRelaxes) {
  EXPECT_LT(distance(R"({ "power": 1, "force": "2 N", "at": "5 mm" })",
                     R"({ "parallel": [ { "spring": "1 N/mm" }, { "damper": "4 N s/m" } ] })", 0.1),
            1e-9);
  for (const double speed : {1e-7, 1e3}) EXPECT_LT(distance(hertz, relaxing, speed), 1e-3) << speed;
  EXPECT_GT(distance(hertz, relaxing, 5e-2), 1e-2);
}

}  // namespace
}  // namespace dashpot::testing
