// The texts of a functional mock-up unit for co-simulation (FMI 2.0 and 3.0, fmi-standard.org).
#pragma once

#include <optional>
#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

enum class FmiVersion { two = 2, three = 3 };

struct FmiUnit {
  std::string description;  // modelDescription.xml
  std::string source;       // all of it, one file of C99
  std::string documentation;
};

// Refuses: what emit_c99() refuses, but no name that C keeps; parameters with the name of another variable.
std::optional<FmiUnit> fmi_unit(const Compilation& compilation, FmiVersion version, const EmissionOptions& options,
                                Diagnostics& diagnostics);

}  // namespace dashpot::compiler
