#include "source/digest.hpp"

#include <fmt/format.h>

namespace dashpot::compiler {

void RunningDigest::add(std::string_view bytes) {
  for (const char byte : bytes) hash_ = (hash_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
}

std::string RunningDigest::text() const { return fmt::format("{:016x}", hash_); }

std::string digest_of(std::string_view bytes) {
  RunningDigest digest;
  digest.add(bytes);
  return digest.text();
}

}  // namespace dashpot::compiler
