#include "syntax/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "syntax/object_reader.hpp"

namespace dashpot::compiler {
namespace {

using Kind = JsonValue::Kind;

class AnnotationTaker {
 public:
  explicit AnnotationTaker(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void take(JsonValue& value, const std::string& place) {
    if (value.kind == Kind::object) take_from(value, place);
    for (JsonMember& member : value.members) take(member.value, place.empty() ? member.key : place + "." + member.key);
    for (std::size_t i = 0; i < value.items.size(); ++i) take(value.items[i], fmt::format("{}[{}]", place, i + 1));
  }

  std::vector<CommentDecl> comments;

 private:
  void take_from(JsonValue& object, const std::string& place) {
    const JsonMember* name = find_member(object, "name");
    const bool is_named = !place.empty() && name != nullptr && name->value.kind == Kind::string;
    if (const JsonMember* comment = find_member(object, "comment"))
      read_comment(comment->value, is_named ? name->value.text : place);
    if (const JsonMember* schema = find_member(object, "$schema")) read_text("$schema", schema->value, diagnostics_);
    std::erase_if(object.members, [](const JsonMember& m) { return m.key == "comment" || m.key == "$schema"; });
  }

  void read_comment(const JsonValue& comment, const std::string& about) {
    if (comment.kind != Kind::array) {
      if (const auto text = read_text("comment", comment, diagnostics_)) comments.push_back({about, text->text});
      return;
    }
    for (const JsonValue& line : comment.items)
      if (const auto text = read_text("comment", line, diagnostics_)) comments.push_back({about, text->text});
  }

  Diagnostics& diagnostics_;
};

}  // namespace

std::vector<CommentDecl> take_annotations(JsonValue& root, Diagnostics& diagnostics) {
  AnnotationTaker taker(diagnostics);
  taker.take(root, "");
  return std::move(taker.comments);
}

}  // namespace dashpot::compiler
