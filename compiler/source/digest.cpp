#include "source/digest.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace dashpot::compiler {

std::string digest_of(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

}  // namespace dashpot::compiler
