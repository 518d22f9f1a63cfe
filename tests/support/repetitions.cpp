#include "support/repetitions.hpp"

#include <cstdlib>
#include <string_view>

namespace dashpot::testing {

bool is_thorough() {
  const char* wanted = std::getenv("DASHPOT_LONG");
  return wanted != nullptr && std::string_view(wanted) == "1";
}

std::size_t repetitions(std::size_t usual, std::size_t thorough) { return is_thorough() ? thorough : usual; }

}  // namespace dashpot::testing
