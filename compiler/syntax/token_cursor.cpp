#include "syntax/token_cursor.hpp"

#include <algorithm>

#include "source/utf8.hpp"

namespace dashpot::compiler {
namespace {

bool is_word_byte(char byte) {
  return (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '+' ||
         byte == '-' || byte == '.' || byte == '_';
}

std::size_t end_of_string(std::string_view text, std::size_t quote) {
  for (std::size_t i = quote + 1; i < text.size() && text[i] != '\n'; ++i) {
    if (text[i] == '"') return i + 1;
    if (text[i] == '\\') ++i;
  }
  return std::min(text.find('\n', quote), text.size());
}

std::size_t end_of_word(std::string_view text, std::size_t begin) {
  const auto end = std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(begin), text.end(), is_word_byte);
  return static_cast<std::size_t>(end - text.begin());
}

std::size_t end_of_token(std::string_view text, std::size_t begin) {
  if (begin == text.size()) return begin;
  if (text[begin] == '"') return end_of_string(text, begin);
  if (is_word_byte(text[begin])) return end_of_word(text, begin);
  return begin + std::max<std::size_t>(1, code_point_length(text.substr(begin)));
}

}  // namespace

Span token_at(const SourceFile& file, std::size_t offset) { return {&file, offset, end_of_token(file.text(), offset)}; }

std::size_t skip_blanks(const SourceFile& file, std::size_t offset) {
  return std::min(file.text().find_first_not_of(" \t\r\n", offset), file.text().size());
}

TokenCursor::TokenCursor(const SourceFile& file)
    : file_(&file), offset_(file.text().starts_with(byte_order_mark) ? byte_order_mark.size() : 0) {}

Span TokenCursor::next() {
  const std::size_t begin = std::min(file_->text().find_first_not_of(" \t\r\n,:", offset_), file_->text().size());
  const Span token = token_at(*file_, begin);
  offset_ = token.end;
  return token;
}

}  // namespace dashpot::compiler
