#include "report/number_text.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace dashpot::compiler {
namespace {

struct Decimal {
  std::string mantissa;  // with its sign
  int exponent = 0;      // of ten; 0 where the mantissa stands alone
};

std::string without_trailing_zeros(std::string digits) {
  if (digits.find('.') == digits.npos) return digits;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

Decimal decimal(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return {value == 0 ? "0" : fmt::format("{}", value)};
  const std::string scientific = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  const std::string sign = value < 0 ? "−" : "";
  if (exponent < -3 || exponent > 4) return {sign + without_trailing_zeros(scientific.substr(0, e)), exponent};
  const int decimals = std::max(0, digits - 1 - exponent);
  return {sign + without_trailing_zeros(fmt::format("{:.{}f}", std::abs(value), decimals))};
}

std::string superscript(int exponent) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(exponent)) text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

}  // namespace

std::string number_text(double value, int digits) {
  const Decimal d = decimal(value, digits);
  if (d.exponent == 0) return d.mantissa;
  return (d.mantissa == "1" ? "" : d.mantissa == "−1" ? "−" : d.mantissa + "×") + power_text(d.exponent);
}

std::string power_text(int exponent) { return "10" + superscript(exponent); }

std::string number_mathml(double value, int digits) {
  const Decimal d = decimal(value, digits);
  if (d.exponent == 0) return "<mn>" + d.mantissa + "</mn>";
  const std::string exponent = d.exponent < 0 ? fmt::format("<mrow><mo>−</mo><mn>{}</mn></mrow>", -d.exponent)
                                              : fmt::format("<mn>{}</mn>", d.exponent);
  return "<mrow><mn>" + d.mantissa + "</mn><mo>×</mo><msup><mn>10</mn>" + exponent + "</msup></mrow>";
}

std::string in_four_digits(std::string_view text) {
  const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  const auto is_of_a_name = [&](std::size_t i) {
    return i < text.size() &&
           (std::isalpha(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_' || text[i] == '.');
  };
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (is_digit(end)) ++end;
    if (end == i || (i > 0 && (is_of_a_name(i - 1) || is_digit(i - 1)))) {
      result += text[i++];
      continue;
    }
    const bool has_point = end < text.size() && text[end] == '.' && is_digit(end + 1);
    if (has_point)
      for (++end; is_digit(end);) ++end;
    const std::size_t sign =
        end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? end + 2 : end + 1;
    const bool has_exponent = end < text.size() && text[end] == 'e' && is_digit(sign);
    if (has_exponent)
      for (end = sign; is_digit(end);) ++end;
    const std::string number(text.substr(i, end - i));
    const bool is_number = (has_point || has_exponent) && !is_of_a_name(end);
    result += is_number ? number_text(std::strtod(number.c_str(), nullptr)) : number;
    i = end;
  }
  return result;
}

std::string value_text(const Element& element, motion port_motion) {
  const double value = std::visit(
      [](const auto& law) {
        if constexpr (requires { law.stiffness; }) return law.stiffness;
        else if constexpr (requires { law.damping; }) return law.damping;
        else return law.yield_force;
      },
      element.law);
  return number_text(value) + " " + dotted(unit_of(element.law, port_motion));
}

}  // namespace dashpot::compiler
