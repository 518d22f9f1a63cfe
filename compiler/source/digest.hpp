// A fingerprint of a file, so that emitted code can tell which input it came from, and a loop whether a law was
// compiled for the very file of its device. Cryptographic: nobody can write another file with the same one.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace dashpot::compiler {

// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits.
std::string digest_of(std::string_view bytes);

// The same of bytes that come piece by piece.
class RunningDigest {
 public:
  RunningDigest();
  void add(std::string_view bytes);
  std::string text() const;

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

}  // namespace dashpot::compiler
