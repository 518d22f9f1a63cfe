// The candidate decompositions: a table, and the numbers of the interactive plot.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

std::string candidates_table_html(const Compilation& compilation);

// {"figures": [{"label", "unit"}], "candidates": [{"name", "chosen", "values": […]}]}: figures of merit of which less
// is better, only those that were computed for some candidate.
std::string candidates_json(const Compilation& compilation);

}  // namespace dashpot::compiler
