#include "network/quantity.hpp"

#include <string_view>
#include <variant>

#include "network/decimal.hpp"
#include "network/unit.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

// The place of bytes [begin, end) of the value; the whole of it where escapes hide them.
Span part_of(const ValueDecl& decl, std::size_t begin, std::size_t end) {
  if (decl.span.end - decl.span.begin != decl.text.size() + 2) return decl.span;
  return {decl.span.file, decl.span.begin + 1 + begin, decl.span.begin + 1 + end};
}

void report_unit_fault(const ValueDecl& decl, std::size_t unit_begin, const UnitFault& fault, Diagnostics& diagnostics) {
  const std::size_t begin = unit_begin + fault.begin;
  const std::size_t end = unit_begin + fault.end;
  const Span place = part_of(decl, begin, end);
  const std::string text = decl.text.substr(begin, end - begin);
  if (fault.kind == UnitFault::Kind::product_after_slash)
    return diagnostics.report<DiagnosticCode::product_after_slash>(place, excerpt(decl.text.substr(unit_begin)));
  if (fault.kind == UnitFault::Kind::malformed)
    return diagnostics.report<DiagnosticCode::malformed_unit>(decl.span, excerpt(decl.text.substr(unit_begin)));
  diagnostics.report<DiagnosticCode::unknown_unit>(place, excerpt(text));
  if (const std::string spaced = spaced_unit(text); !spaced.empty())
    diagnostics.note<DiagnosticCode::write_instead>({}, spaced);
}

std::optional<double> read_number(const ValueDecl& decl, std::string_view literal, const Unit& unit,
                                  Diagnostics& diagnostics) {
  const RoundedDecimal rounded = round_decimal(literal, unit);
  if (rounded.rounding == Rounding::finite) return rounded.value;
  if (rounded.rounding == Rounding::overflow)
    diagnostics.report<DiagnosticCode::number_too_large>(decl.span, excerpt(decl.text));
  else
    diagnostics.report<DiagnosticCode::number_too_small>(decl.span, excerpt(decl.text));
  return std::nullopt;
}

}  // namespace

bool is_quantity(const ValueDecl& decl) {
  return decl.form == ValueDecl::Form::number || decl.text.find_first_of("0123456789+-.") == 0;
}

std::optional<Quantity> read_quantity(const ValueDecl& decl, Diagnostics& diagnostics) {
  const std::string_view text = decl.text;
  const std::size_t length = decimal_length(text);
  if (length == 0) {
    diagnostics.report<DiagnosticCode::malformed_quantity>(decl.span, excerpt(text));
    return std::nullopt;
  }
  const std::size_t unit_begin = std::min(text.find_first_not_of(' ', length), text.size());
  if (unit_begin == text.size()) {
    const std::optional<double> value = read_number(decl, text.substr(0, length), {}, diagnostics);
    if (!value) return std::nullopt;
    return Quantity{*value, decl.form == ValueDecl::Form::number ? std::nullopt : std::optional(dimensions::number)};
  }
  const std::variant<Unit, UnitFault> unit = parse_unit(text.substr(unit_begin));
  if (const auto* fault = std::get_if<UnitFault>(&unit)) {
    report_unit_fault(decl, unit_begin, *fault, diagnostics);
    return std::nullopt;
  }
  const std::optional<double> value = read_number(decl, text.substr(0, length), std::get<Unit>(unit), diagnostics);
  if (!value) return std::nullopt;
  return Quantity{*value, std::get<Unit>(unit).dimension};
}

}  // namespace dashpot::compiler
