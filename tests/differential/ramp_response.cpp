#include "ramp_response.hpp"

#include <cmath>
#include <numbers>

namespace dashpot::testing {
namespace {

// z(w) = μ (1 + sin(iw − α)), w = (j + ½) h, j ≥ 0, and its mirror image; for times t1/Λ … t1.
struct Hyperbola {
  double angle;    // α
  double spacing;  // h
  double scale;    // μ t1
};

// The optimal angle is where the rate of convergence, (π² − 2πα)/A(α), is greatest.
Hyperbola best_hyperbola(double spread, std::size_t points) {
  using std::numbers::pi;
  Hyperbola best{};
  double best_rate = 0;
  for (double angle = pi / 4 + 0.005; angle < pi / 2; angle += 0.005) {
    const double a = std::acosh(((pi - 2 * angle) * spread + 4 * angle - pi) / ((4 * angle - pi) * std::sin(angle)));
    const double rate = (pi * pi - 2 * pi * angle) / a;
    if (rate <= best_rate) continue;
    best_rate = rate;
    const auto n = static_cast<double>(points);
    best = {angle, a / n, (4 * pi * angle - pi * pi) / a * n};
  }
  return best;
}

ExactComplex exponential(const ExactComplex& x) {
  const Exact size = exp(x.real);
  return {size * cos(x.imaginary), size * sin(x.imaginary)};
}

}  // namespace

std::vector<Exact> ramp_response(const compiler::Network& network, double period, std::size_t count) {
  constexpr std::size_t points = 110;
  const auto spread = static_cast<double>(count);
  const Hyperbola path = best_hyperbola(spread, points);
  const Exact scale = Exact(path.scale) / (spread * Exact(period));
  std::vector<Exact> ramp(count, 0);
  for (std::size_t j = 0; j < points; ++j) {
    const Exact w = (Exact(j) + Exact(0.5)) * path.spacing, alpha = path.angle;
    // sin(iw − α) = −sin α cosh w + i cos α sinh w; z′ = iμ cos(iw − α) = μ (−sin α sinh w + i cos α cosh w).
    const ExactComplex z{scale * (1 - sin(alpha) * cosh(w)), scale * cos(alpha) * sinh(w)};
    const ExactComplex slope{-scale * sin(alpha) * sinh(w), scale * cos(alpha) * cosh(w)};
    const ExactComplex turn = exponential({z.real * period, z.imaginary * period});
    ExactComplex term = dynamic_stiffness_by_elimination(network, z) / (z * z) * slope;
    for (Exact& value : ramp) {
      term = term * turn;
      value += term.imaginary;
    }
  }
  const Exact weight = path.spacing / boost::math::constants::pi<Exact>();
  for (Exact& value : ramp) value *= weight;
  return ramp;
}

std::vector<double> force_by_ramps(const std::vector<Exact>& ramp, const std::vector<double>& positions,
                                   double period) {
  std::vector<Exact> bend;  // change of the velocity at the beginning of each period
  Exact last = 0, before = 0;
  for (const double position : positions) {
    const Exact velocity = (Exact(position) - last) / period;
    bend.push_back(velocity - before);
    before = velocity;
    last = position;
  }
  std::vector<double> forces;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    Exact force = 0;
    for (std::size_t j = 0; j <= k; ++j) force += bend[j] * ramp[k - j];
    forces.push_back(force.convert_to<double>());
  }
  return forces;
}

}  // namespace dashpot::testing
