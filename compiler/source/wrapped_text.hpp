// Sentences broken into lines that can be read.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace dashpot::compiler {

// How wide UTF-8 text is shown, a place for each code point.
inline std::size_t columns(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// At spaces, no line wider than `width` but for a word that alone is; all lines but the first begin with `hanging`
// spaces.
inline std::vector<std::string> wrapped_text(std::string text, std::size_t width, std::size_t hanging) {
  std::vector<std::string> lines;
  while (columns(text) > width) {
    const std::size_t word = std::min(text.find_first_not_of(' '), text.size());
    std::size_t space = text.find(' ', word);
    for (std::size_t next = space; next != text.npos && columns(std::string_view(text).substr(0, next)) <= width;
         next = text.find(' ', next + 1))
      space = next;
    const std::size_t rest = text.find_first_not_of(' ', space);
    if (space == text.npos || rest == text.npos) break;
    lines.push_back(text.substr(0, space));
    text = std::string(hanging, ' ') + text.substr(rest);
  }
  lines.push_back(std::move(text));
  return lines;
}

}  // namespace dashpot::compiler
