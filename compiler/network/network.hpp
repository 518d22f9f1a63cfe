// A network in SI units with every name resolved: a graph whose edges are elements.
#pragma once

#include <dashpot/command.hpp>

#include <optional>
#include <string>
#include <vector>

#include "network/element.hpp"
#include "network/motion_map.hpp"
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
  std::string unit = {};         // of the value, where it has one
  std::string calculation = {};  // the expression that gave the value, as written; empty for a plain one
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

// A point of a curve.
struct CurvePoint {
  double displacement;  // [m] or [rad]
  double force;         // [N] or [N·m]
};

// The wanted force over displacement, behind which the whole network lies. Odd: for negative displacements it is the
// same with the other sign.
struct StaticCurve {
  enum class Kind { power, exponential, table };

  Kind kind = Kind::power;
  double shape = 1;                // p of c u^p, or a of c (e^{a u} − 1) [1/m]
  CurvePoint point{};              // through which it goes; of a table the last
  std::vector<CurvePoint> points;  // of a table, from [0, 0] on; beyond the last it keeps its slope
  bool is_instantaneous = false;   // else it is what is left at rest
  Span span;
};

// A springpot as it was read; its Maxwell elements are among those of the network.
struct Springpot {
  std::string name;
  double stiffness;  // of K τ^α D^α u [N/m] or [N·m/rad]
  double exponent;
  double time;           // τ [s]
  Range band;            // [Hz]
  double error;          // guaranteed over the band, relative
  std::size_t elements;  // Maxwell elements that stand for it
  Span span;
};

// A remark of the author's.
struct Comment {
  std::string about;  // a name, or a place in the file; empty: the whole
  std::string text;
};

struct Network {
  std::string name;
  std::string title;
  std::string source;
  motion port_motion = motion::translation;
  std::vector<Parameter> parameters;
  std::vector<std::string> nodes;  // nodes[ground] == "ground", nodes[tool] == "tool"
  std::vector<Element> elements;
  std::vector<Network> ports;  // that act side by side on the tool; elements, curve and contact are then theirs
  std::vector<Springpot> springpots;
  std::optional<Contact> contact;
  std::optional<StaticCurve> static_curve;
  std::optional<MotionMap> map;  // of the static curve, once the network's stiffness is known
  Validity valid;
  std::vector<Comment> comments;
  std::string digest;  // of the file's bytes
  Span name_span;

  // The parameter that an element's value is, or is a share of; nullptr where it never changes while the law runs.
  const Parameter* tunable_of(const Element& element) const {
    const Parameter* parameter = element.parameter ? &parameters[*element.parameter] : nullptr;
    return parameter != nullptr && parameter->tunable ? parameter : nullptr;
  }

  // Where the unloaded surface lies, and how far beyond it a position is; without a contact 0, and the position itself
  // [m] or [rad].
  double surface() const { return contact ? contact->at : 0; }
  double surface_behind_map() const { return map ? 0 : surface(); }  // as the law sees it
  double pushed_in(double position) const { return contact ? dashpot::pushed_in(contact->at, position) : position; }
};

// In: what the author wrote. Out: the network in SI. Ensures: values finite and non-negative, names legal C++ names and
// unique ignoring case, tool and ground connected, no part connected to neither. Elements through which no force can
// pass are kept, marked, and warned about; springpots and Prony series have become Maxwell elements in parallel.
// `device_band` [Hz] is the band of springpots that state none, in files that state no valid frequencies. Refuses:
// everything of architecture, section 3, all problems at once.
std::optional<Network> build_network(const NetworkDecl& decl, Diagnostics& diagnostics,
                                     const std::optional<Range>& device_band = std::nullopt);

// Whether a parameter may change while the law runs, and whether an element is a slip; those of ports apart.
bool has_tunables(const Network& network);
bool has_slips(const Network& network);

// The first of what has an effect beside constant springs and dampers, for people; nullptr where the network is linear.
const char* beyond_linear(const Network& network);

std::string to_text(const Network& network);
std::string to_text(const Springpot& springpot, motion port_motion);
std::string to_text(const StaticCurve& curve, motion port_motion);

// A line for every value that was calculated: what its author wrote, and what came out.
std::string calculations_text(const Network& network);

// The indices of those that can carry force, in the network's order.
std::vector<std::size_t> effective_elements(const Network& network);

// "N/m", "N m s/rad", …: the unit of an element's value in this motion.
std::string unit_of(const Law& law, motion port_motion);

}  // namespace dashpot::compiler
