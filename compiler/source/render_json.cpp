#include <nlohmann/json.hpp>

#include "source/code_name.hpp"
#include "source/render.hpp"

namespace dashpot::compiler {
namespace {

using Json = nlohmann::ordered_json;

// The command-line words that replace the file's text there; empty if none do.
std::string_view words_at(const Span& span) {
  return span.file == nullptr ? std::string_view() : span.file->words_at(span.begin);
}

// A value from the command line has no line in its file.
Json place_of(const Span& span) {
  if (span.file == nullptr || !words_at(span).empty())
    return {{"file", span.file == nullptr ? Json(nullptr) : Json(span.file->path())},
            {"line", nullptr},
            {"column", nullptr},
            {"end_line", nullptr},
            {"end_column", nullptr}};
  const Position begin = span.file->position_of(span.begin);
  const Position end = span.file->position_of(span.end);
  return {{"file", span.file->path()},
          {"line", begin.line},
          {"column", begin.column},
          {"end_line", end.line},
          {"end_column", end.column}};
}

std::string message_of(const Span& span, const std::string& text) {
  const std::string words(words_at(span));
  return words.empty() ? text : words + ": " + text;
}

Json json_of(const Note& note) {
  Json json = place_of(note.span);
  json["message"] = message_of(note.span, note.text);
  return json;
}

Json json_of(const Diagnostic& diagnostic) {
  Json json = place_of(diagnostic.span);
  json["severity"] = name_of(diagnostic.severity);
  json["code"] = code_name(diagnostic.code);
  json["message"] = message_of(diagnostic.span, diagnostic.text);
  json["notes"] = Json::array();
  for (const Note& note : diagnostic.notes) json["notes"].push_back(json_of(note));
  return json;
}

}  // namespace

std::string render_json(const Diagnostics& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& diagnostic : diagnostics.in_file_order()) list.push_back(json_of(diagnostic));
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string command_line_fault_as_json(const std::string& message) {
  Json json = place_of({});
  json["severity"] = "error";
  json["code"] = "command-line";
  json["message"] = message;
  json["notes"] = Json::array();
  return Json::array({json}).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dashpot::compiler
