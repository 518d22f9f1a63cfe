// The values of a law's parameters, and the numbers that are worked out from them.
#pragma once

#include <dashpot/tunable/tables.hpp>

namespace dashpot {

template <class Scalar, int Tunables>
class tunable_values {
 public:
  using tables = tunable_tables<Scalar>;

  // Bit i: the value that was wanted of parameter i was no number within its range.
  struct change {
    unsigned clamped;
    bool is_new;
  };

  constexpr void begin(const tables& t) noexcept {
    for (int i = 0; i < t.tunable_count; ++i) values_[i] = t.tunables[i].value;
  }
  constexpr void begin_at_largest(const tables& t) noexcept {
    for (int i = 0; i < t.tunable_count; ++i) values_[i] = t.tunables[i].max;
  }

  // What is no number at all leaves its parameter as it is.
  constexpr change take(const tables& t, const Scalar* wanted) noexcept {
    unsigned clamped = 0;
    bool is_new = false;
    for (int i = 0; i < t.tunable_count; ++i) {
      const Scalar value = within(t.tunables[i], wanted[i], values_[i]);
      if (!(value == wanted[i])) clamped |= 1u << i;
      if (value != values_[i]) is_new = true;
      values_[i] = value;
    }
    return {clamped, is_new};
  }

  constexpr Scalar number(const tables& t, int index) const noexcept {
    const tunable_number<Scalar>& n = t.numbers[index];
    Scalar sum = n.base;
    for (int i = n.first; i < n.first + n.count; ++i)
      sum += t.shares == nullptr ? values_[t.terms[i]] : t.shares[i] * values_[t.terms[i]];
    return sum;
  }

  constexpr Scalar value(int tunable) const noexcept { return values_[tunable]; }

 private:
  static constexpr Scalar within(const tunable_range<Scalar>& range, Scalar wanted, Scalar present) noexcept {
    if (wanted != wanted) return present;
    return wanted < range.min ? range.min : wanted > range.max ? range.max : wanted;
  }

  Scalar values_[Tunables] = {};
};

}  // namespace dashpot
