// A functional mock-up unit: texts of emit/fmi_unit.hpp and a shared library made of them, in one archive.
#pragma once

#include <optional>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// <name>.fmu, its library made by the C compiler that CC names, else cc. Refuses: what fmi_unit() refuses, and where no
// compiler can be started or it refuses the source.
std::optional<std::vector<OutputFile>> emit_fmi2(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics);
std::optional<std::vector<OutputFile>> emit_fmi3(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics);

}  // namespace dashpot::compiler
