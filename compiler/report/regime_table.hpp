// What the brake takes over in each regime of a network with slips.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// For each part behind slips its names, the laws that it may have and the one taken, and a row for each pattern of
// sliding and stuck slips; parts that are decided alike share the words. Then what the laws do in runs of the whole.
std::string regimes_html(const Compilation& compilation);

}  // namespace dashpot::compiler
