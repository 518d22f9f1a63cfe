// The update law as a small typed program: what evaluate() runs, what the back ends print, what a certificate proves.
//
// Two phases (theory, section 3): `output` turns the sample into a command in O(1) and, where everything is finite,
// `keep` remembers the sample; `update` follows, O(states), after the command has left. `energy` gives the stored
// energy. Variables are vectors of `size` scalars; statements act elementwise, and `sum` reduces in a stated order. So
// a law has the same few statements at any number of states.
#pragma once

#include <dashpot/slip_network.hpp>
#include <dashpot/slip_tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "decompose/choices.hpp"
#include "law/id.hpp"
#include "law/operation.hpp"
#include "law/subject.hpp"
#include "law/tunable_tables.hpp"

namespace dashpot {

inline bool operator==(const slip_link<double>& a, const slip_link<double>& b) {
  return std::tie(a.a, a.b, a.lowest, a.highest) == std::tie(b.a, b.b, b.lowest, b.highest);
}

}  // namespace dashpot

namespace dashpot::compiler {

struct Variable;
struct Coefficient;
struct Expression;
struct Coupling;
struct SlipNetwork;
using VariableId = Id<Variable>;
using CoefficientId = Id<Coefficient>;
using ExpressionId = Id<Expression>;
using CouplingId = Id<Coupling>;
using SlipNetworkId = Id<SlipNetwork>;

inline constexpr VariableId no_variable{};

enum class Role : std::uint8_t {
  input,  // given with the sample
  state,  // kept from one call to the next
  tuned,  // kept until set() changes it: a parameter, or what follows from some
  local,  // of one phase
};

// The number of partial sums, a power of two, in which a vector is added up that is written as a loop; 1 if its places
// are written one by one.
struct Lanes {
  std::size_t count = 1;

  bool are_there() const { return count > 1; }
  std::size_t padded(std::size_t size) const { return (size + count - 1) / count * count; }  // whole rounds of the loop
  bool operator==(const Lanes&) const = default;
};

struct Variable {
  std::string name;
  std::string unit;
  std::string meaning;
  Role role;
  std::size_t size = 1;
  std::vector<std::string> element_names = {};  // one name for each place of a vector; empty for a scalar
  double rest_value = 0;                        // of a state, after reset()
  Lanes lanes = {};

  bool is_rolled() const { return lanes.are_there(); }
  bool is_kept() const { return role == Role::state || role == Role::tuned; }
  bool operator==(const Variable&) const = default;
};

// What a constant is in the law's equations: what certificates, verification and reports ask for.
enum class ConstantRole : std::uint8_t {
  none,
  static_stiffness,       // k0 of the part that reaches ground without a slip
  half_static_stiffness,  // ½ k0
  step_stiffness,         // Σ c_i, the stiffness of all modes within a sample
  velocity_gain,          // b∞ − b, plus h Σ c_i of the modes that the estimate drives
  decay,                  // a of each mode of a bank
  loss,                   // 1 − a
  gain,                   // a c
  velocity_drive,         // a c h
  energy_weight,          // 1/(2 k a²)
  spring_stiffness,       // k0 of a block behind slips, or k of a spring between two nodes
  spring_compliance,      // 1/(2 k) of that spring
  row,                    // factor in a slip's closed form: of a change, a held force or an excess
  yield,                  // Y
  mode_weight,            // of a mode at an inner end
  feedthrough,            // b∞ behind a surface
  feedthrough_stiffness,  // −b∞/h behind a surface
  regime_feedthrough,     // x/h, where the brake makes x of b∞ in a regime
  recovery_compliance,    // −1/g of a surface
  surface_place,          // position of the unloaded surface
  steady_damping,         // b of the parts that no slip changes
  map,                    // the map of a static curve: where its cells lie, and its cubics
  motor_reach,            // limits of the motor, and shares of them
  element_value,          // k, B or Y of elements together, beside parameters that change
  least_stiffness,        // smallest g of a block behind slips, whatever the parameters are
  least_yield,            // smallest Y, whatever the parameters are
  relaxation_share,       // φ of a relaxation that no parameter touches
  relaxation_loss,        // α of that relaxation
  brake_reach,            // the most that the brake can give, if parameters change
  sample_period,          // h
  sample_rate,            // 1/h
  retention,              // share of an offset that is left after a sample
  brake_choice,           // how the brake is commanded: shares, samples, thresholds, what is chosen and not computed
  zero,                   // 0
  plain_number,           // the number that its name says: one, two, minus_one, half
};

// The bank of modes at the port; those behind slips count from 1.
inline constexpr std::size_t port_bank = 0;

// A constant of the emitted code, already rounded to the law's scalar type.
struct Coefficient {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<double> values;                   // one, one for each place, or those of a table that `pick` reads
  std::vector<std::string> element_names = {};  // one name for each place of a vector; else empty
  ConstantRole role = ConstantRole::none;
  std::size_t bank = port_bank;  // for a mode's constant
  std::vector<Subject> of = {};  // one for each value, or one for all; empty if it belongs to the whole law
  Lanes lanes = {};

  bool is_rolled() const { return lanes.are_there(); }
  bool is_table() const { return values.size() > 1 && element_names.empty(); }
  bool operator==(const Coefficient&) const = default;
};

struct Expression {
  Operation operation;
  std::array<ExpressionId, 3> operands = {};  // as many as the operation has, in the order of operations.def
  VariableId variable = {};                   // if the operation refers to one
  CoefficientId coefficient = {};             // if the operation refers to one
  bool operator==(const Expression&) const = default;
};

// How a statement gets its target.
struct Assign {  // its value is assigned
  bool operator==(const Assign&) const = default;
};
struct SolveTree {
  CouplingId coupling;  // coupled slips: the value is Δu, the target their force; δ and signs are assigned too
  bool operator==(const SolveTree&) const = default;
};
struct SolveNetwork {
  SlipNetworkId network;  // the same for slips outside a tree
  bool operator==(const SolveNetwork&) const = default;
};

struct Statement {
  VariableId target;
  ExpressionId value;
  std::string purpose;                            // the equation, as the literature writes it
  std::vector<std::vector<std::size_t>> origins;  // for each place of the target, indices into Network::elements
  std::variant<Assign, SolveTree, SolveNetwork> step = Assign{};

  bool assigns() const { return std::holds_alternative<Assign>(step); }
  bool operator==(const Statement&) const = default;
};

// A node's numbers that parameters change; no_variable if the node's own number holds.
struct TunedNode {
  VariableId stiffness = no_variable, compliance = no_variable, yield = no_variable;
  bool operator==(const TunedNode&) const = default;
};

// Slips that are solved together: what a step reads besides the change, and the locals that it assigns besides the
// force; no_variable if nothing reads them.
struct SolvedSlips {
  std::string name;                  // with which names of emitted tables begin
  std::vector<VariableId> held;      // forces if nothing moved [N]; no_variable where they are 0
  std::vector<VariableId> moved;     // how far each part moves or is stretched [m]
  std::vector<VariableId> sign;      // direction in which each slip slides, −1 or 1; 0: it holds
  VariableId surface = no_variable;  // Δs, if a tool pushes the part and cannot pull it [m]

  bool is_pushed() const { return surface != no_variable; }
  bool operator==(const SolvedSlips&) const = default;
};

// Slips that meet at inner nodes, with the blocks between them: one step is dashpot::slip_tree (theory, section 5).
// `held` is π of each block, `moved` its δ.
struct Coupling : SolvedSlips {
  std::vector<slip_node<double>> nodes;  // numbers already rounded to the law's scalar type
  std::vector<ElementList> slips;        // elements of each slip
  std::vector<TunedNode> tuned;          // one for each node; empty if no parameter changes them
  std::vector<ElementList> blocks;       // elements of each block; empty if parameters change the nodes

  int node_count() const { return static_cast<int>(nodes.size()); }
  int slip_count() const { return static_cast<int>(slips.size()); }
  int corners() const { return slip_tree_corners(nodes.data(), node_count()); }
  int operations() const {
    return is_pushed() ? slip_tree_push_operations(nodes.data(), node_count())
                       : slip_tree_operations(nodes.data(), node_count());
  }
  bool operator==(const Coupling&) const = default;
};

// Numbers of a slip network that parameters change; no_variable if the network's own number holds.
struct TunedNetwork {
  std::vector<VariableId> yields;  // of every link, in both directions
  std::vector<VariableId> between, to_tool, to_ground;
  VariableId through = no_variable;
  bool operator==(const TunedNetwork&) const = default;
};

// How the names of a slip network's emitted tables end.
inline constexpr const char* tables_of_slip_network[] = {"_links", "_between", "_to_tool", "_to_ground"};

// Slips that meet where a network is no tree: one step is dashpot::slip_network. Ends are numbered as there. `held` has
// an entry for every inner end and one for the tool, `moved` one for every inner end; a surface is the last inner end.
struct SlipNetwork : SolvedSlips {
  int node_count = 0;
  std::vector<slip_link<double>> links;  // numbers already rounded to the law's scalar type
  std::vector<double> between, to_tool, to_ground;
  double through = 0;
  std::vector<VariableId> last_sign;  // the states that remember the signs
  std::optional<TunedNetwork> tuned;
  ElementList elements;                // all of the part; empty if parameters change the numbers
  std::vector<std::size_t> end_nodes;  // node of each inner end; empty likewise

  int slip_count() const { return static_cast<int>(links.size()); }
  int patterns() const { return slip_network_patterns(links.data(), slip_count()); }
  int operations() const { return slip_network_operations(links.data(), slip_count(), node_count); }
  bool operator==(const SlipNetwork&) const = default;
};

// A guard against subnormal numbers for a rolled vector of forces that decay slowly: before each update the next
// `places` of them are tested, and those below the threshold become zero. Testing all at each sample would take three
// of the eight operations of a mode.
struct GuardInTurn {
  VariableId state;
  std::size_t places;  // tested in a sample; a multiple of the lanes that divides the padded size
  std::string name;    // that of the emitted counter
  bool operator==(const GuardInTurn&) const = default;
};

// How one mode is advanced; chosen by the error bound.
enum class ModeForm {
  product,      // G ← a G + …
  delta,        // G ← G + (… − α G)
  compensated,  // delta, with the rounding error of the sum carried along (Kahan)
};

std::string_view name_of(ModeForm form);  // "product", "delta", "compensated"

// For a law of several joints: replaces position, velocity, force and brake (theory, section 12). The ports' own laws
// are among its statements; `force` and `brake` of the law itself are not used.
struct JointPorts {
  std::vector<VariableId> positions, velocities;    // inputs, one for each joint [rad] or [m], [rad/s] or [m/s]
  std::vector<VariableId> torques;                  // locals of `output`, one for each joint [N·m] or [N]
  std::vector<VariableId> dampings, last_dampings;  // one for each brake: locals of `output`, states that remember them
  bool operator==(const JointPorts&) const = default;
};

// For a law of several ports: the value that reset() gives to a state that holds a port's position.
struct PortStart {
  VariableId state, value;  // `value`: a local of `start`, or the position; 0 if that is not finite
  bool operator==(const PortStart&) const = default;
};

// For a law of several ports: the port that a constant or table comes from, and its name in the port's own law.
struct NameInPort {
  std::string port, name;
  bool operator==(const NameInPort&) const = default;
};

struct UpdateLaw {
  ScalarType scalar = ScalarType::float64;
  Scheme scheme = Scheme::exact;
  StateInput state_input = StateInput::position;
  double sample_period = 0;    // [s]
  double damping = 0;          // b, the brake's command; if it changes, its least value [N·s/m]
  double largest_damping = 0;  // its largest value [N·s/m]
  double flush_threshold = 0;  // [N]: magnitudes below become zero
  ModeForm mode_form = ModeForm::product;
  double relative_error_bound = 0;  // of a mode's force, from rounding of coefficient and sums, at any time [1]

  Table<Variable> variables;
  Table<Coefficient> coefficients;
  Table<Expression> expressions;
  std::vector<Statement> output;  // locals only; ends with the assignment of `force`
  std::vector<Statement> keep;    // states that remember the sample; only where inputs and force are finite
  std::vector<Statement> update;
  Table<Coupling> couplings;
  Table<SlipNetwork> networks;
  std::vector<GuardInTurn> guards;  // before `update`
  std::vector<Statement> energy;    // ends with the assignment of `stored`
  std::vector<Statement> start;     // in reset(): locals that `started_at` or `starts` read
  std::vector<Statement> rest;      // in reset(), last: states whose rest value is no constant
  std::vector<Statement> tune;      // in set(), after the parameters: all tuned variables
  std::vector<Statement> carry;     // in set(), after `tune`: states that change with them

  std::optional<JointPorts> joints;  // for a law of several joints

  std::optional<TunableTables> tunable;  // for a network with tunables: the programs are written from it

  VariableId position;  // the inputs
  VariableId velocity;
  VariableId rest_position = no_variable;  // the state that reset(p) sets to p, if any; all others become zero
  VariableId started_at = no_variable;     // a local of `start` that reset() takes in place of the position
  std::optional<double> surface_at;        // for a contact: position of the unloaded surface [m]
  std::vector<PortStart> starts;           // for several ports, one for each that holds a position
  std::map<std::string, NameInPort> names_in_ports;  // for several ports, by the name in this law
  VariableId mapped = no_variable;                   // w of the position, a local of `output`, behind a static curve
  double steepest = 1;                               // w′ at most [1]
  double map_start = 0;                              // where w is 0 [m]
  VariableId force;                                  // m_k, the motor's command [N]
  VariableId wanted = no_variable;  // m_k before the motor's limits, if the law knows them (lower/shed.hpp) [N]
  VariableId share = no_variable;   // if it sheds, the state that holds the share of all forces that was kept [1]
  VariableId brake =
      no_variable;  // b_k if it changes with the regime, a local of `output`, finite where `force` is [N·s/m]
  VariableId last_brake = no_variable;  // the state that remembers it: the command after a non-finite sample
  VariableId stored;                    // [J]

  bool sheds() const { return share != no_variable; }
  // If this variable is not finite, the sample is refused.
  VariableId checked() const { return wanted != no_variable ? wanted : force; }
  bool brake_changes() const { return brake != no_variable; }
  std::vector<Tunable> parameters() const { return tunable ? tunable->tunables : std::vector<Tunable>(); }
  // The variable that reset() sets a state to: the position or a local of `start`; no_variable if it is its rest value.
  VariableId start_of(VariableId state) const {
    if (state == rest_position) return started_at != no_variable ? started_at : position;
    for (const PortStart& port : starts)
      if (port.state == state) return port.value;
    return no_variable;
  }
  // The position that the springs follow.
  VariableId moved() const { return mapped != no_variable ? mapped : position; }
  bool operator==(const UpdateLaw&) const = default;
};

}  // namespace dashpot::compiler
