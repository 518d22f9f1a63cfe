// Closed form against emitted code: a ramp, then a hold.
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// Of a linear network. The motion is cut short where it would take more samples than a page can wait for.
std::string agreement_html(const Compilation& compilation);

}  // namespace dashpot::compiler
