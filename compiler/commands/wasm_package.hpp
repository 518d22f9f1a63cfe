// A network's law for JavaScript.
#pragma once

#include <optional>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// NAME/: the module of the report's page as NAME.wasm, index.js and index.d.ts around it, and package.json. Refuses: a
// clang that is missing or makes no WebAssembly, a folder that cannot be made, templates that do not fit.
std::optional<std::vector<OutputFile>> emit_wasm(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics);

}  // namespace dashpot::compiler
