// Reads an object of known keys, and says what is wrong with it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "syntax/json.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

class ObjectReader {
 public:
  // `owner` names the object in messages: "the network", "a parameter". `value` must be an object and outlive the
  // reader.
  ObjectReader(const JsonValue& value, std::string owner, Diagnostics& diagnostics);

  // Reports every key that is not one of `keys`, with the nearest of them.
  void refuse_other_keys(const std::vector<std::string>& keys);

  const JsonMember* find(std::string_view key) const;     // null where absent
  const JsonMember* require(std::string_view key) const;  // reports where absent and not reported as misspelt
  bool is_misspelt(std::string_view key) const;           // known after refuse_other_keys

  // The one member that has one of these keys. Null where there are two, reported as of `what`; and where there is
  // none, reported by `code` with `arguments`, unless one of them was misspelt.
  template <DiagnosticCode code, class... Arguments>
  const JsonMember* one_of(const std::vector<std::string>& keys, std::string_view what,
                           const Arguments&... arguments) const {
    const Only only = only_one_of(keys, what);
    if (only.member == nullptr && !only.is_told) diagnostics_.report<code>(opening(), arguments...);
    return only.member;
  }

  // Nothing where the key is absent or, reported, of another type.
  std::optional<Text> text(std::string_view key) const;
  std::optional<ValueDecl> value(std::string_view key) const;
  bool flag(std::string_view key) const;  // false where absent
  const JsonValue* object(std::string_view key) const;
  const JsonValue* list(std::string_view key) const;
  std::optional<RangeDecl> range(std::string_view key) const;

  Span opening() const;  // of the object: its bracket

 private:
  struct Only {
    const JsonMember* member;
    bool is_told;  // why there is none
  };
  Only only_one_of(const std::vector<std::string>& keys, std::string_view what) const;

  const JsonValue& object_;
  std::string owner_;
  Diagnostics& diagnostics_;
  std::vector<std::string> misspelt_;  // keys that were probably meant by unknown ones
};

// Returns the nearest of `keys`, which the report names; where there is none it names all of them.
std::optional<std::string> report_unknown_key(const Text& key, std::string_view owner,
                                              const std::vector<std::string>& keys, Diagnostics& diagnostics);

void report_wrong_type(std::string_view key, const JsonValue& value, std::string_view expected,
                       Diagnostics& diagnostics);

// A number or a string; anything else is reported as the wrong type for `key`.
std::optional<ValueDecl> read_value(std::string_view key, const JsonValue& value, Diagnostics& diagnostics);
std::optional<Text> read_text(std::string_view key, const JsonValue& value, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
