// A network in SI units with every name resolved: a graph whose edges are elements.
#pragma once

#include <dashpot/command.hpp>

#include <optional>
#include <string>
#include <vector>

#include "network/element.hpp"
#include "source/diagnostic.hpp"
#include "syntax/network_decl.hpp"

namespace dashpot::compiler {

struct Parameter {
  std::string name;
  double value;  // SI
  bool tunable = false;
  double min = 0;
  double max = 0;
  Span span;
};

struct Range {
  double low;
  double high;
  bool contains(double value) const { return low <= value && value <= high; }
};

struct Validity {
  std::optional<Range> rate;          // |velocity| [m/s] or [rad/s]
  std::optional<Range> displacement;  // [m] or [rad]
  std::optional<Range> frequency;     // [Hz]
  Span span;
};

struct Contact {
  double at;  // where the unloaded surface lies [m] or [rad]
  Span span;
};

struct Network {
  std::string name;
  std::string title;
  std::string source;
  motion port_motion = motion::translation;
  std::vector<Parameter> parameters;
  std::vector<std::string> nodes;  // nodes[ground] == "ground", nodes[tool] == "tool"
  std::vector<Element> elements;
  std::optional<Contact> contact;
  Validity valid;
  std::string digest;  // of the file's bytes
  Span name_span;
};

// In: what the author wrote. Out: the network in SI. Ensures: values finite and non-negative, names legal C++ names and
// unique ignoring case, tool and ground connected, no part connected to neither. Elements through which no force can
// pass are kept, marked, and warned about. Refuses: everything of architecture, section 3, all problems at once.
std::optional<Network> build_network(const NetworkDecl& decl, Diagnostics& diagnostics);

std::string to_text(const Network& network);

// The indices of those that can carry force, in the network's order.
std::vector<std::size_t> effective_elements(const Network& network);

// "N/m", "N m s/rad", …: the unit of an element's value in this motion.
std::string unit_of(const Law& law, motion port_motion);

}  // namespace dashpot::compiler
