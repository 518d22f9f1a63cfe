#include "syntax/json.hpp"

#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "source/excerpt.hpp"
#include "syntax/json_fault.hpp"
#include "syntax/token_cursor.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t deepest_level = 100;
constexpr std::size_t most_values = 500'000;

using Kind = JsonValue::Kind;
using Next = JsonContext::Next;

// The first of equal keys stays.
void refuse_duplicate_keys(JsonValue& object, Diagnostics& diagnostics) {
  std::unordered_map<std::string_view, Span> first_places;
  std::vector<bool> is_kept;
  for (const JsonMember& member : object.members) {
    const auto [first, is_new] = first_places.emplace(member.key, member.key_span);
    is_kept.push_back(is_new);
    if (is_new) continue;
    diagnostics.report<DiagnosticCode::duplicate_key>(member.key_span, excerpt(member.key));
    diagnostics.note<DiagnosticCode::first_given_here>(first->second);
  }
  if (first_places.size() == object.members.size()) return;
  // Views of the keys end here: moving a member moves its key.
  std::vector<JsonMember> kept;
  for (std::size_t i = 0; i < object.members.size(); ++i)
    if (is_kept[i]) kept.push_back(std::move(object.members[i]));
  object.members = std::move(kept);
}

// Receives nlohmann's SAX events and follows them with a cursor over the text.
class JsonBuilder {
 public:
  JsonBuilder(const SourceFile& file, Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics), cursor_(file) {}

  bool null() { return word(Kind::null, "null"); }
  bool boolean(bool value) { return word(Kind::boolean, value ? "true" : "false"); }
  bool number_integer(std::int64_t) { return number(); }
  bool number_unsigned(std::uint64_t) { return number(); }
  bool number_float(double, const std::string&) { return number(); }
  bool string(std::string& text) { return add({Kind::string, cursor_.next(), std::move(text), {}, {}}) != nullptr; }
  bool binary(nlohmann::json::binary_t&) { return false; }  // never sent for text
  bool start_object(std::size_t) { return open(Kind::object); }
  bool start_array(std::size_t) { return open(Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& text) {
    key_ = {std::move(text), cursor_.next(), {}};
    after_key_ = true;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& fault) {
    constexpr int number_overflow = 406;
    if (fault.id == number_overflow) return refuse_number();
    report_json_fault(file_, context(), diagnostics_);
    return false;
  }

  // Nothing but blanks may follow; the parser itself takes a zero byte for the end.
  bool reaches_end() {
    if (skip_blanks(file_, cursor_.offset()) == file_.text().size()) return true;
    report_json_fault(file_, context(), diagnostics_);
    return false;
  }

  JsonValue take_root() { return std::move(root_); }

 private:
  bool refuse_number() {
    const Span place = cursor_.next();
    diagnostics_.report<DiagnosticCode::number_too_large>(place, excerpt(text_of(place)));
    return false;
  }

  // The parser takes the longest beginning that is a number ("0" of "0x10"); the token is what the author wrote.
  bool number() {
    const Span span = cursor_.next();
    if (nlohmann::json::accept(text_of(span)))
      return add({Kind::number, span, std::string(text_of(span)), {}, {}}) != nullptr;
    diagnostics_.report<DiagnosticCode::malformed_number>(span, excerpt(text_of(span)));
    return false;
  }

  bool word(Kind kind, std::string_view expected) {
    const Span span = cursor_.next();
    if (text_of(span) == expected) return add({kind, span, std::string(expected), {}, {}}) != nullptr;
    diagnostics_.report<DiagnosticCode::unexpected_token>(span, fmt::format("'{}'", excerpt(text_of(span))), "a value");
    return false;
  }

  bool open(Kind kind) {
    JsonValue* value = add({kind, cursor_.next(), {}, {}, {}});
    if (value == nullptr) return false;
    open_.push_back(value);
    if (open_.size() <= deepest_level) return true;
    diagnostics_.report<DiagnosticCode::too_deep>(value->span, deepest_level);
    return false;
  }

  bool close() {
    open_.back()->span.end = cursor_.next().end;
    refuse_duplicate_keys(*open_.back(), diagnostics_);
    open_.pop_back();
    return true;
  }

  JsonValue* add(JsonValue value) {
    after_key_ = false;
    if (++count_ > most_values) {
      diagnostics_.report<DiagnosticCode::too_many_values>(value.span, most_values);
      return nullptr;
    }
    if (open_.empty()) return &(root_ = std::move(value));
    if (open_.back()->kind == Kind::array) return &open_.back()->items.emplace_back(std::move(value));
    key_.value = std::move(value);
    return &open_.back()->members.emplace_back(std::move(key_)).value;
  }

  JsonContext context() const {
    if (open_.empty()) return {count_ == 0 ? Next::value : Next::end_of_file, cursor_.offset(), std::nullopt};
    return {next_inside(*open_.back()), cursor_.offset(),
            Span{&file_, open_.back()->span.begin, open_.back()->span.begin + 1}};
  }

  Next next_inside(const JsonValue& value) const {
    if (after_key_) return Next::colon;
    if (value.kind == Kind::array) return value.items.empty() ? Next::first_item : Next::more_items;
    return value.members.empty() ? Next::first_key : Next::more_members;
  }

  std::string_view text_of(const Span& span) const {
    return std::string_view(file_.text()).substr(span.begin, span.end - span.begin);
  }

  const SourceFile& file_;
  Diagnostics& diagnostics_;
  TokenCursor cursor_;
  JsonValue root_;
  std::vector<JsonValue*> open_;  // innermost last; a value does not move while one inside it is open
  JsonMember key_;
  bool after_key_ = false;
  std::size_t count_ = 0;
};

}  // namespace

const JsonMember* find_member(const JsonValue& object, std::string_view key) {
  for (const JsonMember& member : object.members)
    if (member.key == key) return &member;
  return nullptr;
}

double number_in(const JsonValue& value) {
  double number = 0;
  std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
  return number;
}

std::string_view kind_name(JsonValue::Kind kind) {
  switch (kind) {
    case Kind::null: return "null";
    case Kind::boolean: return "true or false";
    case Kind::number: return "a number";
    case Kind::string: return "a string";
    case Kind::array: return "a list";
    case Kind::object: return "an object";
  }
  return {};
}

std::string json_string(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::optional<JsonValue> parse_json(const SourceFile& file, Diagnostics& diagnostics) {
  JsonBuilder builder(file, diagnostics);
  if (!nlohmann::json::sax_parse(file.text(), &builder) || !builder.reaches_end()) return std::nullopt;
  return builder.take_root();
}

std::optional<JsonValue> json_in(const SourceFile& file) {
  Diagnostics of_reader;
  return parse_json(file, of_reader);
}

}  // namespace dashpot::compiler
