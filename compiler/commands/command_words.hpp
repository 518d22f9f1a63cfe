// The command line as plain words: what --help, the manual pages and the completion of shells are made of.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dashpot::compiler {

struct OptionWords {
  enum class Takes { nothing, choice, file, folder, other };

  std::string short_name;  // "-o"; may be empty
  std::string long_name;   // "--output"; of a positional its name, "NETWORK"
  std::string value;       // as help writes it; empty where it takes nothing
  std::string what;
  Takes takes = Takes::nothing;
  std::vector<std::string> choices;
  bool many = false;  // any number of values
  bool required = false;
};

struct CommandWords {
  std::string name;  // empty: dashpot itself
  std::string what;
  std::string footer;
  std::vector<OptionWords> positionals, options;
};

// dashpot itself, then its commands in the order of --help; nothing that help keeps to itself.
std::vector<CommandWords> command_words(const CLI::App& app);

}  // namespace dashpot::compiler
