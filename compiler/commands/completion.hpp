// What completes command lines of dashpot in a shell.
#pragma once

#include <string>
#include <vector>

#include "commands/command_words.hpp"

namespace dashpot::compiler {

inline const std::vector<std::string> shells = {"bash", "zsh", "fish"};

// A script for that shell: the commands, the options of each, their values where they are known, files and folders
// where those are expected.
std::string completion(const std::vector<CommandWords>& commands, const std::string& shell);

}  // namespace dashpot::compiler
