// A law as text for people: its constants, and its programs with their equations.
#pragma once

#include <string>

#include "law/update_law.hpp"
#include "network/network.hpp"

namespace dashpot::compiler {

std::string to_text(const UpdateLaw& law, const Network& network);

}  // namespace dashpot::compiler
