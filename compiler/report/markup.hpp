// Pieces of HTML, SVG and MathML as text.
#pragma once

#include <string>
#include <string_view>

namespace dashpot::compiler {

// The author's words as text of a document, between tags or inside a quoted attribute. What XML does not allow at all,
// such as control characters, becomes a blank.
std::string escaped(std::string_view text);
std::string escaped_lines(std::string_view text);  // the same, line by line

// A string as a literal of JSON that may stand inside a script element.
std::string json_literal(std::string_view text);
std::string json_literal(double value);  // null where it is not finite

}  // namespace dashpot::compiler
