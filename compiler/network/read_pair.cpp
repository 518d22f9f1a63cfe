#include "network/read_pair.hpp"

#include <fmt/format.h>

#include "network/read_value.hpp"
#include "source/excerpt.hpp"
#include "syntax/object_reader.hpp"

namespace dashpot::compiler {

std::optional<double> read_single(std::string_view key, const JsonValue& value, const Dimension& due,
                                  Diagnostics& diagnostics) {
  const std::optional<ValueDecl> decl = read_value(key, value, diagnostics);
  if (!decl) return std::nullopt;
  return read_quantity_as(*decl, {fmt::format("'{}'", key), due, motion::translation}, diagnostics);
}

std::optional<axes::Pair<double>> read_pair(std::string_view key, const JsonValue& value, const Dimension& due,
                                            Diagnostics& diagnostics) {
  if (value.kind != JsonValue::Kind::array || value.items.size() != 2) {
    diagnostics.report<DiagnosticCode::not_a_list_of>(value.span, key, "two values", describe(due) + " for each");
    return std::nullopt;
  }
  const std::optional<double> first = read_single(key, value.items[0], due, diagnostics);
  const std::optional<double> second = read_single(key, value.items[1], due, diagnostics);
  if (!first || !second) return std::nullopt;
  return axes::Pair<double>{*first, *second};
}

std::optional<axes::Pair<double>> read_direction(std::string_view key, const JsonValue& value,
                                                 Diagnostics& diagnostics) {
  const std::optional<axes::Pair<double>> direction = read_pair(key, value, dimensions::number, diagnostics);
  if (!direction || *direction != axes::Pair<double>{0, 0}) return direction;
  diagnostics.report<DiagnosticCode::zero_direction>(value.span, key);
  return std::nullopt;
}

std::optional<axes::Pair<double>> read_span(std::string_view key, const JsonValue& value, const Dimension& due,
                                            Diagnostics& diagnostics) {
  const std::optional<axes::Pair<double>> span = read_pair(key, value, due, diagnostics);
  if (!span || (*span)[0] < (*span)[1]) return span;
  diagnostics.report<DiagnosticCode::empty_range>(value.span, fmt::format("'{}'", key), excerpt(value.items[0].text),
                                                  excerpt(value.items[1].text));
  return std::nullopt;
}

}  // namespace dashpot::compiler
