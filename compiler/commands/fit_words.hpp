// What the command line of `dashpot fit` asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dashpot::compiler {

struct FitWords {
  std::vector<std::string> recordings;
  std::vector<std::string> hold_out;
  std::vector<std::string> arguments;  // as they were typed, behind "dashpot"
  std::optional<std::string> columns, geometry, scale, tolerance, contact, force_delay, shape, report, name, title,
      source;
  std::string weight = "auto";       // auto | uniform | relative | deviation
  std::string start = "auto";        // auto | rest | zero | moving
  std::string slips = "none";        // none | auto | viscous | a number
  std::string springpots = "none";   // none | auto
  std::string control = "position";  // position | force
  std::optional<std::size_t> modes;
  bool relaxation = false, creep = false;
  bool tare = false, gain_per_file = false, no_header = false, elastic = false, json = false;
};

}  // namespace dashpot::compiler
