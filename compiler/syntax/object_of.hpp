// An object put together from members of others; each keeps its place in the file.
#pragma once

#include <string>

#include "syntax/json.hpp"

namespace dashpot::compiler {

class ObjectOf {
 public:
  explicit ObjectOf(Span span) { object_.kind = JsonValue::Kind::object, object_.span = span; }
  void take(const JsonMember* member) {
    if (member != nullptr) object_.members.push_back(*member);
  }
  void take(const std::string& key, Span key_span, const JsonValue& value) {
    object_.members.push_back({key, key_span, value});
  }
  const JsonValue& value() const { return object_; }

 private:
  JsonValue object_;
};

}  // namespace dashpot::compiler
