// The candidate decompositions: a table, and the numbers of the interactive plot.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

std::string candidates_table_html(const Compilation& compilation);

// {"figures": [{"label", "unit"}], "candidates": [{"name", "chosen", "values": […]}]}: figures of merit of which less
// is better, only those that were computed for some candidate.
std::string candidates_json(const Compilation& compilation);

// The error of what is felt over frequency, of all candidates; those that err alike share a curve. A figure for where
// no script runs, and the numbers of the page's chart. Empty text without a device.
std::string felt_error_html(const Compilation& compilation);
std::string felt_error_json(const Compilation& compilation);

}  // namespace dashpot::compiler
