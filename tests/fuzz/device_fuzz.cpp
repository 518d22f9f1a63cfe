// Any text as a device file: it is refused in words, or it describes a device that a law can be compiled for.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "compile.hpp"
#include "network/device.hpp"
#include "source/render.hpp"
#include "syntax/parse_device.hpp"

namespace {

using namespace dashpot::compiler;

const SourceFile maxwell("maxwell.json", R"({"dashpot": 1, "name": "maxwell",
  "network": {"parallel": [{"spring": "5 N/m"}, {"series": [{"damper": "5 N s/m"}, {"spring": "50 N/m"}]}]}})");

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const SourceFile file("device.json", std::string(data, data + size));
  Diagnostics diagnostics;
  const auto decl = parse_device(file, diagnostics);
  const auto device = decl ? build_device(*decl, diagnostics) : std::nullopt;
  if (!device && !diagnostics.has_errors()) std::abort();
  render_text(diagnostics);
  if (!device || diagnostics.has_errors()) return 0;
  Diagnostics compiling;
  if (!compile(maxwell, {}, device, compiling) && !compiling.has_errors()) std::abort();
  render_json(compiling);
  return 0;
}
