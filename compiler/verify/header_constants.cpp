#include "verify/header_constants.hpp"

#include <charconv>
#include <cmath>

namespace dashpot::compiler {
namespace {

// A literal as C++ reads it: a number of the scalar's type, in float with its suffix.
std::optional<double> number(std::string_view text, ScalarType scalar) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n')) text.remove_suffix(1);
  const bool single = scalar == ScalarType::float32;
  if (single && (text.empty() || text.back() != 'f')) return std::nullopt;
  if (single) text.remove_suffix(1);
  const char* end = text.data() + text.size();
  double wide = 0;
  float narrow = 0;
  const auto [stop, error] = single ? std::from_chars(text.data(), end, narrow) : std::from_chars(text.data(), end, wide);
  const double value = single ? static_cast<double>(narrow) : wide;
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// "{1.0, 2.0}" or "1.0"
bool read_values(std::string_view text, ScalarType scalar, std::vector<double>& values) {
  if (!text.empty() && text.front() == '{') text = text.substr(1, text.find('}') - 1);
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::optional<double> value = number(text.substr(start, comma - start), scalar);
    if (!value) return false;
    values.push_back(*value);
    start = comma + 1;
  }
  return true;
}

// The scalars of a table, which alone have a point or an exponent.
bool read_table(std::string_view text, ScalarType scalar, std::vector<double>& values) {
  constexpr std::string_view between = "{}, \n";
  for (std::size_t start = text.find_first_not_of(between); start != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(between, start), text.size());
    const std::string_view word = text.substr(start, end - start);
    start = text.find_first_not_of(between, end);
    if (word.find('.') == word.npos && (word.find('e') == word.npos || word.find(':') != word.npos)) continue;
    const std::optional<double> value = number(word, scalar);
    if (!value) return false;
    values.push_back(*value);
  }
  return true;
}

// What is declared with the words of `opening`: a number or a list of numbers, or a table.
bool read_declared(std::string_view header, std::string_view opening, bool is_table, HeaderConstants& result) {
  for (std::size_t at = header.find(opening); at != header.npos; at = header.find(opening, at)) {
    at += opening.size();
    const std::size_t equals = header.find(" = ", at), end = header.find(';', at);
    if (equals == header.npos || end == header.npos || end < equals) return false;
    const std::string_view name = header.substr(at, equals - at), text = header.substr(equals + 3, end - equals - 3);
    HeaderConstant constant{std::string(name.substr(0, name.find('['))), {}};
    if (!(is_table ? read_table : read_values)(text, result.scalar, constant.values)) return false;
    result.all.push_back(std::move(constant));
  }
  return true;
}

std::string without_line_of(std::string text, std::string_view words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return text;
  const std::size_t start = text.rfind('\n', at) + 1;
  return text.erase(start, text.find('\n', at) - start);
}

}  // namespace

std::optional<HeaderConstants> header_constants(std::string_view header) {
  HeaderConstants result;
  if (header.find("using scalar = float;") != header.npos) result.scalar = ScalarType::float32;
  else if (header.find("using scalar = double;") == header.npos) return std::nullopt;
  if (!read_declared(header, "static constexpr scalar ", false, result)) return std::nullopt;
  if (!read_declared(header, "static constexpr dashpot::slip_node<scalar> ", true, result)) return std::nullopt;
  return result;
}

std::string without_banner_and_digest(std::string_view header) {
  const std::size_t code = header.find("#pragma once");
  std::string text(code == header.npos ? header : header.substr(code));
  return without_line_of(std::move(text), " device_digest = ");
}

}  // namespace dashpot::compiler
