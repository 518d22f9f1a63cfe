// Whether rows follow each other at one period, as far as their times are written out.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace dashpot::compiler {

inline constexpr double uniformity = 1e-6;     // largest relative departure of a step from the median
inline constexpr double coarsest_share = 0.1;  // of the period, of a last digit that is allowed for: a gap is ten of it

// What the digits of times tell of their rounding, in a table that has so many decimals, or so many significant digits.
class TimeDigits {
 public:
  explicit TimeDigits(double unit = 1) : unit_(unit) {}       // of the numbers [s]
  void add(std::string_view number);                          // decimal notation
  bool are_known() const { return last_place_.has_value(); }  // false where every time is a bare 0
  double unit_at(double time) const;                          // of the last digit of a time of this size [s]

 private:
  double unit_;
  std::optional<int> last_place_;  // the finest there is: −6 where microseconds are written
  int significant_ = 1;            // the most there are
};

struct UniformPeriod {
  double period;  // [s]
  double error;   // of it, that the rounding of the times leaves, in their digits and in a double [s]
};

// Row `row` is at the time `found`, and the one before at `expected`, no earlier; or it follows that one after `found`,
// or is at the time `found`, in place of `expected` [s].
struct Irregularity {
  enum class Kind { no_rise, step, drift };

  Kind kind;
  std::size_t row;
  double found;
  double expected;
  double period;
  double unit;  // of the times' last digit
};

// In: two times or more. A time that does not rise is told before all else. Uniform are steps that are each as long as
// their median to `uniformity`; and times whose last digit is at most `coarsest_share` of the period, and that are on a
// straight line to the rounding of that digit. The period is that of the whole, which has less of the rounding than any
// step.
std::variant<UniformPeriod, Irregularity> uniform_period(const std::vector<double>& times, const TimeDigits& digits);

}  // namespace dashpot::compiler
