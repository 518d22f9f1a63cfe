// A running sum that keeps what rounding takes from it (Kahan 1965), so that a float can count energy for hours: the
// error is that of rounding each term twice, however many there are and however large their sum.
#pragma once

namespace dashpot {

template <class Scalar>
class compensated_sum {
 public:
  constexpr void add(Scalar term) noexcept {
    const Scalar corrected = term - lost_;
    const Scalar sum = sum_ + corrected;
    lost_ = (sum - sum_) - corrected;
    sum_ = sum;
  }
  constexpr Scalar value() const noexcept { return sum_; }

 private:
  Scalar sum_ = 0;
  Scalar lost_ = 0;
};

}  // namespace dashpot
