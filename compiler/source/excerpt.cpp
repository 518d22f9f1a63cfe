#include "source/excerpt.hpp"

#include "source/utf8.hpp"

namespace dashpot::compiler {

std::string excerpt(std::string_view text) {
  const std::string_view start = first_code_points(text, 60);
  return std::string(start) + (start.size() < text.size() ? "…" : "");
}

}  // namespace dashpot::compiler
