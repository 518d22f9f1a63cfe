#include "report/markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace dashpot::compiler {

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '&': safe += "&amp;"; break;
      case '<': safe += "&lt;"; break;
      case '>': safe += "&gt;"; break;
      case '"': safe += "&quot;"; break;
      case '\'': safe += "&#39;"; break;
      default: safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  return safe;
}

std::string escaped_lines(std::string_view text) {
  std::string safe;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    safe += escaped(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return safe;
}

std::string json_literal(std::string_view text) {
  const auto quoted = nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  for (const char c : quoted) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return safe;
}

std::string json_literal(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

}  // namespace dashpot::compiler
