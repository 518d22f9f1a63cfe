// The pulse transfer function of a linear estimator, from position sample [m] or [rad] to velocity estimate [m/s] or
// [rad/s]:
//     E(z) = Σ numerator[i] z⁻ⁱ / Σ denominator[i] z⁻ⁱ,    denominator[0] = 1.
// Plain data, for the certificate; frequency_response.hpp evaluates it on a host. The coefficients are rounded to
// double: the slower a recursive filter of order n against the sample rate, the more its expanded denominator cancels,
// about 1e-16/(2π f_c T)ⁿ relative at low frequency (1e-11 for a 4th-order 120 Hz filter at 10 kHz), and likewise near
// Nyquist for a cutoff close to it.
#pragma once

namespace dashpot {

template <unsigned MaxOrder>
struct pulse_transfer {
  double numerator[MaxOrder + 1] = {};     // of z⁰, z⁻¹, … [1/s]
  double denominator[MaxOrder + 1] = {1};  // of z⁰, z⁻¹, …
  unsigned numerator_order = 0;
  unsigned denominator_order = 0;  // 0: finite impulse response
};

// coefficients ← coefficients · (factor[0] + factor[1] z⁻¹ + …), where coefficients has room for the product.
template <unsigned FactorLength>
constexpr void multiply_polynomial(double* coefficients, unsigned& order,
                                   const double (&factor)[FactorLength]) noexcept {
  for (unsigned i = order + FactorLength; i-- > 0;) {
    double sum = 0;
    for (unsigned j = 0; j < FactorLength; ++j)
      if (i >= j && i - j <= order) sum += factor[j] * coefficients[i - j];
    coefficients[i] = sum;
  }
  order += FactorLength - 1;
}

// The same transfer function with room for a higher order.
template <unsigned Wide, unsigned Narrow>
constexpr pulse_transfer<Wide> widen(const pulse_transfer<Narrow>& narrow) noexcept {
  static_assert(Wide >= Narrow, "a transfer function is never cut short");
  pulse_transfer<Wide> wide;
  for (unsigned i = 0; i <= Narrow; ++i) {
    wide.numerator[i] = narrow.numerator[i];
    wide.denominator[i] = narrow.denominator[i];
  }
  wide.numerator_order = narrow.numerator_order;
  wide.denominator_order = narrow.denominator_order;
  return wide;
}

}  // namespace dashpot
