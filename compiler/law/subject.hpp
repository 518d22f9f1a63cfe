// Which part of the network a constant belongs to, so that verify/ can compute it again by code of its own. Elements
// are indices into Network::elements, nodes into Network::nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

namespace dashpot::compiler {

using ElementList = std::vector<std::size_t>;

// A linear block, or slips that act as one.
struct OfElements {
  ElementList elements;
  bool operator==(const OfElements&) const = default;
};

enum class RowOf : std::uint8_t {
  trial,        // the slip's force if it held
  force,        // the component's force while the slip gives way, less the part that the brake makes
  stuck_force,  // the same while the slip holds
  elongation,   // δ of a block
  spring,       // the force that the elongation adds to a block's spring
};

enum class RowFor : std::uint8_t {
  change,  // a displacement of the tool
  held,    // a force that a block holds
  excess,  // the part of the trial force that the slip does not hold
};

// One coefficient in the closed form of a component with one slip.
struct OfRow {
  ElementList slip;
  RowOf quantity;
  ElementList block;  // whose elongation or spring it is
  RowFor factor;
  ElementList held;            // the block that holds the force
  bool is_subtracted = false;  // written with the other sign, because the code subtracts it
  bool operator==(const OfRow&) const = default;
};

// The springs between two nodes of a part that is no tree.
struct OfTie {
  ElementList part;
  std::size_t first, second;
  bool operator==(const OfTie&) const = default;
};

// A mode of a part that is no tree: `mode` counts those of the same elements by ascending relaxation rate. For a
// weight, `node` is where the mode pulls.
struct OfPartMode {
  ElementList part;
  ElementList elements;
  std::size_t mode;
  std::size_t node = 0;
  bool operator==(const OfPartMode&) const = default;
};

// A regime of these slips: bit i says that slip i gives way. Without a regime, the value is the same in all.
struct OfRegime {
  std::vector<ElementList> slips;
  std::optional<std::size_t> regime;
  bool operator==(const OfRegime&) const = default;
};

// In a law with tunable parameters: a number of its tables, or the factor of a parameter in one of the number's terms.
struct OfNumber {
  std::size_t number;
  std::optional<std::size_t> term;
  bool operator==(const OfNumber&) const = default;
};

// In a law with tunable parameters: the index into the tables' springs, blocks or slips, as the role says.
struct OfTablePlace {
  std::size_t place;
  bool operator==(const OfTablePlace&) const = default;
};

using Subject = std::variant<OfElements, OfRow, OfTie, OfPartMode, OfRegime, OfNumber, OfTablePlace>;

}  // namespace dashpot::compiler
