// A short fingerprint of a file, so that emitted code can tell which input it came from. Not cryptographic.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dashpot::compiler {

// 64-bit FNV-1a (Fowler, Noll & Vo; draft-eastlake-fnv) of the bytes, as 16 lower-case hexadecimal digits.
std::string digest_of(std::string_view bytes);

// The same of bytes that come piece by piece.
class RunningDigest {
 public:
  void add(std::string_view bytes);
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace dashpot::compiler
