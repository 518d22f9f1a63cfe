#include "law/check_law.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

#include "law/walk.hpp"
#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

// Whether the constant's equation needs to know which part of the network it belongs to.
bool is_of_a_part(const Coefficient& c) {
  if (c.bank != port_bank) return true;
  switch (c.role) {
    case ConstantRole::spring_stiffness:
    case ConstantRole::spring_compliance:
    case ConstantRole::row:
    case ConstantRole::yield:
    case ConstantRole::mode_weight:
    case ConstantRole::regime_feedthrough:
    case ConstantRole::element_value:
    case ConstantRole::least_stiffness:
    case ConstantRole::least_yield:
    case ConstantRole::relaxation_share:
    case ConstantRole::relaxation_loss: return true;
    default: return false;
  }
}

class Check {
 public:
  Check(const UpdateLaw& law, std::string_view pass) : law_(law), pass_(pass) {}

  void run() {
    check_tables();
    std::set<VariableId> locals;
    phase("output", law_.output, locals, {.inputs = true, .states = false, .locals = true});
    require(locals.count(law_.force) != 0, "the force is never assigned");
    if (law_.joints) check_joints(locals);
    require(!law_.brake_changes() || locals.count(law_.brake) != 0, "the brake is never assigned");
    phase("keep", law_.keep, locals, {.inputs = true, .states = true, .locals = false});
    locals.clear();
    phase("start", law_.start, locals, {.inputs = true, .states = false, .locals = true});
    for (const PortStart& start : law_.starts)
      require(start.value == law_.position || locals.count(start.value) != 0, "the start of a port is never assigned");
    require(law_.started_at == no_variable || locals.count(law_.started_at) != 0, "the start is never assigned");
    locals.clear();
    phase("rest", law_.rest, locals, {.inputs = false, .states = true, .locals = true});
    locals.clear();
    phase("tune", law_.tune, locals, {.inputs = false, .states = true, .locals = true});
    locals.clear();
    phase("carry", law_.carry, locals, {.inputs = false, .states = true, .locals = true});
    locals.clear();
    phase("update", law_.update, locals, {.inputs = false, .states = true, .locals = true});
    locals.clear();
    phase("energy", law_.energy, locals, {.inputs = false, .states = false, .locals = true});
    require(locals.count(law_.stored) != 0, "the stored energy is never assigned");
  }

 private:
  // What a phase may read, and what it may assign.
  struct Rights {
    bool inputs, states, locals;
  };

  void require(bool holds, const std::string& otherwise) const {
    if (!holds) throw std::logic_error(fmt::format("{}: {}", pass_, otherwise));
  }

  void check_joints(const std::set<VariableId>& locals) const {
    const JointPorts& joints = *law_.joints;
    for (const auto* assigned : {&joints.dampings, &joints.torques})
      for (const VariableId id : *assigned)
        require(locals.count(id) != 0, "the command of a brake or a motor is never assigned");
    for (const VariableId id : joints.last_dampings)
      require(law_.variables.has(id) && law_.variables[id].role == Role::state,
              "what a refused sample needs is no state");
  }

  void check_tables() const {
    for (const Variable& v : law_.variables)
      require(v.size > 0 && (v.size == 1 || v.element_names.size() == v.size),
              fmt::format("variable '{}' has no name for each place", v.name));
    for (const Coefficient& c : law_.coefficients) {
      require(c.role != ConstantRole::none, fmt::format("constant '{}' has no role", c.name));
      require(!c.values.empty() && (c.element_names.empty() || c.element_names.size() == c.values.size()),
              fmt::format("constant '{}' has no value for each place", c.name));
      require(c.of.size() <= 1 || c.of.size() == c.values.size(),
              fmt::format("constant '{}' has not one subject for each value", c.name));
      require(!c.of.empty() || !is_of_a_part(c), fmt::format("constant '{}' is of no part of the network", c.name));
    }
    for (const Expression& e : law_.expressions) check_references(e);
    for (const VariableId id : {law_.position, law_.velocity, law_.force, law_.stored})
      require(law_.variables.has(id) && law_.variables[id].size == 1, "an input or a result is no scalar");
    for (const PortStart& start : law_.starts)
      require(law_.variables.has(start.state) && law_.variables[start.state].role == Role::state,
              "what reset() sets for a port is no state");
    for (const VariableId id : {law_.rest_position, law_.last_brake})
      require(id == no_variable || (law_.variables.has(id) && law_.variables[id].role == Role::state),
              "what reset() or a refused sample needs is no state");
    for (const GuardInTurn& guard : law_.guards)
      require(law_.variables.has(guard.state) && law_.variables[guard.state].role == Role::state,
              "a guard in turn is of no state");
  }

  void check_references(const Expression& e) const {
    const OperationFacts& facts = facts_of(e.operation);
    for (ExpressionId operand : operands(e))
      require(law_.expressions.has(operand) && operand < law_.expressions.id_of(e),
              fmt::format("an operand of '{}' does not stand before it", facts.name));
    if (facts.refers_to == Referent::variable)
      require(law_.variables.has(e.variable), fmt::format("'{}' refers to no variable", facts.name));
    if (facts.refers_to == Referent::coefficient)
      require(law_.coefficients.has(e.coefficient), fmt::format("'{}' refers to no constant", facts.name));
  }

  void phase(const char* name, const std::vector<Statement>& program, std::set<VariableId>& locals,
             Rights rights) const {
    for (const Statement& statement : program) {
      check_step(statement);
      check_sizes(statement);
      each_read(law_, statement, [&](VariableId id) { check_read(name, id, locals, rights); });
      each_assigned(law_, statement, [&](VariableId id) { check_assigned(name, id, locals, rights); });
    }
  }

  void check_step(const Statement& statement) const {
    match(
        statement.step, [](const Assign&) {},
        [&](const SolveTree& tree) { require(law_.couplings.has(tree.coupling), "a step solves no coupling"); },
        [&](const SolveNetwork& solve) { require(law_.networks.has(solve.network), "a step solves no network"); });
    require(law_.variables.has(statement.target) && law_.expressions.has(statement.value),
            "a statement without target or value");
  }

  void check_sizes(const Statement& statement) const {
    const Variable& target = law_.variables[statement.target];
    const auto require_fit = [&](const std::string& name, std::size_t size, const Lanes& lanes) {
      require(size == 1 || (size == target.size && lanes.count == target.lanes.count),
              fmt::format("'{}' does not fit into '{}'", name, target.name));
    };
    each_expression(law_, statement.value, [&](const Expression& e) {
      if (e.operation == Operation::read) {
        const Variable& read = law_.variables[e.variable];
        require_fit(read.name, read.size, read.lanes);
      }
      if (e.operation == Operation::constant) {
        const Coefficient& read = law_.coefficients[e.coefficient];
        require_fit(read.name, read.values.size(), read.lanes);
      }
    });
  }

  void check_read(const char* phase, VariableId id, const std::set<VariableId>& locals, Rights rights) const {
    require(law_.variables.has(id), fmt::format("{} reads no variable", phase));
    const Variable& variable = law_.variables[id];
    if (variable.role == Role::input)
      require(rights.inputs, fmt::format("{} reads the input '{}'", phase, variable.name));
    if (variable.role == Role::local)
      require(locals.count(id) != 0, fmt::format("{} reads '{}' before it is assigned", phase, variable.name));
  }

  void check_assigned(const char* phase, VariableId id, std::set<VariableId>& locals, Rights rights) const {
    require(law_.variables.has(id), fmt::format("{} assigns no variable", phase));
    const Variable& variable = law_.variables[id];
    require(
        (variable.role == Role::state && rights.states) || (variable.role == Role::local && rights.locals) ||
            (variable.role == Role::tuned && (phase == std::string_view("tune") || phase == std::string_view("carry"))),
        fmt::format("{} assigns '{}'", phase, variable.name));
    if (variable.role == Role::local)
      require(locals.insert(id).second, fmt::format("{} assigns '{}' twice", phase, variable.name));
  }

  const UpdateLaw& law_;
  std::string_view pass_;
};

}  // namespace

void check_law(const UpdateLaw& law, std::string_view pass) { Check(law, pass).run(); }

}  // namespace dashpot::compiler
