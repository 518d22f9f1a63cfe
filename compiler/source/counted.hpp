// Counts in words that people read.
#pragma once

#include <cstddef>
#include <string>

namespace dashpot::compiler {

// "1 addition", "2 additions", "0 additions".
inline std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace dashpot::compiler
