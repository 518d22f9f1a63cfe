// Any text as a certificate, any as a header: `verify` refuses them in words, or says how many constants are right.
//
// The two stand in one input, the certificate first, with a form feed between them; `verify` of a certificate without
// one sees an empty header.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "commands/verify_texts.hpp"
#include "source/render.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dashpot::compiler;
  const std::string both(data, data + size);
  const std::size_t middle = std::min(both.find('\f'), size), after = std::min(middle + 1, size);
  const SourceFile certificate("certificate.json", both.substr(0, middle)), header("header.hpp", both.substr(after));
  SourceFiles files;
  Diagnostics diagnostics;
  const auto verified = verify_texts(certificate, header, true, files, diagnostics);
  if (verified.has_value() == diagnostics.has_errors()) std::abort();
  render_text(diagnostics);
  render_json(diagnostics);
  return 0;
}
