#include "commands/targets.hpp"

#include <fmt/format.h>

#include "commands/fmu.hpp"
#include "commands/python_package.hpp"
#include "commands/wasm_package.hpp"
#include "source/nearest_name.hpp"

namespace dashpot::compiler {
namespace {

const std::vector<Target>& table() {
  static const std::vector<Target> all = {
      {"cpp",
       "a class in C++17",
       "NAME.hpp",
       {"network.hpp.in", "network_test.cpp.in"},
       {"--constant-time", "--batch", "--with-test", "--certificate"},
       emit_cpp,
       false,
       emit_axes_cpp,
       {"axes.hpp.in", "axes_test.cpp.in"},
       true},
      {"c99",
       "a struct and its functions in C99",
       "NAME.h",
       {"network.h.in", "network_test.c.in"},
       {"--with-test"},
       emit_c99,
       false,
       emit_axes_c99,
       {"axes.h.in"}},
      {"hal", "a component of LinuxCNC, for halcompile", "NAME.comp", {"hal.comp.in", "network.h.in"}, {}, emit_hal},
      {"fmi2",
       "a unit for co-simulation, FMI 2.0",
       "NAME.fmu",
       {"fmi_core.c.in", "fmi2.c.in", "fmi2.xml.in", "network.h.in"},
       {},
       emit_fmi2},
      {"fmi3",
       "a unit for co-simulation, FMI 3.0",
       "NAME.fmu",
       {"fmi_core.c.in", "fmi3.c.in", "fmi3.xml.in", "network.h.in"},
       {},
       emit_fmi3},
      {"python",
       "a package for Python, built by cc",
       "NAME/",
       {"network.h.in", "python_law.c.in", "python_package.py.in"},
       {},
       emit_python,
       true},
      {"wasm",
       "a module for JavaScript, built by clang++",
       "NAME/",
       {"network.hpp.in", "live.cpp.in", "wasm_package.js.in", "wasm_package.d.ts.in"},
       {},
       emit_wasm},
  };
  return all;
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Target& target : table()) all.emplace_back(target.name);
  return all;
}

}  // namespace

std::span<const Target> targets() { return table(); }

const Target* find_target(std::string_view name) {
  for (const Target& target : table())
    if (target.name == name) return &target;
  return nullptr;
}

std::string check_target(const std::string& name) {
  if (find_target(name) != nullptr) return "";
  const std::vector<std::string> known = names();
  const std::optional<std::string> nearest = nearest_name(name, known);
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
  return fmt::format("there is no target '{}'; {}targets are {}", name,
                     nearest ? "'" + *nearest + "' is the nearest; " : "", list);
}

std::string help_on_targets() {
  std::string text = "Targets:";
  for (const Target& target : table())
    text += fmt::format("\n  {:<8} {:<16} {}", target.name, target.files, target.what);
  return text;
}

}  // namespace dashpot::compiler
