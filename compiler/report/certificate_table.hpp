// What is proved about the sampled loop, in words and numbers (theory, section 6).
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// The certificate of whatever network, or why there is none.
std::string certificate_html(const Compilation& compilation);

}  // namespace dashpot::compiler
