// A JSON text as a value in which everything knows its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "source/diagnostic.hpp"

namespace dashpot::compiler {

struct JsonMember;

struct JsonValue {
  enum class Kind { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  Span span;         // strings with their quotes, arrays and objects with their brackets
  std::string text;  // of a string its contents, escapes resolved; of a number or boolean the literal as written
  std::vector<JsonValue> items;     // of an array
  std::vector<JsonMember> members;  // of an object, in file order; no key twice
};

struct JsonMember {
  std::string key;
  Span key_span;
  JsonValue value;
};

// Null where the object has no such key.
const JsonMember* find_member(const JsonValue& object, std::string_view key);

// Of a number, which the parser has seen to fit.
double number_in(const JsonValue& value);

// A string of JSON, between its quotes; bytes that are no UTF-8 become U+FFFD.
std::string json_string(const std::string& text);

// "a string", "a list", …
std::string_view kind_name(JsonValue::Kind kind);

// In: a file. Out: its value. Refuses: what is not JSON (RFC 8259, in UTF-8, a byte order mark allowed), the first
// fault only; numbers beyond a double; more than 100 levels or 500,000 values. Of equal keys the first stays, the
// others are reported.
std::optional<JsonValue> parse_json(const SourceFile& file, Diagnostics& diagnostics);

// The same, to see what kind of file it is: empty if it is not JSON. Faults are left to the function that then reads
// it.
std::optional<JsonValue> json_in(const SourceFile& file);

}  // namespace dashpot::compiler
