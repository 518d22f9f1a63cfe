#include "report/schematic.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/markup.hpp"
#include "report/schematic_frame.hpp"
#include "report/rail_layout.hpp"
#include "report/tree_layout.hpp"

namespace dashpot::compiler {

std::string framed(const Inside& inside, const Network& network) {
  constexpr double margin = 12;
  const double gap = network.contact ? contact_length : 0;
  const double first = margin + tool_length + gap;
  // The handle and the wall have a size of their own.
  const double above = std::max(0.0, 42 - inside.tool_height),
               below = std::max(0.0, inside.tool_height + 34 - inside.height);
  const double width = first + inside.length + 26 + margin, height = inside.height + above + below + 2 * margin;
  const double top = margin + above;
  std::string svg = fmt::format(
      "<svg class=\"schematic\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "role=\"img\" "
      "aria-label=\"Drawing of {2}\">\n",
      width, height, escaped(network.name));
  svg += tool_symbol({margin + tool_length, top + inside.tool_height});
  if (network.contact) svg += contact_symbol({margin + tool_length, top + inside.tool_height});
  svg += fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", first, top) + inside.svg;
  return svg + ground_symbol(inside.length + 12, inside.ground_top, inside.ground_bottom) + "</g>\n</svg>\n";
}

std::string schematic(const Network& network) {
  if (const std::optional<Tree> tree = series_parallel_tree(network))
    return framed(tree_layout(*tree, network), network);
  return framed(rail_layout(network), network);
}

}  // namespace dashpot::compiler
