// Published transfer functions against the code that runs, and their figures against closed forms.

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <dashpot/estimators/any_estimator.hpp>
#include <dashpot/estimators/frequency_response.hpp>

namespace dashpot::transfer_test {
namespace {

constexpr double sample_period = 1e-3;  // [s]

using series = std::vector<double>;

template <class Estimator>
series impulse_response(Estimator estimator, std::size_t length) {
  estimator.reset(0);
  series response = {estimator.update(1)};
  while (response.size() < length) response.push_back(estimator.update(0));
  return response;
}

// y_k = Σ numerator_i u_{k−i} − Σ denominator_i y_{k−i} for a unit pulse.
template <unsigned MaxOrder>
series impulse_response(const pulse_transfer<MaxOrder>& transfer, std::size_t length) {
  series response;
  for (std::size_t k = 0; k < length; ++k) {
    double sum = k <= transfer.numerator_order ? transfer.numerator[k] : 0;
    for (std::size_t i = 1; i <= std::min<std::size_t>(k, transfer.denominator_order); ++i)
      sum -= transfer.denominator[i] * response[k - i];
    response.push_back(sum);
  }
  return response;
}

double largest(const series& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

double largest_difference(const series& a, const series& b) {
  series difference(a.size());
  std::transform(a.begin(), a.end(), b.begin(), difference.begin(), std::minus<>());
  return largest(difference);
}

template <class Estimator>
void expect_transfer_is_what_runs(const Estimator& estimator, double tolerance) {
  constexpr std::size_t length = 1000;  // [samples]; longer than any of the responses
  const series measured = impulse_response(estimator, length);
  const series published = impulse_response(estimator.transfer(), length);
  EXPECT_LE(largest_difference(measured, published), tolerance * largest(measured));
}

// A transfer function that is not the code's would certify another device. Both sides are rounded a few times a sample:
// 1e-12 of the largest value.
TEST(Transfer, IsTheImpulseResponseOfTheCode) {
  for (const unsigned window : {1U, 2U, 15U, 64U}) {
    expect_transfer_is_what_runs(backward_difference<double>(window, sample_period), 1e-12);
    expect_transfer_is_what_runs(least_squares<double>(window, sample_period), 1e-12);
  }
  for (const double cutoff : {40.0, 120.0, 450.0})
    for (const unsigned order : {2U, 4U})
      expect_transfer_is_what_runs(low_pass<double>(order, cutoff, sample_period), 1e-12);
  for (const double acceleration : {0.1, 10.0, 1000.0})
    expect_transfer_is_what_runs(kalman<double>(acceleration, 30e-6, sample_period), 1e-12);
}

// At 10 kHz the expanded 4th-order denominator has lost digits, (2π 120 Hz · 0.1 ms)⁻⁴ = 3e4 roundings' worth, as
// pulse_transfer.hpp states; more than that would be a mistake.
TEST(Transfer, LosesNoMoreDigitsThanStated) {
  expect_transfer_is_what_runs(low_pass<double>(4, 120, 1e-4), 3e4 * 1e-15);
  expect_transfer_is_what_runs(low_pass<double>(2, 120, 1e-4), 1e-12);
}

// The sensor's transfer function is exact for positions linear between samples: the first-order lag solved over each
// period of a pulse one sample high.
TEST(Transfer, OfASensorIsItsLagUnderPiecewiseLinearMotion) {
  const double bandwidth = 50;
  const double kept = std::exp(-2 * pi * bandwidth * sample_period);
  series exact = {(1 - kept) / sample_period};
  exact.push_back(kept * exact[0] - (1 - kept) / sample_period);
  while (exact.size() < 100) exact.push_back(kept * exact.back());
  const series published = impulse_response(sensor<double>(bandwidth, sample_period).transfer(), exact.size());
  EXPECT_LE(largest_difference(exact, published), 1e-12 * largest(exact));
}

// Without a stated bandwidth a sensor is the one-sample difference: finite, so that it has no memory to be judged by.
TEST(Transfer, OfAnUnlimitedSensorIsTheDifference) {
  const pulse_transfer<1> unlimited = sensor<double>(0, sample_period).transfer();
  EXPECT_EQ(unlimited.denominator_order, 0U);
  EXPECT_EQ(unlimited.numerator[0], 1 / sample_period);
  EXPECT_EQ(unlimited.numerator[1], -1 / sample_period);
}

// A filter that does not halve the power at its cutoff is not prewarped. Difference apart, which has its own gain. The
// slowest and the fastest cutoff are 0.03 and 0.13 rad a sample from rest and from Nyquist, to the power −4 below
// 1e7 roundings.
TEST(LowPass, HalvesThePowerAtItsCutoff) {
  for (const double cutoff : {5.0, 120.0, 250.0, 480.0})
    for (const unsigned order : {2U, 4U}) {
      const auto transfer = low_pass<double>(order, cutoff, sample_period).transfer();
      const double angle = 2 * pi * cutoff * sample_period;
      EXPECT_NEAR(std::norm(difference_response(transfer, angle, sample_period)), 0.5, 1e-9) << cutoff << ", " << order;
    }
}

// |B(jω)|² = 1/(1 + (tan(ωT/2)/tan(π f_c T))^(2n)) is what makes a Butterworth filter; another damping of a section
// shows.
TEST(LowPass, IsMaximallyFlat) {
  for (const unsigned order : {2U, 4U}) {
    const auto transfer = low_pass<double>(order, 120, sample_period).transfer();
    for (double angle = 0.1; angle < 3; angle += 0.3) {
      const double ratio = std::tan(angle / 2) / std::tan(pi * 120 * sample_period);
      const double expected = 1 / (1 + std::pow(ratio, 2.0 * order));
      EXPECT_NEAR(std::norm(difference_response(transfer, angle, sample_period)), expected, 1e-11);
    }
  }
}

// A declared gain below the true one would let the theorem be applied where it does not hold. The search is good to
// 1e-12, the coefficients of these filters to 1e-11.
TEST(MaxGain, DeclaredGainMatchesSearch) {
  const auto expect_declared = [](const auto& estimator) {
    EXPECT_NEAR(max_gain(estimator.transfer(), sample_period), estimator.max_gain(), 1e-11 * estimator.max_gain());
  };
  expect_declared(backward_difference<double>(15, sample_period));
  expect_declared(least_squares<double>(16, sample_period));
  expect_declared(low_pass<double>(2, 120, sample_period));
  expect_declared(low_pass<double>(4, 120, sample_period));
  expect_declared(sensor<double>(100, sample_period));
  for (const double manoeuvre : {0.3, 1.0, 4.0, 5.6, 5.7, 10.0, 37.0})
    expect_declared(kalman<double>(manoeuvre / std::sqrt(12.0), 1e-6, sample_period));
}

// The Kalman filter of the specification's table, from the table's own formulas.
TEST(Kalman, HasTheTabledGains) {
  for (const double manoeuvre : {0.01, 0.3, 1.0, 37.0}) {
    const kalman<double> filter(manoeuvre / std::sqrt(12.0), 1e-6, sample_period);
    const double r = (4 + manoeuvre - std::sqrt(8 * manoeuvre + manoeuvre * manoeuvre)) / 4;
    const double alpha = 1 - r * r;
    EXPECT_NEAR(filter.manoeuvre_index(), manoeuvre, 1e-14 * manoeuvre);
    EXPECT_NEAR(filter.alpha(), alpha, 1e-12);
    EXPECT_NEAR(filter.beta(), 2 * (2 - alpha) - 4 * std::sqrt(1 - alpha), 1e-12);
  }
}

struct gains {
  double alpha, beta;
};

// The steady state of the Riccati recursion with process noise [[q0, q1], [q1, q2]], measurement noise 1 and T = 1.
gains riccati(double q0, double q1, double q2) {
  double p0 = q0, p1 = q1, p2 = q2;  // predicted covariance
  for (int i = 0; i < 10000; ++i) {
    const double alpha = p0 / (p0 + 1), beta = p1 / (p0 + 1);
    const double c0 = p0 - alpha * p0, c1 = p1 - beta * p0, c2 = p2 - beta * p1;
    p0 = c0 + 2 * c1 + c2 + q0, p1 = c1 + c2 + q1, p2 = c2 + q2;
  }
  return {p0 / (p0 + 1), p1 / (p0 + 1)};
}

// Gains that are not the Riccati equation's fixed point are not a Kalman filter's.
TEST(Kalman, IsTheSteadyStateOfTheRiccatiRecursion) {
  for (const double manoeuvre : {0.3, 1.0, 37.0}) {
    const double power = manoeuvre * manoeuvre;
    const gains steady = riccati(power / 4, power / 2, power);
    const kalman<double> filter(manoeuvre / std::sqrt(12.0), 1e-6, sample_period);
    EXPECT_NEAR(filter.alpha(), steady.alpha, 1e-12);
    EXPECT_NEAR(filter.beta(), steady.beta, 1e-12);
  }
}

pulse_transfer<2> alpha_beta(gains tuned, double period) {
  return {{tuned.beta / period, -tuned.beta / period, 0}, {1, tuned.alpha + tuned.beta - 2, 1 - tuned.alpha}, 1, 2};
}

// The device specification prints max|G| = 1.70 at Λ = 37. It is the gain over the one-sample difference of a filter
// for acceleration white in continuous time, Q = σ² [[T³/3, T²/2], [T²/2, T]]; the tabled filter's is Λ/4. Should
// max_gain change its reference, or the Kalman filter its noise, one of these figures moves.
TEST(MaxGain, ReproducesThePrintedFigureForContinuousWhiteAcceleration) {
  const double power = 37 * 37;
  const auto printed = alpha_beta(riccati(power / 3, power / 2, power), sample_period);
  EXPECT_NEAR(max_gain(printed, sample_period), 1.70, 0.005);
  EXPECT_NEAR(max_sinusoid_gain(printed, sample_period), 1.187, 0.0005);
  const kalman<double> tabled(37 / std::sqrt(12.0), 1e-6, sample_period);
  EXPECT_NEAR(max_gain(tabled.transfer(), sample_period), 9.25, 1e-9);
  EXPECT_NEAR(max_sinusoid_gain(tabled.transfer(), sample_period), 5.903, 0.0005);
}

// max_gain claims to be the largest ‖v̂‖/‖u̇‖: at the angle where it is reached, a motion linear between samples comes
// close to it in the time domain. Two filters' transients among 20,000 samples weigh below 0.1 %.
TEST(MaxGain, IsReachedByAMotion) {
  kalman<double> filter(10 / std::sqrt(12.0), 1e-6, sample_period);  // largest at Nyquist: 2.5
  filter.reset(0);
  double estimate_energy = 0, motion_energy = 0, before = 0;
  for (int k = 1; k <= 20000; ++k) {
    const double position = k % 2 == 0 ? 0 : 1e-3;
    estimate_energy += std::pow(filter.update(position), 2);
    motion_energy += std::pow((position - before) / sample_period, 2);
    before = position;
  }
  EXPECT_NEAR(std::sqrt(estimate_energy / motion_energy), filter.max_gain(), 1e-3 * filter.max_gain());
}

// velocity_response divides by jω; at rest it must take the limit, 1, and near it agree with E/(jω).
TEST(FrequencyResponse, HasTheLimitOneAtRest) {
  const auto transfer = low_pass<double>(4, 120, sample_period).transfer();
  EXPECT_NEAR(std::abs(velocity_response(transfer, 0, sample_period) - 1.0), 0, 1e-12);
  const double rate = 2 * pi * 20;
  const std::complex<double> direct = position_response(transfer, rate, sample_period) / std::complex(0.0, rate);
  EXPECT_NEAR(std::abs(velocity_response(transfer, rate, sample_period) - direct), 0, 1e-11);
}

// A backward difference's response is known in closed form: e^{−jωNT/2} sin(ωNT/2)/(ωNT/2).
TEST(FrequencyResponse, OfTheDifferenceIsASinc) {
  const auto transfer = backward_difference<double>(15, sample_period).transfer();
  for (double rate = 10; rate < pi / sample_period; rate += 97) {
    const double half = rate * 15 * sample_period / 2;
    const std::complex<double> expected = std::polar(1.0, -half) * (std::sin(half) / half);
    EXPECT_NEAR(std::abs(velocity_response(transfer, rate, sample_period) - expected), 0, 1e-13);
  }
}

// Products of polynomials build the low-pass; a lost cross term would change it.
TEST(PulseTransfer, MultipliesPolynomials) {
  double product[6] = {2, 3};
  unsigned order = 1;
  multiply_polynomial(product, order, {1.0, -1.0, 4.0});
  EXPECT_EQ(order, 3U);
  const series expected = {2, 1, 5, 12, 0, 0};
  EXPECT_EQ(series(product, product + 6), expected);
}

}  // namespace
}  // namespace dashpot::transfer_test
