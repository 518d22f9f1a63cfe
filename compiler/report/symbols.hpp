// Symbols of the schematic: springs zigzag, dashpots are a piston in a cup, slips a block that rubs on a plate.
#pragma once

#include <string>

#include "network/network.hpp"

namespace dashpot::compiler {

struct Place {
  double x, y;  // [px], y downwards
};

inline constexpr double symbol_length = 76;  // from end to end, leads included [px]
inline constexpr double label_rise = 40;     // from the axis to the top of the name above it [px]
inline constexpr double symbol_drop = 19;    // from the axis to the lowest stroke [px]

// Room that the element with its name and value takes along the axis [px].
double element_length(const Element& element, motion port_motion);

// The element with its name and value above it; `start` is its end nearer the tool.
std::string element_symbol(const Element& element, motion port_motion, Place start, double length);

std::string wire(Place from, Place to);  // one straight line
std::string junction(Place at);          // a dot where wires meet
std::string tool_symbol(Place at);       // a handle, with the directions of u and f; its wire starts at `at`
std::string ground_symbol(double x, double top, double bottom);  // a hatched wall
std::string contact_symbol(Place at);                            // a gap between two plates, `contact_length` long

inline constexpr double tool_length = 78;     // [px]
inline constexpr double contact_length = 26;  // [px]

}  // namespace dashpot::compiler
