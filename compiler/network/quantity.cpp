#include "network/quantity.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "network/decimal.hpp"
#include "network/unit.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

// "N/m s" is meant to be "N s/m" or "N/(m s)".
void report_two_readings(const Span& place, const std::string& unit, Diagnostics& diagnostics) {
  diagnostics.report<DiagnosticCode::product_after_slash>(place, excerpt(unit));
  const std::size_t slash = unit.find('/');
  const std::size_t blank = unit.find(' ', slash);
  if (blank == std::string::npos || unit.find_first_of("/(", slash + 1) != std::string::npos) return;
  const std::string above = unit.substr(0, slash);
  const std::string below = unit.substr(slash + 1);
  const std::string divisor = unit.substr(slash + 1, blank - slash - 1);
  diagnostics.note<DiagnosticCode::write_either>({}, fmt::format("{}{}/{}", above, unit.substr(blank), divisor),
                                                 fmt::format("{}/({})", above, below));
}

// The exponent behind a symbol, such as "^2" or "²"; a plain number gets the missing '^'.
std::string exponent_behind(std::string_view symbol) {
  const std::string exponent(symbol.substr(0, symbol.find_first_of(" /*()")));
  return !exponent.empty() && is_digit(exponent.front()) ? "^" + exponent : exponent;
}

// A note on a comma between digits; with three digits behind it, it may separate thousands.
void note_on_comma(const std::string& before, const std::string& behind, Diagnostics& diagnostics) {
  const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
  if (digits == 3) diagnostics.note<DiagnosticCode::write_either>({}, before + behind, before + "." + behind);
  else diagnostics.note<DiagnosticCode::decimal_point>({});
}

void report_unit_fault(const ValueDecl& decl, std::size_t unit_begin, const UnitFault& fault,
                       Diagnostics& diagnostics) {
  const std::string unit = decl.text.substr(unit_begin);
  if (fault.kind == UnitFault::Kind::malformed) {
    diagnostics.report<DiagnosticCode::malformed_unit>(decl.span, excerpt(unit));
    if (unit.starts_with(',')) note_on_comma(decl.text.substr(0, unit_begin), unit.substr(1), diagnostics);
    return;
  }
  const Span place = part_of(decl, unit_begin + fault.begin, unit_begin + fault.end);
  if (fault.kind == UnitFault::Kind::product_after_slash) return report_two_readings(place, unit, diagnostics);
  if (fault.kind == UnitFault::Kind::percent_in_product)
    return diagnostics.report<DiagnosticCode::percent_in_product>(place, excerpt(unit));
  const std::string symbol = unit.substr(fault.begin, fault.end - fault.begin);
  diagnostics.report<DiagnosticCode::unknown_unit>(place, excerpt(symbol));
  if (const std::string spaced = spaced_unit(symbol); !spaced.empty()) {
    const std::string raised = spaced + exponent_behind(std::string_view(unit).substr(fault.end));
    const bool is_unit = std::holds_alternative<Unit>(parse_unit(raised));
    diagnostics.note<DiagnosticCode::write_instead>({}, is_unit ? raised : spaced);
  } else if (const std::string other = unit_in_other_case(symbol); !other.empty())
    diagnostics.note<DiagnosticCode::write_instead>({}, other);
  else diagnostics.note<DiagnosticCode::known_units>({});
}

// A plain number where nothing but blanks follows.
std::optional<Unit> read_unit(const ValueDecl& decl, std::size_t number_end, Diagnostics& diagnostics) {
  const std::size_t begin = std::min(decl.text.find_first_not_of(' ', number_end), decl.text.size());
  if (begin == decl.text.size()) return Unit{};
  const std::variant<Unit, UnitFault> unit = parse_unit(std::string_view(decl.text).substr(begin));
  if (const auto* known = std::get_if<Unit>(&unit)) return *known;
  report_unit_fault(decl, begin, std::get<UnitFault>(unit), diagnostics);
  return std::nullopt;
}

std::optional<double> read_number(const ValueDecl& decl, std::string_view literal, const Unit& unit,
                                  Diagnostics& diagnostics) {
  const RoundedDecimal rounded = round_decimal(literal, unit);
  if (rounded.rounding == Rounding::finite) return rounded.value;
  if (rounded.rounding == Rounding::overflow)
    diagnostics.report<DiagnosticCode::number_too_large>(decl.span, excerpt(decl.text));
  else diagnostics.report<DiagnosticCode::number_too_small>(decl.span, excerpt(decl.text));
  return std::nullopt;
}

}  // namespace

Span part_of(const ValueDecl& decl, std::size_t begin, std::size_t end) {
  if (decl.span.end - decl.span.begin != decl.text.size() + 2) return decl.span;
  return {decl.span.file, decl.span.begin + 1 + begin, decl.span.begin + 1 + end};
}

bool is_quantity(const ValueDecl& decl) {
  const std::size_t begin = decl.text.find_first_not_of(' ');
  return decl.form == ValueDecl::Form::number || decl.text.find_first_of("0123456789+-.") == begin;
}

std::optional<Quantity> read_quantity(const ValueDecl& decl, Diagnostics& diagnostics) {
  const std::string_view text = decl.text;
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t length = decimal_length(text.substr(begin));
  if (length == 0) {
    diagnostics.report<DiagnosticCode::malformed_quantity>(decl.span, excerpt(text));
    return std::nullopt;
  }
  const std::optional<Unit> unit = read_unit(decl, begin + length, diagnostics);
  if (!unit) return std::nullopt;
  const std::string_view literal = text.substr(begin, length);
  const std::optional<double> value = read_number(decl, literal, *unit, diagnostics);
  if (!value) return std::nullopt;
  const bool is_number = decl.form == ValueDecl::Form::number;
  return Quantity{*value, is_number ? std::nullopt : std::optional(unit->dimension), exact_decimal(literal, *unit)};
}

}  // namespace dashpot::compiler
