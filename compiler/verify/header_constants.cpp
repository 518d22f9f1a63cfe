#include "verify/header_constants.hpp"

#include <algorithm>
#include <cctype>
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
  const auto [stop, error] =
      single ? std::from_chars(text.data(), end, narrow) : std::from_chars(text.data(), end, wide);
  const double value = single ? static_cast<double>(narrow) : wide;
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// The header with comments and quoted text replaced by as many blanks.
std::string without_remarks(std::string_view header) {
  std::string code(header);
  for (std::size_t at = 0; at < code.size(); ++at) {
    const bool is_remark = code.compare(at, 2, "//") == 0;
    if (!is_remark && code[at] != '"') continue;
    const std::size_t end = std::min(code.find(is_remark ? '\n' : '"', at + 1), code.size());
    std::fill(code.begin() + std::ptrdiff_t(at),
              code.begin() + std::ptrdiff_t(end + (is_remark || end == code.size() ? 0 : 1)), ' ');
    at = end;
  }
  return code;
}

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == ':'; }

// The next number or name from `at` on, which is then behind it. An exponent's sign is part of a number, and so is one
// in front of it that has nothing to its left.
std::string_view next_word(std::string_view code, std::size_t& at) {
  while (at < code.size() && !is_of_word(code[at])) ++at;
  std::size_t start = at;
  const auto digit_at = [&](std::size_t i) {
    return i < code.size() && std::isdigit(static_cast<unsigned char>(code[i])) != 0;
  };
  const bool is_number = digit_at(at);
  while (at < code.size() && (is_of_word(code[at]) || (is_number && (code[at] == '-' || code[at] == '+') &&
                                                       code[at - 1] == 'e' && digit_at(at + 1))))
    ++at;
  if (is_number && start > 0 && code[start - 1] == '-' &&
      code.substr(0, start - 1).find_last_not_of(" \n") != code.npos &&
      std::string_view("{(,=").find(code[code.find_last_not_of(" \n", start - 2)]) != code.npos)
    --start;
  return code.substr(start, at - start);
}

bool is_scalar_literal(std::string_view word) {
  const char first = word.empty() ? ' ' : word[word.front() == '-' ? 1 : 0];
  return std::isdigit(static_cast<unsigned char>(first)) != 0 && word.find_first_of(".e") != word.npos;
}

// All numbers of the scalar's type in a piece of code, which alone have a point or an exponent.
bool read_literals(std::string_view code, ScalarType scalar, std::vector<double>& values) {
  for (std::size_t at = 0; at < code.size();) {
    const std::string_view word = next_word(code, at);
    if (word == "inf" || word == "nan") return false;
    if (!is_scalar_literal(word)) continue;
    const std::optional<double> value = number(word, scalar);
    if (!value) return false;
    values.push_back(*value);
  }
  return true;
}

// The name in front of "= …" or "[2] = …", without the underscore at the end of a state.
std::string name_before(std::string_view code, std::size_t end) {
  std::size_t stop = code.find_last_not_of(" \n", end - 1) + 1;
  if (stop > 0 && code[stop - 1] == ']') stop = std::min(code.rfind('[', stop), stop);
  std::size_t start = stop;
  while (start > 0 && is_of_word(code[start - 1])) --start;
  return std::string(code.substr(start, stop - start));
}

// One constant: a scalar, a list or a table of any type over scalars. Others, of whole numbers and words, are code.
bool read_declared(std::string_view declaration, HeaderConstants& result) {
  const std::size_t equals = declaration.find(" = ");
  if (equals == declaration.npos || declaration.substr(0, equals).find("scalar") == declaration.npos) return true;
  const std::string name = name_before(declaration, equals);
  HeaderConstant constant{name, {}, name};
  if (!read_literals(declaration.substr(equals), result.scalar, constant.values)) return false;
  if (!constant.values.empty()) result.all.push_back(std::move(constant));
  return true;
}

// Declarations are blanked once they are read, so that what is left are the numbers within functions.
bool read_all_declared(std::string& code, HeaderConstants& result) {
  constexpr std::string_view opening = "static constexpr ";
  for (std::size_t at = code.find(opening); at != code.npos; at = code.find(opening, at)) {
    const std::size_t start = at + opening.size(), end = code.find(';', at);
    if (end == code.npos) return false;
    if (!read_declared(std::string_view(code).substr(start, end - start), result)) return false;
    std::fill(code.begin() + std::ptrdiff_t(at), code.begin() + std::ptrdiff_t(end), ' ');
  }
  return true;
}

}  // namespace

std::optional<HeaderConstants> header_constants(std::string_view header) {
  HeaderConstants result;
  if (header.find("using scalar = float;") != header.npos) result.scalar = ScalarType::float32;
  else if (header.find("using scalar = double;") == header.npos) return std::nullopt;
  std::string code = without_remarks(header);
  if (!read_all_declared(code, result)) return std::nullopt;
  HeaderConstant others{literals_in_code, {}, literals_in_code};
  if (!read_literals(code, result.scalar, others.values)) return std::nullopt;
  std::erase(others.values, 0);
  if (!others.values.empty()) result.all.push_back(std::move(others));
  return result;
}

}  // namespace dashpot::compiler
