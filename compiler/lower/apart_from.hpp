// Keeps a law's names apart from words of the code around it.
#pragma once

#include <set>
#include <string>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// A name that is one of `words` gets a number. Parameters keep the names under which they are set.
UpdateLaw apart_from(const std::set<std::string>& words, UpdateLaw law);

}  // namespace dashpot::compiler
