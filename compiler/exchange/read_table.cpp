// A table with the columns `weight` and `time`; lines that start with '#' are remarks (remarks.cpp). Of an absolute
// series the line with the time "inf" is the long-term stiffness.
#include <algorithm>
#include <limits>

#include "exchange/deck.hpp"
#include "exchange/read_formats.hpp"

namespace dashpot::compiler {
namespace {

std::optional<std::size_t> column_of(const DeckLine& header, std::string_view name) {
  for (std::size_t i = 0; i < header.fields.size(); ++i)
    if (folded(header.fields[i].text) == name) return i;
  return std::nullopt;
}

}  // namespace

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
    if (weight && of == PronyOf::absolute && folded(time_field.text) == "inf") {
      found.series.stiffness += *weight;
      continue;
    }
    const auto time = number_in(time_field, diagnostics);
    if (weight && time) found.series.terms.push_back({*weight, *time});
  }
  return {found};
}

}  // namespace dashpot::compiler
