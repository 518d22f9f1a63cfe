#include "certify/arc_model.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

// |1 − e^{−jθ}| = 2 sin(θ/2), and sin(θ/2) = 2x/(1 + x²)
double difference_size(double x) { return 4 * x / (1 + x * x); }

// |1 + e^{−jθ}| = 2 cos(θ/2)
double sum_size(double x) { return 2 * (1 - x) * (1 + x) / (1 + x * x); }

}  // namespace

// dθ/dx = 4/(1 + x²), largest at the low end.
double Arc::radius() const {
  const double reach = std::max(high - centre(), centre() - low);
  return 4 * reach / (1 + low * low) * (1 + 1e-14);
}

double Arc::angle() const { return 4 * std::atan(centre()); }

// e^{−jθ/2} = (1 − jx)²/(1 + x²)
Phasor Arc::backward() const {
  const double x = centre(), scale = 1 / (1 + x * x);
  const Phasor half = {(1 - x) * (1 + x) * scale, -2 * x * scale};
  return half * half;
}

// 2j sin(θ/2) e^{−jθ/2}
Phasor Arc::difference() const {
  const double x = centre(), scale = 1 / (1 + x * x), sine = 2 * x * scale, cosine = (1 - x) * (1 + x) * scale;
  return {2 * sine * sine, 2 * sine * cosine};
}

double Arc::least_difference() const { return difference_size(low) * (1 - 1e-14); }
double Arc::largest_difference() const { return difference_size(high) * (1 + 1e-14); }

// 2 cos(θ/2) e^{−jθ/2}
Phasor Arc::sum() const {
  const double x = centre(), scale = 1 / (1 + x * x), sine = 2 * x * scale, cosine = (1 - x) * (1 + x) * scale;
  return {2 * cosine * cosine, -2 * cosine * sine};
}

double Arc::largest_sum() const { return sum_size(low) * (1 + 1e-14); }

ArcModel power_model(const Arc& arc, unsigned n) {
  Phasor base = arc.backward(), power = {1, 0};
  for (unsigned left = n; left != 0; left /= 2) {
    if (left % 2 == 1) power = power * base;
    base = base * base;
  }
  const double count = n;
  return {power, count * Phasor{power.imaginary, -power.real}, 1, count, count * count};
}

ArcModel difference_model(const Arc& arc) {
  const Phasor w = arc.backward();
  return {arc.difference(), {-w.imaginary, w.real}, arc.largest_difference(), 1, 1};
}

// Horner's rule for the value and, with every coefficient times i, for the slope: d wⁱ/dθ = −j i wⁱ.
ArcModel polynomial_model(const Arc& arc, const std::vector<double>& taps) {
  const Phasor w = arc.backward();
  ArcModel model;
  Phasor weighted;
  for (std::size_t i = taps.size(); i-- > 0;) {
    const double age = static_cast<double>(i), weight = std::abs(taps[i]);
    model.value = model.value * w + Phasor{taps[i], 0};
    weighted = weighted * w + Phasor{age * taps[i], 0};
    model.size += weight;
    model.steepness += age * weight;
    model.second += age * age * weight;
  }
  model.slope = {weighted.imaginary, -weighted.real};
  return model;
}

}  // namespace dashpot::compiler
