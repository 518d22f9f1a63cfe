#include "network/decimal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace dashpot::compiler {
namespace {

constexpr long largest_exponent = 100'000'000;  // beyond every double, whatever digits stand before it

struct Decimal {
  std::string_view digits;  // with a point, without an exponent
  long exponent;
};

std::size_t digits_length(std::string_view text) {
  return static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
}

std::size_t sign_length(std::string_view text) { return text.starts_with('-') || text.starts_with('+') ? 1 : 0; }

std::size_t mantissa_length(std::string_view text) {
  const std::size_t sign = sign_length(text);
  const std::size_t whole = digits_length(text.substr(sign));
  const std::size_t point = text.substr(sign + whole).starts_with('.') ? 1 : 0;
  const std::size_t fraction = point == 0 ? 0 : digits_length(text.substr(sign + whole + 1));
  return whole + fraction == 0 ? 0 : sign + whole + point + fraction;
}

std::size_t exponent_length(std::string_view text) {
  if (!text.starts_with('e') && !text.starts_with('E')) return 0;
  const std::size_t sign = sign_length(text.substr(1));
  const std::size_t digits = digits_length(text.substr(1 + sign));
  return digits == 0 ? 0 : 1 + sign + digits;
}

long read_exponent(std::string_view text) {
  if (text.empty()) return 0;
  const bool negative = text[1] == '-';
  long exponent = 0;
  for (const char digit : text.substr(1 + sign_length(text.substr(1))))
    exponent = std::min(largest_exponent, 10 * exponent + (digit - '0'));
  return negative ? -exponent : exponent;
}

Decimal split(std::string_view literal) {
  const std::size_t length = mantissa_length(literal);
  return {literal.substr(0, length), read_exponent(literal.substr(length))};
}

// The power of ten of the first digit that is not zero.
long magnitude(const Decimal& decimal) {
  const std::string_view digits = decimal.digits;
  const auto point = static_cast<long>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<long>(digits.find_first_of("123456789"));
  return decimal.exponent + point - first - (first < point ? 1 : 0);
}

bool is_zero(const Decimal& decimal) { return decimal.digits.find_first_of("123456789") == std::string_view::npos; }

RoundedDecimal checked(double value, const Decimal& decimal) {
  if (is_zero(decimal)) return {0, Rounding::finite};  // zero has no sign here
  if (std::isfinite(value) && value != 0) return {value, Rounding::finite};
  return {value, magnitude(decimal) > 0 ? Rounding::overflow : Rounding::underflow};
}

RoundedDecimal round(const Decimal& decimal) {
  std::string text = fmt::format("{}e{}", decimal.digits, decimal.exponent);
  if (text.starts_with('+')) text.erase(0, 1);  // from_chars knows no plus sign
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return checked(result.ec == std::errc() ? value : 0.0, decimal);
}

ExactReal factor_of(const Unit& unit) {
  static const ExactReal degree = ExactReal("3.14159265358979323846264338327950288419716939937510582097494459") / 180;
  return pow(ExactReal(60), unit.power_of_sixty) * pow(degree, unit.power_of_degree);
}

ExactReal exact_value(const Decimal& decimal, const Unit& unit) {
  return ExactReal(fmt::format("{}e{}", decimal.digits, decimal.exponent)) * factor_of(unit);
}

}  // namespace

std::size_t decimal_length(std::string_view text) {
  const std::size_t mantissa = mantissa_length(text);
  return mantissa == 0 ? 0 : mantissa + exponent_length(text.substr(mantissa));
}

RoundedDecimal round_decimal(std::string_view literal, const Unit& unit) {
  Decimal decimal = split(literal);
  decimal.exponent += unit.power_of_ten;
  const RoundedDecimal shifted = round(decimal);
  const bool is_power_of_ten = unit.power_of_sixty == 0 && unit.power_of_degree == 0;
  if (is_power_of_ten || shifted.value == 0 || shifted.rounding != Rounding::finite) return shifted;
  return checked(exact_value(decimal, unit).convert_to<double>(), decimal);
}

ExactReal exact_decimal(std::string_view literal, const Unit& unit) {
  Decimal decimal = split(literal);
  decimal.exponent += unit.power_of_ten;
  if (is_zero(decimal)) return 0;
  if (std::abs(magnitude(decimal)) > 10'000)
    return magnitude(decimal) > 0 ? std::numeric_limits<ExactReal>::infinity() : ExactReal(0);
  return exact_value(decimal, unit);
}

}  // namespace dashpot::compiler
