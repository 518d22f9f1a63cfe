// What both layouts of the schematic stand in.
#pragma once

#include <string>

#include "report/symbols.hpp"

namespace dashpot::compiler {

// The inside of a drawing from the tool's rail at x = 0 to the ground's at x = length; y downwards from 0 to height.
struct Inside {
  std::string svg;
  double length;
  double height;
  double tool_height;                // where the tool's wire meets the inside
  double ground_top, ground_bottom;  // what the wall must cover
};

std::string framed(const Inside& inside, const Network& network);

}  // namespace dashpot::compiler
