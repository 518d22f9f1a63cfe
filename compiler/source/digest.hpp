// A short fingerprint of a file, so that emitted code can tell which input it came from. Not cryptographic.
#pragma once

#include <string>
#include <string_view>

namespace dashpot::compiler {

// 64-bit FNV-1a (Fowler, Noll & Vo; draft-eastlake-fnv) of the bytes, as 16 lower-case hexadecimal digits.
std::string digest_of(std::string_view bytes);

}  // namespace dashpot::compiler
