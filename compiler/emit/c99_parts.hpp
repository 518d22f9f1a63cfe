// The parts of emitted C that are written once, in templates/c99/: slips that meet at inner nodes, parameters that
// change. They are C99 and C++17; a law takes those that it needs, with its own name before every name of theirs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

struct C99Words {
  std::string name;  // of the network; takes the place of `law` in law_type and before every law_…
  ScalarType scalar = ScalarType::float64;
  std::map<std::string, bool> has;          // what lines between #if and #endif are kept for
  std::map<std::string, std::string> text;  // words that are replaced whole
};

// The lines of templates/c99/<part>, in `words`.
std::vector<std::string> c99_part(const std::string& part, const C99Words& words);

// <dashpot/command.h>, as it stands.
std::vector<std::string> c99_command_header();

// <dashpot/device_description.h>, as it stands.
std::vector<std::string> c99_device_header();

}  // namespace dashpot::compiler
