// Pages for man, of the words that --help prints.
#pragma once

#include <string>
#include <vector>

#include "commands/command_words.hpp"

namespace dashpot::compiler {

// The page of dashpot itself, or of a command of that name; empty where there is none.
std::string manual_page(const std::vector<CommandWords>& commands, const std::string& name);

}  // namespace dashpot::compiler
