#include "verify/compare_certificates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "source/excerpt.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

constexpr double closeness = 1e-9;
constexpr std::string_view free_to_differ[] = {"version", "passivity.binding_frequency"};

std::string shown(const JsonValue& value) {
  switch (value.kind) {
    case Kind::array: return fmt::format("a list of {}", value.items.size());
    case Kind::string: return fmt::format("'{}'", excerpt(value.text));
    case Kind::number:
    case Kind::boolean: return value.text;
    default: return std::string(kind_name(value.kind));
  }
}

class Comparison {
 public:
  explicit Comparison(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  // Whether they agree; where they do not, that is reported.
  bool agree(const std::string& path, const JsonValue& stated, const JsonValue& again) {
    if (stated.kind == again.kind) {
      if (std::find(std::begin(free_to_differ), std::end(free_to_differ), path) != std::end(free_to_differ))
        return true;
      if (stated.kind == Kind::object) return objects_agree(path, stated, again);
      if (stated.kind == Kind::array && stated.items.size() == again.items.size())
        return lists_agree(path, stated, again);
      if (stated.kind != Kind::array && values_agree(path, stated, again)) return true;
    }
    diagnostics_.report<DiagnosticCode::certificate_differs>(stated.span, path, shown(stated), shown(again));
    return false;
  }

 private:
  bool objects_agree(const std::string& path, const JsonValue& stated, const JsonValue& again) {
    const std::string inside = path.empty() ? "" : path + ".";
    for (const JsonMember& member : stated.members) {
      const JsonMember* const other = find_member(again, member.key);
      if (other == nullptr)
        diagnostics_.report<DiagnosticCode::certificate_differs>(member.key_span, inside + member.key, "there",
                                                                 "nothing of that name");
      if (other == nullptr || !agree(inside + member.key, member.value, other->value)) return false;
    }
    for (const JsonMember& member : again.members)
      if (find_member(stated, member.key) == nullptr) {
        diagnostics_.report<DiagnosticCode::certificate_differs>(stated.span, inside + member.key, "missing",
                                                                 shown(member.value));
        return false;
      }
    return true;
  }

  bool lists_agree(const std::string& path, const JsonValue& stated, const JsonValue& again) {
    for (std::size_t i = 0; i < stated.items.size(); ++i)
      if (!agree(fmt::format("{}[{}]", path, i), stated.items[i], again.items[i])) return false;
    return true;
  }

  static bool values_agree(const std::string& path, const JsonValue& stated, const JsonValue& again) {
    if (stated.kind != Kind::number) return stated.text == again.text;
    const double a = number_in(stated), b = number_in(again);
    return std::abs(a - b) <= (path.starts_with("storage.") ? 0 : closeness * std::abs(b));
  }

  Diagnostics& diagnostics_;
};

}  // namespace

void compare_certificates(const SourceFile& stated, const SourceFile& again, Diagnostics& diagnostics) {
  const std::optional<JsonValue> first = json_in(stated), second = json_in(again);
  if (first && second) Comparison(diagnostics).agree("", *first, *second);
}

}  // namespace dashpot::compiler
