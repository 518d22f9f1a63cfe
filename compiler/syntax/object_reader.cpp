#include "syntax/object_reader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "source/excerpt.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {

using Kind = JsonValue::Kind;

ObjectReader::ObjectReader(const JsonValue& value, std::string owner, Diagnostics& diagnostics)
    : object_(value), owner_(std::move(owner)), diagnostics_(diagnostics) {}

void ObjectReader::refuse_other_keys(const std::vector<std::string>& keys) {
  for (const JsonMember& member : object_.members) {
    if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) continue;
    if (const auto nearest = report_unknown_key({member.key, member.key_span}, owner_, keys, diagnostics_))
      misspelt_.push_back(*nearest);
  }
}

const JsonMember* ObjectReader::find(std::string_view key) const { return find_member(object_, key); }

const JsonMember* ObjectReader::require(std::string_view key) const {
  const JsonMember* member = find(key);
  if (member == nullptr && !is_misspelt(key)) diagnostics_.report<DiagnosticCode::missing_key>(opening(), owner_, key);
  return member;
}

bool ObjectReader::is_misspelt(std::string_view key) const {
  return std::find(misspelt_.begin(), misspelt_.end(), key) != misspelt_.end();
}

ObjectReader::Only ObjectReader::only_one_of(const std::vector<std::string>& keys, std::string_view what) const {
  const auto is_one = [&](const JsonMember& m) { return std::find(keys.begin(), keys.end(), m.key) != keys.end(); };
  const auto first = std::find_if(object_.members.begin(), object_.members.end(), is_one);
  if (first == object_.members.end())
    return {nullptr, std::any_of(keys.begin(), keys.end(), [&](const std::string& key) { return is_misspelt(key); })};
  const auto second = std::find_if(first + 1, object_.members.end(), is_one);
  if (second == object_.members.end()) return {&*first, false};
  diagnostics_.report<DiagnosticCode::two_kinds_at_once>(second->key_span, what, first->key, second->key);
  diagnostics_.note<DiagnosticCode::first_given_here>(first->key_span);
  return {nullptr, true};
}

std::optional<Text> ObjectReader::text(std::string_view key) const {
  const JsonMember* member = find(key);
  return member == nullptr ? std::nullopt : read_text(key, member->value, diagnostics_);
}

std::optional<ValueDecl> ObjectReader::value(std::string_view key) const {
  const JsonMember* member = find(key);
  return member == nullptr ? std::nullopt : read_value(key, member->value, diagnostics_);
}

bool ObjectReader::flag(std::string_view key) const {
  const JsonMember* member = find(key);
  if (member == nullptr) return false;
  if (member->value.kind != Kind::boolean) report_wrong_type(key, member->value, "true or false", diagnostics_);
  return member->value.text == "true";
}

const JsonValue* ObjectReader::object(std::string_view key) const {
  const JsonMember* member = find(key);
  if (member == nullptr || member->value.kind == Kind::object) return member == nullptr ? nullptr : &member->value;
  report_wrong_type(key, member->value, key == "contact" ? "an object such as { \"at\": \"2 mm\" }" : "an object",
                    diagnostics_);
  return nullptr;
}

const JsonValue* ObjectReader::list(std::string_view key) const {
  const JsonMember* member = find(key);
  if (member == nullptr || member->value.kind == Kind::array) return member == nullptr ? nullptr : &member->value;
  report_wrong_type(key, member->value, "a list", diagnostics_);
  return nullptr;
}

std::optional<RangeDecl> ObjectReader::range(std::string_view key) const {
  const JsonMember* member = find(key);
  if (member == nullptr) return std::nullopt;
  const JsonValue& value = member->value;
  if (value.kind == Kind::array && value.items.size() == 2) {
    const std::optional<ValueDecl> low = read_value(key, value.items[0], diagnostics_);
    const std::optional<ValueDecl> high = read_value(key, value.items[1], diagnostics_);
    return low && high ? std::optional(RangeDecl{low, *high, value.span}) : std::nullopt;
  }
  if (value.kind == Kind::number || value.kind == Kind::string)
    return RangeDecl{std::nullopt, *read_value(key, value, diagnostics_), value.span};
  report_wrong_type(key, value, "[low, high] or the upper bound", diagnostics_);
  return std::nullopt;
}

Span ObjectReader::opening() const { return {object_.span.file, object_.span.begin, object_.span.begin + 1}; }

// Other people's names for the way from a motor to a tool.
static bool is_transmission(std::string_view key) {
  for (const std::string_view name :
       {"gear_ratio", "capstan_ratio", "transmission_ratio", "reduction", "ratio", "gear", "capstan"})
    if (key == name) return true;
  return false;
}

// The key of a motor that data sheets have another name for; empty for any other name.
static std::string_view key_on_data_sheets(std::string_view key) {
  for (const std::string_view name : {"kt", "Kt", "KT", "k_t", "K_t", "kf", "Kf", "k_f", "K_f", "force_constant"})
    if (key == name) return "torque_constant";
  return "";
}

std::optional<std::string> report_unknown_key(const Text& key, std::string_view owner,
                                              const std::vector<std::string>& keys, Diagnostics& diagnostics) {
  diagnostics.report<DiagnosticCode::unknown_key>(key.span, owner, excerpt(key.text));
  const std::optional<std::string> nearest = nearest_name(key.text, keys);
  if (is_transmission(key.text)) diagnostics.note<DiagnosticCode::gear_ratio_instead>({});
  else if (const std::string_view called = key_on_data_sheets(key.text);
           std::find(keys.begin(), keys.end(), called) != keys.end())
    diagnostics.note<DiagnosticCode::key_is_called>({}, called);
  else if (nearest) diagnostics.note<DiagnosticCode::nearest_name>({}, *nearest);
  else diagnostics.note<DiagnosticCode::known_keys>({}, fmt::format("{}", fmt::join(keys, ", ")));
  return nearest;
}

void report_wrong_type(std::string_view key, const JsonValue& value, std::string_view expected,
                       Diagnostics& diagnostics) {
  diagnostics.report<DiagnosticCode::wrong_type>(value.span, key, kind_name(value.kind), expected);
}

std::optional<ValueDecl> read_value(std::string_view key, const JsonValue& value, Diagnostics& diagnostics) {
  if (value.kind == Kind::number) return ValueDecl{ValueDecl::Form::number, value.text, value.span};
  if (value.kind == Kind::string) return ValueDecl{ValueDecl::Form::text, value.text, value.span};
  report_wrong_type(key, value, "a number or a string such as \"5 N/m\"", diagnostics);
  return std::nullopt;
}

std::optional<Text> read_text(std::string_view key, const JsonValue& value, Diagnostics& diagnostics) {
  if (value.kind == Kind::string) return Text{value.text, value.span};
  report_wrong_type(key, value, "a string", diagnostics);
  return std::nullopt;
}

}  // namespace dashpot::compiler
