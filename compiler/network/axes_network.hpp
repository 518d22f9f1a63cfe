// A network of two axes in SI: ports that add, each a map of the tip's position behind which a network of one axis
// lies, and a viscous field.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "axes/port_map.hpp"
#include "axes/viscous_field.hpp"
#include "network/network.hpp"
#include "source/diagnostic.hpp"
#include "syntax/axes_decl.hpp"

namespace dashpot::compiler {

struct Port {
  std::string name;
  std::string map_kind;  // "along", "ball", …
  axes::PortMap map;     // of the tip's position [m]
  Network network;       // translation, of the map's value
  Span span;             // of the map
};

struct AxesNetwork {
  std::string name;
  std::string title;
  std::string source;
  std::vector<Port> ports;
  axes::ViscousField field;  // force [N] over the tip's velocity [m/s]
  std::vector<Comment> comments;
  std::string digest;
  Span name_span;

  bool has_field() const { return !field.is_zero(); }
};

// In: what the author wrote. Out: the network in SI. Refuses: what build_network() refuses of a port; maps of no kind
// or of several, directions of no length; fields that give power; tunable parameters.
std::optional<AxesNetwork> build_axes_network(const AxesNetworkDecl& decl, Diagnostics& diagnostics,
                                              const std::optional<Range>& device_band = std::nullopt);

std::string to_text(const AxesNetwork& network);

// The field in a line: its numbers by rows, or of how many knots it is.
std::string to_text(const axes::ViscousField& field);

}  // namespace dashpot::compiler
