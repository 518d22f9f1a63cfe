// A function on an arc of the unit circle, to first order in the angle with a bound on the rest:
//     |f(θ) − value − slope (θ − θ_c)| ≤ ½ second (θ − θ_c)²        for every θ of the arc
// with bounds on |f| and |f′| over the arc. The bounds are those of the same expression with all terms made positive,
// so that a multiple of them also bounds what rounding did to value and slope.
#pragma once

#include <cmath>
#include <vector>

namespace dashpot::compiler {

struct Phasor {
  double real = 0, imaginary = 0;
  friend Phasor operator+(Phasor x, Phasor y) { return {x.real + y.real, x.imaginary + y.imaginary}; }
  friend Phasor operator-(Phasor x, Phasor y) { return {x.real - y.real, x.imaginary - y.imaginary}; }
  friend Phasor operator*(double s, Phasor x) { return {s * x.real, s * x.imaginary}; }
  friend Phasor operator*(Phasor x, Phasor y) {
    return {x.real * y.real - x.imaginary * y.imaginary, x.real * y.imaginary + x.imaginary * y.real};
  }
  double magnitude() const { return std::sqrt(real * real + imaginary * imaginary); }
  Phasor inverse() const {
    const double square = real * real + imaginary * imaginary;
    return {real / square, -imaginary / square};
  }
};

struct ArcModel {
  Phasor value, slope;
  double size = 0, steepness = 0, second = 0;  // bounds of |f|, |f′|, |f″| over the arc

  ArcModel& operator+=(const ArcModel& other) {
    value = value + other.value;
    slope = slope + other.slope;
    size += other.size;
    steepness += other.steepness;
    second += other.second;
    return *this;
  }
  friend ArcModel operator+(ArcModel x, const ArcModel& y) { return x += y; }
  friend ArcModel operator*(double s, const ArcModel& x) {
    const double weight = std::abs(s);
    return {s * x.value, s * x.slope, weight * x.size, weight * x.steepness, weight * x.second};
  }
  friend ArcModel operator*(const ArcModel& x, const ArcModel& y) {
    return {x.value * y.value, x.slope * y.value + x.value * y.slope, x.size * y.size,
            x.steepness * y.size + x.size * y.steepness,
            x.second * y.size + 2 * x.steepness * y.steepness + x.size * y.second};
  }
  static ArcModel constant(double value) { return {{value, 0}, {}, std::abs(value), 0, 0}; }
};

// The real part.
struct RealArcModel {
  double value = 0, slope = 0, size = 0, steepness = 0, second = 0;

  friend RealArcModel operator+(const RealArcModel& x, const RealArcModel& y) {
    return {x.value + y.value, x.slope + y.slope, x.size + y.size, x.steepness + y.steepness, x.second + y.second};
  }
  friend RealArcModel operator*(double s, const RealArcModel& x) {
    const double weight = std::abs(s);
    return {s * x.value, s * x.slope, weight * x.size, weight * x.steepness, weight * x.second};
  }
};
inline RealArcModel real_part(const ArcModel& x) { return {x.value.real, x.slope.real, x.size, x.steepness, x.second}; }

// The angles 0 … π as θ = 4 atan x, x from 0 to 1: sines and cosines of the centre are then rational, and everything
// below is additions, multiplications, divisions and square roots, whose rounding is known.
struct Arc {
  double low = 0, high = 1;  // of x

  double centre() const { return low + (high - low) / 2; }
  double radius() const;              // largest |θ − θ_c|
  double angle() const;               // θ_c, for people [rad]
  Phasor backward() const;            // w = e^{−jθ_c}
  Phasor difference() const;          // δ = 1 − w, without cancellation
  double least_difference() const;    // min |δ| over the arc
  double largest_difference() const;  // max |δ|
  Phasor sum() const;                 // σ = 1 + w, without cancellation
  double largest_sum() const;         // max |σ|
};

// wⁿ
ArcModel power_model(const Arc& arc, unsigned n);
// δ = 1 − w
ArcModel difference_model(const Arc& arc);
// Σ taps[i] wⁱ
ArcModel polynomial_model(const Arc& arc, const std::vector<double>& taps);

}  // namespace dashpot::compiler
