// Leaves that stand for several elements in parallel: a springpot, a Prony series.
#pragma once

#include <optional>
#include <vector>

#include "network/network.hpp"
#include "network/parameter_table.hpp"
#include "network/springpot.hpp"

namespace dashpot::compiler {

struct Ladder {
  std::optional<double> stiffness;                      // of a spring beside the branches [N/m] or [N·m/rad]
  std::vector<MaxwellBranch> branches;                  // none with a stiffness of 0
  std::optional<Springpot> springpot;                   // without its name
  std::optional<std::size_t> parameter = std::nullopt;  // tunable: the branches are then for a stiffness of 1
};

// Values for springpots that do not state them.
struct LadderDefaults {
  std::optional<Range> valid_frequency;  // of the network's file [Hz]
  std::optional<Range> device_band;      // [Hz]
};

// In: a leaf that is a springpot or a Prony series. Refuses, with the place: values out of range, a tunable but for a
// springpot's stiffness, a band that nothing states; a Prony series that creates energy, with the nearest one that does
// not.
std::optional<Ladder> read_ladder(const LeafDecl& leaf, ParameterTable& table, motion port_motion,
                                  const LadderDefaults& defaults, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
