#include "syntax/parse_static.hpp"

#include <algorithm>

#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

const std::vector<std::string> curve_kinds = {"power", "exponential", "table"};

std::optional<std::pair<ValueDecl, ValueDecl>> parse_row(const JsonValue& row, Diagnostics& diagnostics) {
  if (row.kind != Kind::array || row.items.size() != 2) {
    diagnostics.report<DiagnosticCode::static_row>(row.span);
    return std::nullopt;
  }
  const std::optional<ValueDecl> displacement = read_value("table", row.items[0], diagnostics);
  const std::optional<ValueDecl> force = read_value("table", row.items[1], diagnostics);
  return displacement && force ? std::optional(std::pair(*displacement, *force)) : std::nullopt;
}

}  // namespace

std::optional<StaticDecl> parse_static(const JsonValue& value, Diagnostics& diagnostics) {
  ObjectReader reader(value, "'static'", diagnostics);
  const bool is_table = std::any_of(value.members.begin(), value.members.end(),
                                    [](const JsonMember& member) { return member.key == "table"; });
  reader.refuse_other_keys(is_table ? std::vector<std::string>{"table", "power", "exponential", "is"}
                                    : std::vector<std::string>{"power", "exponential", "table", "force", "at", "is"});
  const JsonMember* kind = reader.one_of<DiagnosticCode::static_without_kind>(curve_kinds, "static");
  if (kind == nullptr) return std::nullopt;
  StaticDecl decl;
  decl.kind = kind->key;
  decl.is = reader.text("is");
  decl.span = value.span;
  decl.kind_span = kind->key_span;
  if (!is_table) {
    decl.shape = reader.value(kind->key);
    reader.require("force");
    reader.require("at");
    decl.force = reader.value("force");
    decl.at = reader.value("at");
    return decl;
  }
  const JsonValue* rows = reader.list("table");
  if (rows == nullptr) return std::nullopt;
  for (const JsonValue& row : rows->items) {
    auto pair = parse_row(row, diagnostics);
    if (!pair) return std::nullopt;
    decl.table.push_back(std::move(*pair));
  }
  return decl;
}

}  // namespace dashpot::compiler
