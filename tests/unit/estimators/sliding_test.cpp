// The two sliding-mode estimators against their laws, written out plainly.

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <dashpot/estimators/super_twisting.hpp>
#include <dashpot/estimators/tracking_differentiator.hpp>

namespace dashpot::sliding_test {
namespace {

constexpr double sample_period = 1e-3;  // [s]
constexpr double step = 30e-6;          // [m]

// A quantised walk, slow enough for the estimators to slide now and then.
class walk {
 public:
  double next() {
    speed_ += kick_(random_);
    speed_ *= 0.995;
    position_ += speed_;
    return step * std::floor(position_);
  }

 private:
  std::mt19937 random_{7};
  std::normal_distribution<double> kick_{0, 0.05};
  double position_ = 0, speed_ = 0;  // [counts], [counts a sample]
};

double signed_root(double e) { return std::copysign(std::sqrt(std::abs(e)), e); }

// The implicit Euler step of Levant's law, its inclusion solved by bisection in absolute coordinates.
class plain_super_twisting {
 public:
  explicit plain_super_twisting(double acceleration)
      : alpha_(1.1 * acceleration), lambda_(1.5 * std::sqrt(acceleration)) {}

  double update(double y) {
    const double T = sample_period;
    const double c = x_ + T * u1_ - y;
    const bool slides = std::abs(c) <= T * T * alpha_;
    const double side = slides ? c / (T * T * alpha_) : std::copysign(1.0, c);
    const double e = slides ? 0 : solve(c - T * T * alpha_ * side);
    u1_ -= T * alpha_ * side;
    const double velocity = u1_ - lambda_ * signed_root(e);
    x_ += T * velocity;
    return velocity;
  }

 private:
  // e + T λ |e|^½ sgn e = rest
  double solve(double rest) const {
    double low = -std::abs(rest), high = std::abs(rest);
    for (int i = 0; i < 200; ++i) {
      const double middle = (low + high) / 2;
      (middle + sample_period * lambda_ * signed_root(middle) < rest ? low : high) = middle;
    }
    return (low + high) / 2;
  }

  double alpha_, lambda_, x_ = 0, u1_ = 0;
};

// A wrong root or a wrong branch is another differentiator. x is rounded to 1e-17 m, and a period divides that: 1e-13
// m/s, which the long memory of u1 may gather for a while.
TEST(SuperTwisting, IsTheImplicitStepOfItsLaw) {
  walk positions;
  super_twisting<double> estimator(5, sample_period);
  plain_super_twisting plain(5);
  for (int k = 0; k < 20000; ++k) {
    const double y = positions.next();
    ASSERT_NEAR(estimator.update(y), plain.update(y), 1e-9) << "sample " << k;
  }
}

// Finite-time convergence is what the estimator is for: started at the wrong velocity it must be exact, and not only
// near, once |v|/α has passed a few times.
TEST(SuperTwisting, BecomesExactInFiniteTime) {
  const double speed = 0.05;  // [m/s]
  super_twisting<double> estimator(2, sample_period);
  double estimate = 0;
  for (int k = 0; k < 200; ++k) estimate = estimator.update(speed * sample_period * k);
  EXPECT_NEAR(estimate, speed, 1e-12);
}

// fst and the tracking differentiator as Han writes them, in absolute coordinates.
double fst(double e, double v, double R, double h) {
  const double d = R * h, s = e + h * v;
  const double outside = 0.5 * (std::sqrt(d * d + 8 * R * std::abs(s)) - d) * std::copysign(1.0, s);
  const double a = v + (std::abs(s) <= d * h ? s / h : outside);
  return std::abs(a) <= d ? a / d : std::copysign(1.0, a);
}

// A wrong branch of fst is another differentiator; both sides gather the rounding of a position over a period.
TEST(TrackingDifferentiator, IsItsLaw) {
  for (const double factor : {1.0, 4.0, 12.5}) {
    const double bound = 8;
    walk positions;
    tracking_differentiator<double> estimator(bound, factor, sample_period);
    double x1 = 0, x2 = 0;
    for (int k = 0; k < 20000; ++k) {
      const double y = positions.next();
      const double slope = -bound * fst(x1 - y, x2, bound, factor * sample_period);
      x1 += sample_period * x2;
      x2 += sample_period * slope;
      ASSERT_NEAR(estimator.update(y), x2, 1e-9) << "sample " << k << ", factor " << factor;
    }
  }
}

// R is the promise that the estimate never changes faster; without it a step of the encoder would pass through.
TEST(TrackingDifferentiator, NeverAcceleratesBeyondItsBound) {
  const double bound = 8;
  walk positions;
  tracking_differentiator<double> estimator(bound, 4, sample_period);
  double before = 0;
  for (int k = 0; k < 20000; ++k) {
    const double velocity = estimator.update(positions.next());
    ASSERT_LE(std::abs(velocity - before), bound * sample_period * (1 + 1e-12));
    before = velocity;
  }
}

}  // namespace
}  // namespace dashpot::sliding_test
