#include "exchange/deck.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "network/decimal.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

DeckField field_of(const SourceFile& file, std::size_t begin, std::size_t end) {
  const std::string_view blank = " \t\r";
  const std::string& text = file.text();
  while (begin < end && blank.find(text[begin]) != std::string_view::npos) ++begin;
  while (begin < end && blank.find(text[end - 1]) != std::string_view::npos) --end;
  return {text.substr(begin, end - begin), {&file, begin, end}};
}

DeckLine line_of(const SourceFile& file, std::size_t begin, std::size_t end, std::size_t width) {
  DeckLine line{{}, {&file, begin, end}};
  const std::string_view text = std::string_view(file.text()).substr(begin, end - begin);
  const bool in_columns = width > 0 && text.find(',') == std::string_view::npos;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::size_t stop = in_columns ? std::min(at + width, text.size()) : comma;
    line.fields.push_back(field_of(file, begin + at, begin + stop));
    at = in_columns ? stop + (stop == text.size() ? 1 : 0) : stop + 1;
  }
  return line;
}

}  // namespace

std::size_t begin_of_text(const SourceFile& file) { return file.text().starts_with("\xEF\xBB\xBF") ? 3 : 0; }

std::vector<DeckLine> deck_lines(const SourceFile& file, std::size_t width) {
  std::vector<DeckLine> lines;
  const std::string& text = file.text();
  for (std::size_t begin = begin_of_text(file); begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(line_of(file, begin, end, width));
    begin = end + 1;
  }
  return lines;
}

std::optional<double> number_in(const DeckField& field, Diagnostics& diagnostics) {
  std::string text = folded(field.text);
  std::replace(text.begin(), text.end(), 'd', 'e');  // Fortran's exponent
  if (text.starts_with('+')) text.erase(0, 1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  if (is_number) return value;
  diagnostics.report<DiagnosticCode::prony_not_a_number>(field.span, excerpt(field.text));
  return std::nullopt;
}

}  // namespace dashpot::compiler
