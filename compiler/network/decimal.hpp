// Decimal literals to doubles.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <string_view>

#include "network/unit.hpp"

namespace dashpot::compiler {

inline bool is_digit(char byte) { return byte >= '0' && byte <= '9'; }

// The length of the decimal literal that `text` starts with ("-1.5e3", "+.5"); 0 where it starts with none.
std::size_t decimal_length(std::string_view text);

enum class Rounding { finite, overflow, underflow };  // underflow: not zero, and yet rounded to it

struct RoundedDecimal {
  double value;
  Rounding rounding;
};

// The literal times one of the unit, in SI. Correctly rounded where the unit is a power of ten; otherwise one rounding
// of a 50-digit product.
RoundedDecimal round_decimal(std::string_view literal, const Unit& unit);

// What a value is before it is rounded to a double: 50 digits.
using ExactReal = boost::multiprecision::cpp_bin_float_50;

// The same product without the rounding. The literal's exponent is within ±10,000; a larger one is infinite or zero.
ExactReal exact_decimal(std::string_view literal, const Unit& unit);

}  // namespace dashpot::compiler
