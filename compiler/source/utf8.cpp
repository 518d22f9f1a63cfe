#include "source/utf8.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

struct LeadByte {
  unsigned char first, last;                // lead bytes [first, last]
  std::size_t length;                       // of the code point [bytes]
  unsigned char second_first, second_last;  // allowed second byte
};

// RFC 3629, section 4.
constexpr LeadByte lead_bytes[] = {
    {0x00, 0x7F, 1, 0x00, 0x00}, {0xC2, 0xDF, 2, 0x80, 0xBF}, {0xE0, 0xE0, 3, 0xA0, 0xBF},
    {0xE1, 0xEC, 3, 0x80, 0xBF}, {0xED, 0xED, 3, 0x80, 0x9F}, {0xEE, 0xEF, 3, 0x80, 0xBF},
    {0xF0, 0xF0, 4, 0x90, 0xBF}, {0xF1, 0xF3, 4, 0x80, 0xBF}, {0xF4, 0xF4, 4, 0x80, 0x8F},
};

unsigned char byte_at(std::string_view text, std::size_t index) { return static_cast<unsigned char>(text[index]); }

bool matches(const LeadByte& lead, std::string_view text) {
  if (byte_at(text, 0) < lead.first || byte_at(text, 0) > lead.last || text.size() < lead.length) return false;
  if (lead.length > 1 && (byte_at(text, 1) < lead.second_first || byte_at(text, 1) > lead.second_last)) return false;
  for (std::size_t i = 2; i < lead.length; ++i)
    if (byte_at(text, i) < 0x80 || byte_at(text, i) > 0xBF) return false;
  return true;
}

}  // namespace

std::size_t code_point_length(std::string_view text) {
  if (text.empty()) return 0;
  for (const LeadByte& lead : lead_bytes)
    if (matches(lead, text)) return lead.length;
  return 0;
}

bool is_utf8(std::string_view text) {
  while (const std::size_t length = code_point_length(text)) text.remove_prefix(length);
  return text.empty();
}

std::string_view first_code_points(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  for (std::size_t i = 0; i < count && end < text.size(); ++i)
    end += std::max<std::size_t>(1, code_point_length(text.substr(end)));
  return text.substr(0, end);
}

}  // namespace dashpot::compiler
