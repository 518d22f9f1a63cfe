#include "fit/table_shape.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>

#include "network/name_rules.hpp"
#include "network/unit.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler::fitting {
namespace {

constexpr Dialect dialects[] = {{',', false}, {';', false}, {'|', false}, {'\t', false}, {' ', false},
                                {';', true},  {'|', true},  {'\t', true}, {' ', true}};

bool is_blank(char byte) { return byte == ' ' || byte == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

std::vector<std::string_view> blank_separated(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && is_blank(line[at])) ++at;
    std::size_t end = at;
    while (end < line.size() && !is_blank(line[end])) ++end;
    if (end > at) fields.push_back(line.substr(at, end - at));
    at = end;
  }
  return fields;
}

// What stands for a number that is missing.
bool is_gap(std::string_view field) {
  const std::string lower = folded(field);
  return lower.empty() || lower == "nan" || lower == "na" || lower == "n/a" || lower == "inf" || lower == "-inf" ||
         lower == "null" || lower == "-nan" || lower == "+inf";
}

// Numbers, but for columns of text beside them: a row of the table, whatever is wrong with single cells.
bool is_row(const std::vector<std::string_view>& fields, const Dialect& dialect) {
  std::size_t numbers = 0, gaps = 0;
  for (const std::string_view field : fields) {
    if (number_of(field, dialect)) ++numbers;
    else if (is_gap(field)) ++gaps;
  }
  return fields.size() >= 2 && numbers >= 1 && 2 * (numbers + gaps) >= fields.size() && 2 * numbers + gaps >= 2;
}

// How many lines of the commonest width are rows, and how wide they are; whole rows count double.
struct RowCount {
  std::size_t score = 0, width = 0;
};

RowCount row_count(const Dialect& dialect, const std::vector<HeadLine>& head) {
  std::map<std::size_t, std::size_t> score_of_width;
  for (const HeadLine& line : head) {
    const std::vector<std::string_view> fields = fields_of(line.text, dialect);
    if (!is_row(fields, dialect)) continue;
    const bool is_whole =
        std::all_of(fields.begin(), fields.end(), [&](auto field) { return number_of(field, dialect).has_value(); });
    score_of_width[fields.size()] += is_whole ? 2 : 1;
  }
  RowCount best;
  for (const auto& [width, score] : score_of_width)
    if (score > best.score) best = {score, width};
  return best;
}

// "0,1,1,5": digits alone in an even number of fields, as many names as pairs or none.
bool has_comma_twice(const TableShape& shape, const std::vector<HeadLine>& head) {
  if (shape.dialect.delimiter != ',' || shape.width % 2 != 0 || shape.names.size() == shape.width) return false;
  const auto is_digits = [](std::string_view field) {
    return !field.empty() && std::all_of(field.begin(), field.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  for (const HeadLine& line : head) {
    if (line.number < shape.first_line) continue;
    const std::vector<std::string_view> fields = fields_of(line.text, shape.dialect);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      std::string_view field = fields[i];
      if (i % 2 == 0 && field.starts_with('-')) field.remove_prefix(1);
      if (!is_digits(field)) return false;
    }
  }
  return true;
}

// Names, and perhaps units, stand in the lines right above the numbers.
void find_header(TableShape& shape, const std::vector<HeadLine>& head) {
  std::vector<std::vector<std::string>> above;  // the nearest first
  for (auto line = head.rbegin(); line != head.rend() && above.size() < 2; ++line) {
    if (line->number >= shape.first_line || trimmed(line->text).empty()) continue;
    above.push_back(names_in(line->text, shape.dialect));
  }
  const auto fits = [&](std::size_t i) { return i < above.size() && above[i].size() == shape.width; };
  if (!fits(0)) return;
  // A line below names is one of units if most of its fields are; the others are unknown units.
  const auto units = std::count_if(above[0].begin(), above[0].end(), [](const auto& f) { return is_unit(f); });
  const auto names = [](const std::vector<std::string>& line) {
    return std::count_if(line.begin(), line.end(), [](const auto& f) { return !is_unit(f); });
  };
  const bool are_units =
      static_cast<std::size_t>(units) == shape.width ||
      (2 * static_cast<std::size_t>(units) > shape.width && fits(1) && names(above[1]) > names(above[0]));
  if (are_units && fits(1)) shape.units = above[0], shape.names = above[1];
  else shape.names = above[0];
}

}  // namespace

std::vector<std::string> names_in(std::string_view line, const Dialect& dialect) {
  while (line.starts_with('#') || line.starts_with('%')) line.remove_prefix(1);
  std::vector<std::string> names;
  for (const std::string_view field : fields_of(line, dialect)) names.emplace_back(field);
  return names;
}

bool is_text(std::string_view beginning) {
  const bool is_utf16 = beginning.starts_with("\xFF\xFE") || beginning.starts_with("\xFE\xFF");
  return !is_utf16 && beginning.substr(0, 4096).find('\0') == std::string_view::npos;
}

std::string_view unit_text(std::string_view field) {
  std::string_view text = trimmed(field);
  for (const auto& [open, close] : {std::pair('(', ')'), std::pair('[', ']')})
    if (text.size() > 2 && text.front() == open && text.find(close) == text.size() - 1)
      text = trimmed(text.substr(1, text.size() - 2));
  return text == "sec" ? "s" : text;
}

bool is_unit(std::string_view field) {
  const std::string_view text = unit_text(field);
  if (text.empty() || text == "-" || text == "1" || text == "%" || text == "°C" || text == "C" || text == "K")
    return true;
  return std::holds_alternative<Unit>(parse_unit(text));
}

std::optional<Dialect> dialect_of(const std::vector<HeadLine>& head) {
  RowCount best;
  std::optional<Dialect> found;
  for (const Dialect& dialect : dialects)
    if (const RowCount rows = row_count(dialect, head); rows.score > best.score) best = rows, found = dialect;
  return found;
}

std::vector<std::string_view> fields_of(std::string_view line, const Dialect& dialect) {
  if (dialect.delimiter == ' ') return blank_separated(line);
  std::vector<std::string_view> fields;
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] != dialect.delimiter || is_quoted) continue;
    fields.push_back(trimmed(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  if (const std::string_view last = trimmed(line.substr(begin)); !last.empty() || fields.empty())
    fields.push_back(last);
  else if (!fields.empty() && dialect.delimiter == '\t') fields.push_back(last);
  return fields;
}

std::optional<double> number_of(std::string_view field, const Dialect& dialect) {
  char copy[64];
  if (dialect.decimal_comma) {
    if (field.size() > sizeof copy || field.find('.') != std::string_view::npos) return std::nullopt;
    std::copy(field.begin(), field.end(), copy);
    std::replace(copy, copy + field.size(), ',', '.');
    field = std::string_view(copy, field.size());
  }
  if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);  // from_chars knows no plus sign
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) return std::nullopt;
  return field.back() == '.' && dialect.decimal_comma ? std::nullopt : std::optional(value);
}

Span place_of(const std::string& path, std::string_view line, std::size_t number, std::string_view field,
              Diagnostics& diagnostics) {
  const std::string_view shown = line.substr(0, std::min<std::size_t>(line.size(), 4096));
  const SourceFile& file = diagnostics.keep(SourceFile(path, std::string(shown), number));
  const bool is_inside = field.data() >= line.data() && field.data() + field.size() <= line.data() + shown.size();
  if (!is_inside) return {&file, 0, shown.size()};
  const std::size_t begin = static_cast<std::size_t>(field.data() - line.data());
  return {&file, begin, begin + field.size()};
}

std::optional<TableShape> table_shape(const std::string& path, const std::vector<HeadLine>& head, bool has_header,
                                      Diagnostics& diagnostics) {
  const std::optional<Dialect> dialect = dialect_of(head);
  if (!dialect) {
    const HeadLine* const first = head.empty() ? nullptr : &head.front();
    const Span place = first ? place_of(path, first->text, first->number, first->text, diagnostics) : Span{};
    diagnostics.report<DiagnosticCode::recording_without_table>(place, path);
    diagnostics.note<DiagnosticCode::recording_table_remedy>({});
    return std::nullopt;
  }
  TableShape shape;
  shape.dialect = *dialect;
  shape.width = row_count(*dialect, head).width;
  for (const HeadLine& line : head) {
    const std::vector<std::string_view> fields = fields_of(line.text, shape.dialect);
    shape.first_line = line.number;
    if (fields.size() == shape.width && is_row(fields, shape.dialect)) break;
    if (!trimmed(line.text).empty()) shape.metadata.push_back(line.text);
  }
  if (has_header) find_header(shape, head);
  const std::size_t header_lines = (shape.names.empty() ? 0u : 1u) + (shape.units.empty() ? 0u : 1u);
  shape.metadata.resize(shape.metadata.size() - std::min(header_lines, shape.metadata.size()));
  if (has_comma_twice(shape, head)) {
    const auto row = std::find_if(head.begin(), head.end(), [&](auto& l) { return l.number == shape.first_line; });
    diagnostics.report<DiagnosticCode::recording_read_in_two_ways>(
        place_of(path, row->text, row->number, row->text, diagnostics), excerpt(row->text));
    diagnostics.note<DiagnosticCode::recording_two_ways_remedy>({});
    return std::nullopt;
  }
  return shape;
}

}  // namespace dashpot::compiler::fitting
