// Any text as a motion: it is refused in words, or its columns are equally long and finite.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "commands/motion_csv.hpp"
#include "source/render.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dashpot::compiler;
  const SourceFile file("motion.csv", std::string(data, data + size));
  Diagnostics diagnostics;
  const auto motion = parse_motion(file, diagnostics);
  if (!motion && !diagnostics.has_errors()) std::abort();
  render_text(diagnostics);
  if (!motion || diagnostics.has_errors()) return 0;
  if (motion->position.size() != motion->time.size()) std::abort();
  if (!motion->velocity.empty() && motion->velocity.size() != motion->time.size()) std::abort();
  for (const auto* column : {&motion->time, &motion->position, &motion->velocity})
    for (double value : *column)
      if (!std::isfinite(value)) std::abort();
  return 0;
}
