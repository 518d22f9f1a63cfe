// Counts the operations of a solver.
#pragma once

namespace dashpot::testing {

// A number that counts what is done with it.
struct Counted {
  double value = 0;
  static inline long operations = 0;

  constexpr Counted() = default;
  constexpr Counted(double number) : value(number) {}
  friend Counted operator+(Counted a, Counted b) { return ++operations, Counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return ++operations, Counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return ++operations, Counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++operations, Counted(a.value / b.value); }
  Counted operator-() const { return Counted(-value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator<=(Counted a, Counted b) { return a.value <= b.value; }
  friend bool operator>=(Counted a, Counted b) { return a.value >= b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
};

}  // namespace dashpot::testing
