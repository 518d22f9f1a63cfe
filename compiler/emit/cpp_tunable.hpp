// What a law with tunable parameters has in C++ beyond its programs.
#pragma once

#include <string>
#include <vector>

#include "emit/cpp_statements.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

// The struct `parameters`, and set() with its contract and the lines of its program; of a law without tunables too.
std::vector<std::string> parameters_of(const UpdateLaw& law);
std::vector<std::string> set_of(const UpdateLaw& law, const std::vector<std::string>& program);

// The beginning of set(): the parameters become `wanted`, and `clamped` tells which of them could not.
std::vector<std::string> taken_values(const UpdateLaw& law);

// The ranges of the parameters; nothing of a law without tunables.
void append_ranges(const UpdateLaw& law, std::vector<std::string>& lines);

}  // namespace dashpot::compiler
