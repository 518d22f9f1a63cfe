#include "verify/compare_headers.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "source/excerpt.hpp"
#include "verify/header_constants.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::string_view opening_of_code = "#pragma once";

// Where a header names the version of the dashpot that wrote it; nothing where there is none.
std::pair<std::size_t, std::size_t> version_in(std::string_view header) {
  constexpr std::string_view before = "\n// Written by dashpot ", behind = " from a network with digest";
  const std::size_t line = header.find(before), start = line == header.npos ? 0 : line + before.size();
  const std::size_t end = start == 0 ? 0 : header.find_first_not_of("0123456789.", start);
  const bool is_one = end != header.npos && end > start && header.substr(end).starts_with(behind);
  return is_one ? std::pair(start, end) : std::pair<std::size_t, std::size_t>(0, 0);
}

// The text with the version that `header` names: only the version may differ between two versions of dashpot.
std::string with_version_of(std::string_view header, std::string text) {
  const auto [start, end] = version_in(header);
  const auto [from, to] = version_in(text);
  return to == 0 || end == 0 ? text : text.replace(from, to - from, header.substr(start, end - start));
}

// With CR LF at the ends of its lines, where the header's first line ends so: git writes them so under Windows.
std::string with_line_ends_of(std::string_view header, std::string text) {
  const std::size_t first = header.find('\n');
  if (first == header.npos || first == 0 || header[first - 1] != '\r') return text;
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

// The text at that place, with some words of its line before it.
std::string excerpt_at(std::string_view text, std::size_t at) {
  if (at >= text.size()) return "the end of the file";
  constexpr std::size_t most_in_front = 30;
  const std::size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::size_t start = std::max(line, at - std::min(at, most_in_front));
  const std::size_t blank = start > line && text[start - 1] != ' ' ? text.find(' ', start) : text.npos;
  if (blank < at) start = blank + 1;
  while (start > line && (text[start] & 0xC0) == 0x80) --start;  // within a character
  return excerpt(text.substr(start, std::min(text.find('\n', at), text.size()) - start));
}

// What its class is called, of many points with '_batch' behind the network's name; empty where there is none.
std::string class_named_in(std::string_view header) {
  constexpr std::string_view before = "\nclass ";
  const std::size_t at = header.find(before);
  if (at == header.npos) return "";
  const std::size_t begin = at + before.size();
  return std::string(header.substr(begin, header.find(' ', begin) - begin));
}

// The name in `certified_for`; empty where there is none.
std::string device_named_in(std::string_view header) {
  constexpr std::string_view before = "const char* device = \"";
  const std::size_t at = header.find(before);
  if (at == header.npos) return "";
  const std::size_t begin = at + before.size();
  return std::string(header.substr(begin, header.find('"', begin) - begin));
}

}  // namespace

void compare_headers(const std::vector<std::string>& written, const SourceFile& header, Diagnostics& diagnostics) {
  const std::string_view found = header.text();
  std::size_t furthest = 0;
  bool in_banner = false;
  std::optional<std::string> expected_there;
  for (const std::string& text : written) {
    const std::string expected = with_line_ends_of(found, with_version_of(found, text));
    if (found == expected) return;
    const auto same =
        std::size_t(std::mismatch(found.begin(), found.end(), expected.begin(), expected.end()).first - found.begin());
    if (expected_there && same <= furthest) continue;
    expected_there = excerpt_at(expected, same);
    in_banner = same < expected.find(opening_of_code);
    furthest = same;
  }
  const Span place = {&header, furthest, std::min(header.text().find('\n', furthest), header.text().size())};
  if (in_banner) diagnostics.report<DiagnosticCode::banner_differs>(place, excerpt_at(found, furthest));
  else diagnostics.report<DiagnosticCode::code_differs>(place, excerpt_at(found, furthest));
  if (expected_there) diagnostics.note<DiagnosticCode::code_expected>({}, *expected_there);
}

void tell_of_another_compile(const SourceFile& header, const std::string& network, const std::string& device,
                             double sample_period, Diagnostics& diagnostics) {
  const std::string told_class = class_named_in(header.text());
  if (!told_class.empty() && told_class != network && told_class != network + "_batch")
    diagnostics.note<DiagnosticCode::of_another_network>({}, excerpt(told_class), network);
  const std::optional<HeaderConstants> constants = header_constants(header.text());
  if (!constants) return;
  const std::string told_device = device_named_in(header.text());
  for (const HeaderConstant& constant : constants->all) {
    if (constant.name != "sample_period") continue;
    const double told = constant.values.front();
    if (std::abs(told - sample_period) <= 1e-6 * sample_period && told_device == device) continue;
    diagnostics.note<DiagnosticCode::of_another_compile>({}, told_device, told, device, sample_period);
  }
}

}  // namespace dashpot::compiler
