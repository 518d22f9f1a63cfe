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
#include <variant>
#include <vector>

#include "decompose/choices.hpp"
#include "law/id.hpp"
#include "law/operation.hpp"
#include "law/subject.hpp"
#include "law/tunable_tables.hpp"

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

// Of a vector: the partial sums that it is added up in, a power of two, where it is written as a loop; 1 where its
// places are written one by one.
struct Lanes {
  std::size_t count = 1;

  bool are_there() const { return count > 1; }
  std::size_t padded(std::size_t size) const { return (size + count - 1) / count * count; }  // whole rounds of the loop
};

struct Variable {
  std::string name;
  std::string unit;
  std::string meaning;
  Role role;
  std::size_t size = 1;
  std::vector<std::string> element_names = {};  // of a vector, one name a place; empty for a scalar
  double rest_value = 0;                        // of a state, after reset()
  Lanes lanes = {};

  bool is_rolled() const { return lanes.are_there(); }
  bool is_kept() const { return role == Role::state || role == Role::tuned; }
};

// What a constant is in the law's equations: what certificates, verification and reports ask for.
enum class ConstantRole : std::uint8_t {
  none,
  static_stiffness,       // k0 of what reaches ground without a slip
  half_static_stiffness,  // ½ k0
  step_stiffness,         // Σ c_i, the answer of all modes within a sample
  velocity_gain,          // b∞ − b, and what the estimate drives within a sample
  decay,                  // a of each mode of a bank
  loss,                   // 1 − a
  gain,                   // a c
  velocity_drive,         // a c h
  energy_weight,          // 1/(2 k a²)
  spring_stiffness,       // k0 of a block behind slips, or k of a spring between two nodes
  spring_compliance,      // 1/(2 k) of it
  row,                    // of a slip's closed form, for a change, a held force or an excess
  yield,                  // Y
  mode_weight,            // of a mode at an inner end
  feedthrough,            // b∞ behind a surface
  feedthrough_stiffness,  // −b∞/h behind a surface
  regime_feedthrough,     // x/h, what the brake takes over of b∞ in a regime
  recovery_compliance,    // −1/g of a surface
  surface_place,          // of the unloaded surface
  steady_damping,         // b of what no slip changes
  map,                    // of the map of a static curve: where its cells lie, and its cubics
  motor_reach,            // what the motor can make, and shares of it
  element_value,          // k, B or Y of elements together, beside parameters that change
  least_stiffness,        // g of a block behind slips, no less whatever the parameters are
  least_yield,            // Y, no less whatever the parameters are
  relaxation_share,       // φ of a relaxation that no parameter touches
  relaxation_loss,        // α of it
  brake_reach,            // what the brake can give where parameters change
  sample_period,          // T
  sample_rate,            // 1/T
  retention,              // what an offset keeps in a sample
  brake_choice,           // how the brake is commanded: shares, samples, thresholds, what is chosen and not computed
  zero,                   // nothing
  plain_number,           // as it is called: one, two, minus one, a half
};

// The bank of modes at the port; those behind slips count from 1.
inline constexpr std::size_t port_bank = 0;

// A constant of the emitted code, already rounded to the law's scalar type.
struct Coefficient {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<double> values;                   // one, or one a place, or those of a table that `pick` reads
  std::vector<std::string> element_names = {};  // of a vector, one name a place; else empty
  ConstantRole role = ConstantRole::none;
  std::size_t bank = port_bank;  // of a mode's constant
  std::vector<Subject> of = {};  // one a value, or one for all; none of what belongs to the whole law
  Lanes lanes = {};

  bool is_rolled() const { return lanes.are_there(); }
  bool is_table() const { return values.size() > 1 && element_names.empty(); }
};

struct Expression {
  Operation operation;
  std::array<ExpressionId, 3> operands = {};  // as many as the operation has, in the order of operations.def
  VariableId variable = {};                   // of an operation that refers to one
  CoefficientId coefficient = {};             // of an operation that refers to one
};

// How a statement gets its target.
struct Assign {};  // the value
struct SolveTree {
  CouplingId coupling;  // coupled slips: the value is Δu, the target their force; δ and signs are assigned too
};
struct SolveNetwork {
  SlipNetworkId network;  // the same of slips outside a tree
};

struct Statement {
  VariableId target;
  ExpressionId value;
  std::string purpose;                            // the equation, as the literature writes it
  std::vector<std::vector<std::size_t>> origins;  // for each place of the target, indices into Network::elements
  std::variant<Assign, SolveTree, SolveNetwork> step = Assign{};

  bool assigns() const { return std::holds_alternative<Assign>(step); }
};

// The numbers of a node where parameters change them; no_variable where the node's own number holds.
struct TunedNode {
  VariableId stiffness = no_variable, compliance = no_variable, yield = no_variable;
};

// Slips that are solved together: what a step reads beside the change, and the locals that it assigns beside the force,
// no_variable where nothing follows them.
struct SolvedSlips {
  std::string name;                  // of the emitted tables
  std::vector<VariableId> held;      // forces if nothing moved [N]; no_variable where they are 0
  std::vector<VariableId> moved;     // how far parts go [m]
  std::vector<VariableId> sign;      // to which side each slip gives way: −1, 0 or 1
  VariableId surface = no_variable;  // Δs, where a tool pushes what is there and cannot pull it [m]

  bool is_pushed() const { return surface != no_variable; }
};

// Slips that meet at inner nodes, with the blocks between them: one step is dashpot::slip_tree (theory, section 5).
// `held` is π of each block, `moved` its δ.
struct Coupling : SolvedSlips {
  std::vector<slip_node<double>> nodes;  // numbers already rounded to the law's scalar type
  std::vector<ElementList> slips;        // of each slip
  std::vector<TunedNode> tuned;          // one a node; none where no parameter changes them
  std::vector<ElementList> blocks;       // of each block; none where parameters change the nodes

  int node_count() const { return static_cast<int>(nodes.size()); }
  int slip_count() const { return static_cast<int>(slips.size()); }
  int corners() const { return slip_tree_corners(nodes.data(), node_count()); }
  int operations() const {
    return is_pushed() ? slip_tree_push_operations(nodes.data(), node_count())
                       : slip_tree_operations(nodes.data(), node_count());
  }
};

// The numbers of a slip network where parameters change them; no_variable where its own number holds.
struct TunedNetwork {
  std::vector<VariableId> yields;  // of every link, to either side
  std::vector<VariableId> between, to_tool, to_ground;
  VariableId through = no_variable;
};

// How the names of its emitted tables end.
inline constexpr const char* tables_of_slip_network[] = {"_links", "_between", "_to_tool", "_to_ground"};

// Slips that meet where a network is no tree: one step is dashpot::slip_network. Ends are numbered as there. `held` is
// of every inner end, then of the tool, `moved` of every inner end, of which a surface is the last.
struct SlipNetwork : SolvedSlips {
  int node_count = 0;
  std::vector<slip_link<double>> links;  // numbers already rounded to the law's scalar type
  std::vector<double> between, to_tool, to_ground;
  double through = 0;
  std::vector<VariableId> last_sign;  // the states that remember the signs
  std::optional<TunedNetwork> tuned;
  ElementList elements;                // all of them; none where parameters change the numbers
  std::vector<std::size_t> end_nodes;  // of the network, one an inner end; the same

  int slip_count() const { return static_cast<int>(links.size()); }
  int patterns() const { return slip_network_patterns(links.data(), slip_count()); }
  int operations() const { return slip_network_operations(links.data(), slip_count(), node_count); }
};

// The guard of a rolled vector of forces that decay slowly: before an update, `places` of them in turn become zero
// below the threshold. All at each sample would take three of the eight operations of a mode.
struct GuardInTurn {
  VariableId state;
  std::size_t places;  // a sample; several lanes, and a part of the padded size
  std::string name;    // of the emitted counter
};

// How one mode is advanced; chosen by the error bound.
enum class ModeForm {
  product,      // G ← a G + …
  delta,        // G ← G + (… − α G)
  compensated,  // delta, with the rounding error of the sum carried along (Kahan)
};

std::string_view name_of(ModeForm form);  // "product", "delta", "compensated"

// Of a law of several joints: what stands in the place of position, velocity, force and brake (theory, section 12).
// What the law does of each port is in its statements; `force` and `brake` of the law itself are not used.
struct JointPorts {
  std::vector<VariableId> positions, velocities;    // inputs, one a joint [rad] or [m], [rad/s] or [m/s]
  std::vector<VariableId> torques;                  // locals of `output`, one a joint [N·m] or [N]
  std::vector<VariableId> dampings, last_dampings;  // locals of `output`, and states that remember them, one a brake
};

// Of a law of several ports: what reset() sets a state to that holds where the port is.
struct PortStart {
  VariableId state, value;  // a local of `start`, or the position; 0 where that is not finite
};

// Of a law of several ports: the port that a constant or table comes from, and what the port's own law calls it.
struct NameInPort {
  std::string port, name;
};

struct UpdateLaw {
  ScalarType scalar = ScalarType::float64;
  Scheme scheme = Scheme::exact;
  StateInput state_input = StateInput::position;
  double sample_period = 0;    // [s]
  double damping = 0;          // b, the brake's command; where it changes its least value [N·s/m]
  double largest_damping = 0;  // its largest; the same where it does not change [N·s/m]
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
  std::vector<Statement> start;     // of reset(): locals of the position, where `started_at` or `starts` need them
  std::vector<Statement> rest;      // of reset(): states that do not rest at a constant, after all others
  std::vector<Statement> tune;      // of set(), with the parameters' new values: all that is tuned
  std::vector<Statement> carry;     // of set(), after that: states that follow

  std::optional<JointPorts> joints;  // of a law of several joints

  std::optional<TunableTables> tunable;  // of a network with tunables: what the programs are written from

  VariableId position;  // the inputs
  VariableId velocity;
  VariableId rest_position = no_variable;  // the state that reset(p) sets to p, if any; all others become zero
  VariableId started_at = no_variable;  // the local of `start` that reset() sets rest_position to, if not the position
  std::optional<double> surface_at;     // of a contact: where the unloaded surface lies [m]
  std::vector<PortStart> starts;        // of several ports, one for each that holds a position
  std::map<std::string, NameInPort> names_in_ports;  // of several ports, by the name in this law
  VariableId mapped = no_variable;                   // w of the position, a local of `output`, behind a static curve
  double steepest = 1;                               // w′ at most [1]
  double map_start = 0;                              // where w is 0 [m]
  VariableId force;                                  // m_k, the motor's command [N]
  VariableId wanted = no_variable;  // m_k before the motor's limits, where the law knows them (lower/shed.hpp) [N]
  VariableId share = no_variable;   // where it sheds, the state that remembers which share of all forces it kept [1]
  VariableId brake =
      no_variable;  // b_k where it changes with the regime, a local of `output`, finite where `force` is [N·s/m]
  VariableId last_brake = no_variable;  // the state that remembers it: what a non-finite sample is answered with
  VariableId stored;                    // [J]

  bool sheds() const { return share != no_variable; }
  VariableId checked() const {
    return wanted != no_variable ? wanted : force;
  }  // not finite where the sample is to be refused
  bool brake_changes() const { return brake != no_variable; }
  std::vector<Tunable> parameters() const { return tunable ? tunable->tunables : std::vector<Tunable>(); }
  // What reset() sets a state to: the position or a local of `start`; no_variable where that is its rest value.
  VariableId start_of(VariableId state) const {
    if (state == rest_position) return started_at != no_variable ? started_at : position;
    for (const PortStart& port : starts)
      if (port.state == state) return port.value;
    return no_variable;
  }
  VariableId moved() const { return mapped != no_variable ? mapped : position; }  // what the springs see of the tool
};

}  // namespace dashpot::compiler
