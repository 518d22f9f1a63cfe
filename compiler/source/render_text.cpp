#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "source/code_name.hpp"
#include "source/render.hpp"
#include "source/utf8.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t widest_line = 120;    // columns of a source line that are shown
constexpr std::size_t context_before = 40;  // columns kept before the place where a longer line is cut

bool is_control(char byte) { return static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F; }

// What a terminal shows for the code point at the start of `text`: never a control character, never a stray byte.
std::string_view printable(std::string_view text, std::size_t length) {
  if (length == 0) return "?";
  return is_control(text.front()) ? " " : text.substr(0, length);
}

// One entry a column.
std::vector<std::string_view> columns_of(std::string_view text) {
  std::vector<std::string_view> columns;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = code_point_length(text.substr(i));
    columns.push_back(printable(text.substr(i), length));
    i += std::max<std::size_t>(1, length);
  }
  return columns;
}

std::string joined(const std::vector<std::string_view>& columns) {
  std::string text;
  for (const std::string_view column : columns) text += column;
  return text;
}

struct Picture {
  std::vector<std::string_view> columns;
  std::size_t underline_begin;
  std::size_t underline_end;
};

Picture cut_to_window(Picture picture) {
  if (picture.columns.size() <= widest_line) return picture;
  const std::size_t first = picture.underline_begin > context_before ? picture.underline_begin - context_before : 0;
  const std::size_t last = std::min(first + widest_line, picture.columns.size());
  Picture window{
      {picture.columns.begin() + static_cast<std::ptrdiff_t>(first),
       picture.columns.begin() + static_cast<std::ptrdiff_t>(last)},
      picture.underline_begin - first,
      std::max(picture.underline_begin + 1, std::min(picture.underline_end, last)) - first};  // a file may end there
  if (first > 0) window.columns.front() = "…";
  if (last < picture.columns.size()) window.columns.back() = "…";
  return window;
}

// Of a place that spans several lines the first is shown, underlined to its end.
Picture picture_of(const Span& span, const Position& begin) {
  const std::string_view line = span.file->line(begin.line);
  const std::size_t from = std::min(begin.column - 1, line.size());
  const std::size_t to = std::clamp(from + (span.end - span.begin), from, line.size());
  const std::size_t underline_begin = columns_of(line.substr(0, from)).size();
  const std::size_t underline_length = std::max<std::size_t>(1, columns_of(line.substr(from, to - from)).size());
  return cut_to_window({columns_of(line), underline_begin, underline_begin + underline_length});
}

void append_picture(std::string& out, const Span& span) {
  const Position begin = span.file->position_of(span.begin);
  const Picture picture = picture_of(span, begin);
  const std::string gap(picture.underline_begin, ' ');
  const std::string tail(picture.underline_end - picture.underline_begin - 1, '~');
  fmt::format_to(std::back_inserter(out), "{:5} | {}\n      | {}^{}\n", begin.line, joined(picture.columns), gap, tail);
}

void append_entry(std::string& out, const Span& span, Severity severity, std::string_view text, std::string_view code) {
  const std::string_view words = span.file == nullptr ? std::string_view() : span.file->words_at(span.begin);
  if (!words.empty()) {
    fmt::format_to(std::back_inserter(out), "{}: {}: ", joined(columns_of(span.file->path())),
                   joined(columns_of(words)));
  } else if (span.file != nullptr) {
    const Position begin = span.file->position_of(span.begin);
    fmt::format_to(std::back_inserter(out), "{}:{}:{}: ", joined(columns_of(span.file->path())), begin.line,
                   begin.column);
  }
  fmt::format_to(std::back_inserter(out), "{}: {}{}\n", name_of(severity), joined(columns_of(text)), code);
  if (span.file != nullptr && words.empty()) append_picture(out, span);
}

}  // namespace

std::string render_text(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.in_file_order()) {
    append_entry(out, diagnostic.span, diagnostic.severity, diagnostic.text,
                 fmt::format(" [{}]", code_name(diagnostic.code)));
    for (const Note& note : diagnostic.notes) append_entry(out, note.span, Severity::note, note.text, "");
  }
  return out;
}

}  // namespace dashpot::compiler
