#include "report/page_parts.hpp"

#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {

Fields fact(const std::string& label, const std::string& value, const std::string& unit, const char* channel) {
  return {{"label", label}, {"value", value}, {"unit", unit}, {"channel", channel}};
}

std::string built_in(const char* name, Diagnostics& diagnostics) {
  const SourceFile* file = find_template(name, std::nullopt, diagnostics);
  return file ? std::string(file->text()) : "";
}

void add_comments(const std::vector<Comment>& comments, CodeModel& model) {
  for (const char* list : {"comments", "remarks", "remarks_end"}) model.lists[list];
  if (!comments.empty()) model.lists["remarks"] = model.lists["remarks_end"] = {{}};
  for (const Comment& comment : comments)
    model.lists["comments"].push_back({{"about", comment.about.empty() ? "" : "<b>" + escaped(comment.about) + "</b> "},
                                       {"text", escaped(comment.text)}});
}

std::string sentence(std::string line) {
  constexpr std::string_view heading = "passivity: ";
  if (line.compare(0, heading.size(), heading) == 0) line.erase(0, heading.size());
  line.erase(0, line.find_first_not_of(' '));
  if (!line.empty() && line[0] >= 'a' && line[0] <= 'z') line[0] = char(line[0] - 'a' + 'A');
  return "<p>" + escaped(in_four_digits(line)) + ".</p>\n";
}

}  // namespace dashpot::compiler
