#include "commands/motion_cell.hpp"

#include <charconv>
#include <cmath>

#include "network/decimal.hpp"

namespace dashpot::compiler {

std::optional<double> number_in_cell(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);  // from_chars knows no plus sign
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return is_number ? std::optional(value) : std::nullopt;
}

void report_cell(Span cell, std::string_view name, Diagnostics& diagnostics) {
  const std::string_view text = std::string_view(cell.file->text()).substr(cell.begin, cell.end - cell.begin);
  const bool is_decimal = !text.empty() && decimal_length(text) == text.size();
  if (!is_decimal) diagnostics.report<DiagnosticCode::csv_not_a_number>(cell, name, text);
  else if (round_decimal(text, {}).rounding == Rounding::overflow)
    diagnostics.report<DiagnosticCode::number_too_large>(cell, text);
  else diagnostics.report<DiagnosticCode::number_too_small>(cell, text);
}

}  // namespace dashpot::compiler
