#include "network/springpot.hpp"

#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>
#include <utility>

namespace dashpot::compiler {
namespace {

constexpr double pi = std::numbers::pi;

double ripple(double exponent, double step) {
  const double sine = std::sin(pi * exponent);
  double sum = 0;
  for (int m = 1; m <= 50; ++m) {
    const double y = 2 * pi * pi * m / step;  // π ξ, of the m-th harmonic
    if (y > 600) break;                       // below any double
    sum += 2 * sine * std::cosh(y / 2) / std::hypot(sine, std::sinh(y));
  }
  return sum;
}

// Σ e^{p (x ∓ jη)} over j ≥ 0, the sum that falls away from x.
double geometric(double power, double x, double step) {
  return std::exp(power * x) / -std::expm1(-std::abs(power) * step);
}

// A tail lumped into one element, and the error of that.
struct Tail {
  MaxwellBranch lumped;
  double error;
};

// Σk x² − (Σk x)²/Σk of a tail, from its three sums; 0 where it is so far out that they underflow.
double spread(double sum, double first, double second) { return sum > 0 ? second - first * first / sum : 0; }

// `x` is the first point left out, ln λ.
Tail tail_below(double exponent, double scale, double x, double step, double low) {
  const double stiffness = scale * geometric(exponent, x, step);
  const double first = scale * geometric(exponent + 1, x, step);
  const double second = scale * geometric(exponent + 2, x, step);
  return {{stiffness, first / stiffness}, spread(stiffness, first, second) * std::pow(low, -2 - exponent)};
}

Tail tail_above(double exponent, double scale, double x, double step, double high) {
  const double viscosity = scale * geometric(exponent - 1, x, step);  // Σ k/λ
  const double first = scale * geometric(exponent - 2, x, step);
  const double second = scale * geometric(exponent - 3, x, step);
  const double rate = viscosity / first;
  return {{viscosity * rate, rate}, spread(viscosity, first, second) * std::pow(high, 3 - exponent)};
}

// Shifts the grid until the errors of both tails are equal: one grows as the other falls.
SpringpotGrid balanced(double exponent, double low, double high, double step, std::size_t points) {
  const double scale = std::sin(pi * exponent) / pi * step;
  const double length = static_cast<double>(points) * step;
  double from = std::log(low) - length - 20, to = std::log(high) + 20;
  for (int i = 0; i < 60; ++i) {
    const double first = (from + to) / 2;
    const double below = tail_below(exponent, scale, first - step, step, low).error;
    const double above = tail_above(exponent, scale, first + length, step, high).error;
    (below < above ? from : to) = first;
  }
  return {(from + to) / 2, step, points};
}

struct Tails {
  Tail below;
  Tail above;
  double error;  // of both tails and of the ripple between them
};

Tails tails_of(double exponent, double low, double high, const SpringpotGrid& grid) {
  const double scale = std::sin(pi * exponent) / pi * grid.step;
  const double end = grid.first + static_cast<double>(grid.points) * grid.step;
  const Tail below = tail_below(exponent, scale, grid.first - grid.step, grid.step, low);
  const Tail above = tail_above(exponent, scale, end, grid.step, high);
  return {below, above, ripple(exponent, grid.step) + below.error + above.error};
}

// With the step of least error.
SpringpotGrid best_grid(double exponent, double low, double high, std::size_t points) {
  const auto error = [&](double log_step) {
    return std::log(tails_of(exponent, low, high, balanced(exponent, low, high, std::exp(log_step), points)).error);
  };
  const double longest = std::log(high / low) + 10;
  const auto [log_step, least] = boost::math::tools::brent_find_minima(error, std::log(0.05), std::log(longest), 30);
  return balanced(exponent, low, high, std::exp(log_step), points);
}

}  // namespace

SpringpotLadder springpot_ladder(double exponent, double low, double high, const SpringpotGrid& grid) {
  const Tails tails = tails_of(exponent, low, high, grid);
  const double scale = std::sin(pi * exponent) / pi * grid.step;
  SpringpotLadder ladder{{tails.below.lumped}, tails.error};
  for (std::size_t i = 0; i < grid.points; ++i) {
    const double x = grid.first + static_cast<double>(i) * grid.step;
    ladder.branches.push_back({scale * std::exp(exponent * x), std::exp(x)});
  }
  ladder.branches.push_back(tails.above.lumped);
  return ladder;
}

SpringpotLadder springpot_ladder(double exponent, double low, double high, double error) {
  const auto suffices = [&](std::size_t points) {
    return tails_of(exponent, low, high, best_grid(exponent, low, high, points)).error <= error;
  };
  std::size_t too_few = 0, enough = 0;
  while (!suffices(enough)) too_few = std::exchange(enough, 2 * enough + 1);
  while (enough > too_few + 1) {
    const std::size_t middle = (too_few + enough) / 2;
    (suffices(middle) ? enough : too_few) = middle;
  }
  return springpot_ladder(exponent, low, high, best_grid(exponent, low, high, enough));
}

}  // namespace dashpot::compiler
