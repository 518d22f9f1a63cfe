// Code points of a UTF-8 text, one at a time.
#pragma once

#include <cstddef>
#include <string_view>

namespace dashpot::compiler {

// What some editors begin a text with; it is not part of it.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// The length in bytes of the well-formed code point that `text` starts with (RFC 3629: no overlong forms, no
// surrogates, nothing above U+10FFFF); 0 where it starts with none, an empty text included.
std::size_t code_point_length(std::string_view text);

// Whether it is made of well-formed code points alone.
bool is_utf8(std::string_view text);

// The first `count` code points of `text`; a stray byte counts as one.
std::string_view first_code_points(std::string_view text, std::size_t count);

}  // namespace dashpot::compiler
