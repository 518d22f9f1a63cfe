// How much physical damping the sampled loop needs, over frequency, and how much is assured (theory, section 6).
#pragma once

#include <string>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// The need over frequency below what the certificate's loop is assured of; empty text where nothing is proved or the
// law is not linear.
std::string sampled_margin_html(const Compilation& compilation);

}  // namespace dashpot::compiler
