// What the kinds of element have in common.
#pragma once

#include <dashpot/command.hpp>

#include <string_view>

#include "network/dimension.hpp"
#include "network/element.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

Law make_law(ElementKind kind, double value);  // SI
double value_of(const Law& law);               // SI
Dimension dimension_of(const Law& law, motion port_motion);
std::string_view kind_of(const Law& law);  // "spring", "damper", "slip"

}  // namespace dashpot::compiler
