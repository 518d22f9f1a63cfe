// What the kinds of element have in common, and how one kind is told from the others. All of it is written by match():
// code that asks nothing else of an element needs no change for a new kind.
#pragma once

#include <dashpot/command.hpp>

#include <string_view>

#include "network/dimension.hpp"
#include "network/element.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

Law make_law(ElementKind kind, double value);  // SI
Law with_value(const Law& law, double value);  // of the same kind; SI
double value_of(const Law& law);               // SI
Dimension dimension_of(const Law& law, motion port_motion);
std::string_view kind_of(const Law& law);  // "spring", "damper", "slip"

bool is_spring(const Law& law);
bool is_damper(const Law& law);
bool is_slip(const Law& law);  // gives way at a force; every other kind is linear

// Zero for elements of another kind.
double stiffness_of(const Law& law);    // of a spring [N/m] or [N·m/rad]
double damping_of(const Law& law);      // of a damper [N·s/m] or [N·m·s/rad]
double yield_force_of(const Law& law);  // of a slip [N] or [N·m]

}  // namespace dashpot::compiler
