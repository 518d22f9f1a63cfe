// The elements of theory, section 1. p opposes the elongation d = x_a − x_b.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "source/source_file.hpp"

namespace dashpot::compiler {

struct Spring {
  double stiffness;  // [N/m] or [N·m/rad]
};

struct Damper {
  double damping;  // [N·s/m] or [N·m·s/rad]
};

struct Slip {
  double yield_force;  // [N] or [N·m]
};

using Law = std::variant<Spring, Damper, Slip>;

using NodeIndex = std::size_t;
inline constexpr NodeIndex ground = 0;
inline constexpr NodeIndex tool = 1;

struct Element {
  std::string name;
  Law law;
  NodeIndex a;  // the end nearer the tool in a tree
  NodeIndex b;
  Span span;                             // of the leaf in the file
  std::optional<std::size_t> parameter;  // index into Network::parameters where the value follows one
  std::string calculation = {};          // the expression that gave the value, as written; empty for a plain one
  bool has_effect = true;                // false: no force can pass through it, whatever the motion
  double share = 1;                      // the value is so many times the parameter's; not 1 in a springpot's ladder
};

}  // namespace dashpot::compiler
