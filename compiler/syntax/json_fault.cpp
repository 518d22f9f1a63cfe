#include "syntax/json_fault.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "source/excerpt.hpp"
#include "source/utf8.hpp"
#include "syntax/token_cursor.hpp"

namespace dashpot::compiler {
namespace {

using Next = JsonContext::Next;

struct Fault {
  Span place;
  Next next;                  // what may stand there
  std::optional<Span> comma;  // the comma that has just been read
};

std::string_view text_of(const Span& span) {
  return std::string_view(span.file->text()).substr(span.begin, span.end - span.begin);
}

std::string_view expectation(const Fault& fault) {
  switch (fault.next) {
    case Next::value: return "a value";
    case Next::first_item: return "a value or ']'";
    case Next::first_key: return fault.comma ? "a key in double quotes" : "a key in double quotes or '}'";
    case Next::colon: return "':'";
    case Next::more_items: return "',' or ']'";
    case Next::more_members: return "',' or '}'";
    case Next::end_of_file: return "the end of the file";
  }
  return {};
}

bool takes(Next next, char separator) {
  if (separator == ':') return next == Next::colon;
  return separator == ',' && (next == Next::more_items || next == Next::more_members);
}

// Steps over the one separator that belongs where it stands.
Fault find_fault(const SourceFile& file, const JsonContext& context) {
  const std::string& text = file.text();
  Fault fault{token_at(file, skip_blanks(file, context.offset)), context.next, std::nullopt};
  if (fault.place.begin == text.size() || !takes(context.next, text[fault.place.begin])) return fault;
  if (context.next != Next::colon) fault.comma = fault.place;
  fault.next = context.next == Next::more_members ? Next::first_key : Next::value;
  fault.place = token_at(file, skip_blanks(file, fault.place.end));
  return fault;
}

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of("0123456789abcdefABCDEF") == std::string_view::npos;
}

bool is_escape(std::string_view text) {
  if (text.size() < 2) return false;
  if (text[1] == 'u') return text.size() >= 6 && is_hexadecimal(text.substr(2, 4));
  return std::string_view("\"\\/bfnrt").find(text[1]) != std::string_view::npos;
}

// The first thing inside the string that JSON does not allow there.
void report_string_fault(const Span& place, Diagnostics& diagnostics) {
  const std::string_view text = text_of(place);
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = code_point_length(text.substr(i));
    const Span here{place.file, place.begin + i, place.begin + i + std::max<std::size_t>(1, length)};
    if (length == 0) return diagnostics.report<DiagnosticCode::not_utf8>(here, byte);
    if (byte < 0x20 && text[i] != '\r') return diagnostics.report<DiagnosticCode::control_character>(here, byte);
    if (byte == '\\' && !is_escape(text.substr(i)))
      return diagnostics.report<DiagnosticCode::unknown_escape>(here, excerpt(text.substr(i, 2)));
    i += byte == '\\' ? 2 : length;
  }
  if (text.size() < 2 || !text.ends_with('"')) return diagnostics.report<DiagnosticCode::unclosed_string>(place);
  diagnostics.report<DiagnosticCode::lone_surrogate>(place);
}

bool looks_numeric(std::string_view token) {
  return token.find_first_of("0123456789") == token.find_first_not_of("+-.") && !token.empty();
}

std::string shown(std::string_view token) {
  if (token.empty()) return "the end of the file";
  const auto byte = static_cast<unsigned char>(token.front());
  return byte < 0x20 ? fmt::format("control character U+{:04X}", byte) : fmt::format("'{}'", excerpt(token));
}

void report_unexpected(const Fault& fault, const JsonContext& context, Diagnostics& diagnostics) {
  const std::string_view token = text_of(fault.place);
  const std::string found = shown(token);
  diagnostics.report<DiagnosticCode::unexpected_token>(fault.place, found, expectation(fault));
  if (fault.comma && (token == "}" || token == "]")) diagnostics.note<DiagnosticCode::needless_comma>(*fault.comma);
  const bool is_bare_key =
      fault.next == Next::first_key && !token.empty() && std::isalpha(static_cast<unsigned char>(token.front()));
  if (token == "'" || is_bare_key) diagnostics.note<DiagnosticCode::double_quotes>({});
  if (token.empty() && context.open_bracket)
    diagnostics.note<DiagnosticCode::unclosed_bracket>(*context.open_bracket, text_of(*context.open_bracket));
}

}  // namespace

void report_json_fault(const SourceFile& file, const JsonContext& context, Diagnostics& diagnostics) {
  const Fault fault = find_fault(file, context);
  const std::string_view token = text_of(fault.place);
  const bool wants_value = fault.next == Next::value || fault.next == Next::first_item;
  if (token.starts_with('"') && (wants_value || fault.next == Next::first_key))
    return report_string_fault(fault.place, diagnostics);
  if (token == "/" || token == "#") return diagnostics.report<DiagnosticCode::comment_in_json>(fault.place);
  if (wants_value && looks_numeric(token))
    return diagnostics.report<DiagnosticCode::malformed_number>(fault.place, excerpt(token));
  report_unexpected(fault, context, diagnostics);
}

}  // namespace dashpot::compiler
