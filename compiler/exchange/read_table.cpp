// A table with the columns `weight` and `time`; lines that start with '#' are remarks, of which two are read: what the
// weights are shares of, and the stiffness itself. Of an absolute series the line
// with the time "inf" is the long-term stiffness.
#include <algorithm>
#include <limits>
#include <sstream>

#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

std::optional<std::size_t> column_of(const DeckLine& header, std::string_view name) {
  for (std::size_t i = 0; i < header.fields.size(); ++i)
    if (lower(header.fields[i].text) == name) return i;
  return std::nullopt;
}

// "27 N/m" of "# stiffness: 27 N/m".
std::optional<std::string> remark(std::string_view line, std::string_view key) {
  const auto past_blanks = [](std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
  };
  line = past_blanks(line);
  if (!line.starts_with('#')) return std::nullopt;
  line = past_blanks(line.substr(1));
  if (lower(line.substr(0, key.size())) != key) return std::nullopt;
  line = past_blanks(line.substr(key.size()));
  if (!line.starts_with(':')) return std::nullopt;
  line = past_blanks(line.substr(1));
  return std::string(line.substr(0, line.find_last_not_of(" \t\r") + 1));
}

}  // namespace

TableRemarks remarks_of_table(const SourceFile& file) {
  TableRemarks remarks;
  std::istringstream lines{std::string(file.text())};
  for (std::string line; std::getline(lines, line);) {
    if (const auto of = remark(line, "of"); of && !remarks.of) remarks.of = prony_of(lower(*of));
    if (const auto stiffness = remark(line, "stiffness"); stiffness && !remarks.stiffness)
      remarks.stiffness = stiffness;
  }
  return remarks;
}

std::vector<MaterialSeries> read_table(const SourceFile& file, PronyOf of, Diagnostics& diagnostics) {
  MaterialSeries found{"", {of, of == PronyOf::absolute ? 0.0 : 1.0, {}}, {}};
  std::optional<std::size_t> weight_column, time_column;
  for (const DeckLine& line : deck_lines(file)) {
    if (line.is_blank() || line.fields[0].text.starts_with('#')) continue;
    if (!weight_column) {
      weight_column = column_of(line, "weight");
      time_column = column_of(line, "time");
      if (weight_column && time_column) continue;
      diagnostics.report<DiagnosticCode::prony_columns_missing>(line.span);
      return {};
    }
    if (line.fields.size() <= std::max(*weight_column, *time_column)) {
      diagnostics.report<DiagnosticCode::prony_line_too_short>(line.span, "weight and time");
      continue;
    }
    const auto weight = number_in(line.fields[*weight_column], diagnostics);
    const DeckField& time_field = line.fields[*time_column];
    if (weight && of == PronyOf::absolute && lower(time_field.text) == "inf") {
      found.series.stiffness += *weight;
      continue;
    }
    const auto time = number_in(time_field, diagnostics);
    if (weight && time) found.series.terms.push_back({*weight, *time});
  }
  return {found};
}

}  // namespace dashpot::compiler
