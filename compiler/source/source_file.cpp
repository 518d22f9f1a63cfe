#include "source/source_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <utility>

#include "source/diagnostic.hpp"
#include "source/utf8.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t largest_file = 16u << 20;  // [bytes]

std::vector<std::size_t> find_line_starts(std::string_view text) {
  std::vector<std::size_t> starts{text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') starts.push_back(i + 1);
  return starts;
}

// Stops soon after the limit, so that an endless pipe is bounded too.
std::optional<std::string> read_bounded(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  std::array<char, 65536> block;
  while (stream && text.size() <= largest_file) {
    stream.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (!stream.is_open() || stream.bad()) return std::nullopt;
  return text;
}

}  // namespace

SourceFile::SourceFile(std::string path, std::string text, std::size_t first_line)
    : path_(std::move(path)), text_(std::move(text)), line_starts_(find_line_starts(text_)), first_line_(first_line) {}

Position SourceFile::position_of(std::size_t offset) const {
  const std::size_t place = std::clamp(offset, line_starts_.front(), std::max(line_starts_.front(), text_.size()));
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), place);
  return {first_line_ - 1 + static_cast<std::size_t>(after - line_starts_.begin()), place - *(after - 1) + 1};
}

std::string_view SourceFile::line(std::size_t number) const {
  const std::size_t begin = line_starts_[number - first_line_];
  const std::size_t end = std::min(text_.find('\n', begin), text_.size());
  std::string_view line = std::string_view(text_).substr(begin, end - begin);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view SourceFile::words_at(std::size_t offset) const {
  const auto holds = [&](const ChangedPart& part) { return part.begin <= offset && offset < part.end; };
  const auto part = std::find_if(changed_.begin(), changed_.end(), holds);
  return part == changed_.end() ? std::string_view() : part->words;
}

std::optional<SourceFile> read_source(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    diagnostics.report<DiagnosticCode::cannot_read_file>({}, path, "it is a folder");
    return std::nullopt;
  }
  std::optional<std::string> text = read_bounded(path);
  if (!text) {
    const bool exists = std::filesystem::exists(path, error);
    diagnostics.report<DiagnosticCode::cannot_read_file>({}, path, exists ? "reading failed" : "there is no such file");
    if (path == "-") diagnostics.note<DiagnosticCode::standard_input_is_called>({});
    return std::nullopt;
  }
  if (text->size() > largest_file) {
    diagnostics.report<DiagnosticCode::file_too_large>({}, path, largest_file >> 20);
    return std::nullopt;
  }
  return SourceFile(path, std::move(*text));
}

}  // namespace dashpot::compiler
