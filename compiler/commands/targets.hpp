// What `dashpot compile --target` can write: the one table that the command line, its help and its errors read. A new
// target is a row in targets.cpp, and the function of that row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

struct Target {
  std::string_view name;   // on the command line
  std::string_view what;   // in a line of help
  std::string_view files;  // that are written; NAME stands for the network's
  std::vector<std::string_view> templates;
  std::vector<std::string_view> options;  // beyond those that every target takes
  std::optional<std::vector<OutputFile>> (*emit)(const Compilation&, const EmissionOptions&, Diagnostics&);
  bool explains = false;  // takes EmissionOptions::explanation
  // Of two axes; nullptr where the target knows none.
  std::optional<std::vector<OutputFile>> (*emit_axes)(const AxesCompilation&, const EmissionOptions&,
                                                      Diagnostics&) = nullptr;
  std::vector<std::string_view> axes_templates = {};
  bool tests_axes = false;  // takes --with-test there
};

std::span<const Target> targets();  // the default first

// nullptr where no target is called that.
const Target* find_target(std::string_view name);

// Empty for a target, else what is wrong and what is expected.
std::string check_target(const std::string& name);

// A line each: name, files, what they are.
std::string help_on_targets();

}  // namespace dashpot::compiler
