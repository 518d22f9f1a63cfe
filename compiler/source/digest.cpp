#include "source/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <span>
#include <stdexcept>

namespace dashpot::compiler {
namespace {

// OpenSSL fails if memory is short, or if the machine's policy forbids SHA-256: then there is no digest to rely on.
void insist_on(int done) {
  if (done != 1) throw std::runtime_error("no SHA-256 from OpenSSL's libcrypto");
}

}  // namespace

void RunningDigest::Free::operator()(evp_md_ctx_st* context) const { EVP_MD_CTX_free(context); }

RunningDigest::RunningDigest() : context_(EVP_MD_CTX_new()) {
  insist_on(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
}

void RunningDigest::add(std::string_view bytes) {
  insist_on(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

std::string RunningDigest::text() const {
  RunningDigest ended;
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned count = 0;
  insist_on(EVP_MD_CTX_copy_ex(ended.context_.get(), context_.get()));
  insist_on(EVP_DigestFinal_ex(ended.context_.get(), bytes.data(), &count));
  std::string digits;
  for (const unsigned char byte : std::span(bytes).first(count)) digits += fmt::format("{:02x}", byte);
  return digits;
}

std::string digest_of(std::string_view bytes) {
  RunningDigest digest;
  digest.add(bytes);
  return digest.text();
}

}  // namespace dashpot::compiler
