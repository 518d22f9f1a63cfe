#include "emit/cpp_lines.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

constexpr std::size_t line_width = 112;

std::size_t indentation(const std::string& text) { return std::min(text.find_first_not_of(' '), text.size()); }

// The best blank to break a line at, not beyond `limit` and not inside []: after a plus; else after a comma, except the
// one between an array and its index; else after a product's sign; else between the two values of a choice; else after
// another sign. 0 if there is none.
std::size_t break_place(const std::string& text, std::size_t limit) {
  std::size_t plus = 0, comma = 0, product = 0, choice = 0, other = 0;
  int depth = 0;
  for (std::size_t i = 1; i <= limit && i < text.size(); ++i) {
    depth += (text[i] == '[') - (text[i] == ']');
    if (text[i] != ' ' || depth > 0) continue;
    if (text[i - 1] == '+') plus = i;
    if (text[i - 1] == '*') product = i;
    if (text[i - 1] == ':' || text[i - 1] == '?') choice = i;
    if (text[i - 1] == '=' || text[i - 1] == '-') other = i;
    if (text[i - 1] == ',' && text.compare(i, 3, " j)") != 0) comma = i;
  }
  return plus > limit / 4 ? plus : comma > 0 ? comma : product > 0 ? product : choice > 0 ? choice : other;
}

std::vector<std::string> wrapped(std::string text) {
  std::vector<std::string> lines;
  const std::string further(indentation(text) + 4, ' ');
  while (text.size() > line_width) {
    const std::size_t place = break_place(text, line_width);
    if (place <= further.size()) break;
    lines.push_back(text.substr(0, place));
    text = further + text.substr(place + 1);
  }
  lines.push_back(std::move(text));
  return lines;
}

}  // namespace

void append(std::vector<std::string>& lines, const std::string& text, const std::string& remark) {
  const bool fits = text.size() + remark.size() + 4 <= line_width;
  if (!remark.empty() && !fits) lines.push_back(std::string(indentation(text), ' ') + "// " + remark);
  for (std::string& line : wrapped(text)) lines.push_back(std::move(line));
  if (!remark.empty() && fits) lines.back() += "  // " + remark;
}

}  // namespace dashpot::compiler
