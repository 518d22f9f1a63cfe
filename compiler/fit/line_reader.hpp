// A recording's lines, one at a time: the file is never held whole.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "source/diagnostic.hpp"
#include "source/digest.hpp"

namespace dashpot::compiler::fitting {

inline constexpr std::size_t largest_recording = std::size_t{1} << 30;  // [bytes]
inline constexpr std::size_t longest_line = std::size_t{1} << 20;       // [bytes]

// What a reader is at: bytes read, and of how many where that is known.
using ReadProgress = std::function<void(std::size_t done, std::size_t of)>;

class LineReader {
 public:
  // Reads on from `text` where one is given, else from the file.
  LineReader(std::string path, ReadProgress progress);
  LineReader(std::string path, std::string text);

  // Refuses: what cannot be read, is no text (NUL bytes, UTF-16), or is larger than 1 GiB, lines longer than 1 MiB.
  bool open(Diagnostics& diagnostics);

  // Without its end and without a byte order mark; valid until the next call. Nothing at the end, or after a fault.
  std::optional<std::string_view> next(Diagnostics& diagnostics);

  std::size_t number() const { return number_; }  // of the line that came last, from 1
  const std::string& path() const { return path_; }
  std::string digest() const { return digest_.text(); }  // of the bytes so far
  bool has_failed() const { return has_failed_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool fill(Diagnostics& diagnostics);

  std::string path_;
  ReadProgress progress_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string buffer_;
  std::size_t at_ = 0, number_ = 0, total_ = 0, size_ = 0;
  bool is_at_end_ = false, has_failed_ = false;
  RunningDigest digest_;
};

}  // namespace dashpot::compiler::fitting
