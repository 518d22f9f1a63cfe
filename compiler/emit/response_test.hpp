// What a test of an emitted law against the closed forms of its network is filled with, in any language.
#pragma once

#include <string>

#include "emit/code_model.hpp"
#include "emit/emission.hpp"

namespace dashpot::compiler {

// Why no motion is played to the law: its force would have no closed form. Empty where it has one.
std::string why_no_motion_is_played(const Compilation& c);

// `log1p`: the language's name of ln(1 + x).
CodeModel response_test_model(const Compilation& c, const std::string& log1p);

}  // namespace dashpot::compiler
