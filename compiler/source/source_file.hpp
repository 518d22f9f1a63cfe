// A text the user gave us, and places in it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dashpot::compiler {

class Diagnostics;

// Bytes [begin, end) of a text that the command line put in place of what the file has there.
struct ChangedPart {
  std::size_t begin, end;
  std::string words;  // as "--set K=3"
};

struct Position {
  std::size_t line;    // from 1
  std::size_t column;  // from 1, in bytes
};

class SourceFile {
 public:
  // `first_line`: of an excerpt of a longer file, the number that its first line has there.
  SourceFile(std::string path, std::string text, std::size_t first_line = 1);

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  Position position_of(std::size_t offset) const;
  std::string_view line(std::size_t number) const;  // without its end of line

  void mark_changed(std::vector<ChangedPart> parts) { changed_ = std::move(parts); }
  // The command-line words that put in the text at `offset`; empty if the text is the file's own.
  std::string_view words_at(std::size_t offset) const;

 private:
  std::string path_;
  std::string text_;
  std::vector<std::size_t> line_starts_;
  std::size_t first_line_;
  std::vector<ChangedPart> changed_;
};

// Bytes [begin, end) of a file; `file == nullptr` is "no place".
struct Span {
  const SourceFile* file = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

// Refuses: unreadable files and files above 16 MiB, each with a diagnostic.
std::optional<SourceFile> read_source(const std::string& path, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
