#include "law/evaluate.hpp"

#include <dashpot/elementary.hpp>
#include <dashpot/exponential.hpp>

#include <algorithm>
#include <stdexcept>

namespace dashpot::compiler {

template <class Scalar>
tunable_range<Scalar> Evaluation<Scalar>::range_of(const Tunable& parameter) {
  const tunable_range<double>& range = parameter.range;
  return {static_cast<Scalar>(range.value), static_cast<Scalar>(range.min), static_cast<Scalar>(range.max)};
}

template <class Scalar>
Evaluation<Scalar>::Evaluation(const UpdateLaw& law) : law_(law) {
  for (const Variable& variable : law.variables)
    variables_.emplace_back(variable.size, static_cast<Scalar>(variable.rest_value));
  for (const Tunable& parameter : law.parameters()) at(parameter.value)[0] = static_cast<Scalar>(parameter.range.value);
  for (const Coefficient& coefficient : law.coefficients)
    coefficients_.emplace_back(coefficient.values.begin(), coefficient.values.end());
  turns_.assign(law.guards.size(), 0);
  for (const Coupling& coupling : law.couplings) solvers_.push_back(solver_of(coupling));
  for (const SlipNetwork& network : law.networks) network_solvers_.push_back(solver_of(network));
  run(law.tune);
  run(law.carry);
  run(law.rest);
}

template <class Scalar>
typename Evaluation<Scalar>::Solver Evaluation<Scalar>::solver_of(const Coupling& coupling) {
  Solver solver;
  for (const slip_node<double>& node : coupling.nodes)
    solver.nodes.push_back({node.kind, node.first_child, node.child_count, node.slips, node.place, node.first_corner,
                            static_cast<Scalar>(node.stiffness), static_cast<Scalar>(node.compliance),
                            static_cast<Scalar>(node.yield)});
  solver.parts.resize(coupling.nodes.size());
  solver.corners.resize(static_cast<std::size_t>(coupling.corners()));
  solver.merged.resize(static_cast<std::size_t>(slip_curve_room(static_cast<int>(coupling.slips.size()))));
  solver.held.resize(coupling.held.size());
  solver.elongation.resize(coupling.elongation.size());
  solver.sign.resize(coupling.slips.size());
  return solver;
}

template <class Scalar>
typename Evaluation<Scalar>::NetworkSolver Evaluation<Scalar>::solver_of(const SlipNetwork& network) {
  NetworkSolver solver;
  for (const slip_link<double>& link : network.links)
    solver.links.push_back({link.a, link.b, static_cast<Scalar>(link.lowest), static_cast<Scalar>(link.highest)});
  solver.between.assign(network.between.begin(), network.between.end());
  solver.to_tool.assign(network.to_tool.begin(), network.to_tool.end());
  solver.to_ground.assign(network.to_ground.begin(), network.to_ground.end());
  const auto nodes = static_cast<std::size_t>(network.node_count);
  solver.held.resize(nodes + 1);
  solver.moved.resize(nodes);
  solver.sign.resize(network.links.size());
  solver.group.resize(nodes + 2);
  solver.room.resize(nodes * nodes);
  solver.numbers.resize(8 * nodes);
  return solver;
}

template <class Scalar>
void Evaluation<Scalar>::reset(Scalar position) {
  for (const Variable& variable : law_.variables) {
    if (variable.role == Role::tuned) continue;
    std::vector<Scalar>& places = at(law_.variables.id_of(variable));
    std::fill(places.begin(), places.end(), static_cast<Scalar>(variable.rest_value));
  }
  if (law_.rest_position != no_variable && all_finite(position, position, position))
    at(law_.rest_position)[0] = rest_position(position);
  if (!law_.joints && !law_.starts.empty()) {
    at(law_.position)[0] = all_finite(position) ? position : Scalar(0);
    start();
  }
  std::fill(turns_.begin(), turns_.end(), 0);
  run(law_.rest);
  sampled_ = false;
}

template <class Scalar>
Scalar Evaluation<Scalar>::rest_position(Scalar position) {
  if (law_.started_at != no_variable) {
    at(law_.position)[0] = position;
    run(law_.start);
    return at(law_.started_at)[0];
  }
  return law_.surface_at ? pushed_in(static_cast<Scalar>(*law_.surface_at), position) : position;
}

template <class Scalar>
command<Scalar> Evaluation<Scalar>::output(Scalar position, Scalar velocity) {
  at(law_.position)[0] = position;
  at(law_.velocity)[0] = velocity;
  run(law_.output);
  const Scalar force = at(law_.force)[0];
  sampled_ = all_finite(position, velocity, at(law_.checked())[0]);
  if (!sampled_) return {damping(law_.last_brake), Scalar(0)};
  run(law_.keep);
  return {damping(law_.brake), force};
}

template <class Scalar>
Scalar Evaluation<Scalar>::damping(VariableId changing) const {
  return law_.brake_changes() ? at(changing)[0] : static_cast<Scalar>(law_.damping);
}

template <class Scalar>
Scalar Evaluation<Scalar>::kept_share() const {
  return law_.sheds() ? at(law_.share)[0] : Scalar(1);
}

template <class Scalar>
unsigned Evaluation<Scalar>::set(const std::vector<Scalar>& values) {
  update();
  const std::vector<Tunable> parameters = law_.parameters();
  unsigned clamped = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    clamped |= take_value(range_of(parameters[i]), values[i], at(parameters[i].value)[0]) << i;
  run(law_.tune);
  run(law_.carry);
  return clamped;
}

template <class Scalar>
void Evaluation<Scalar>::reset(const std::vector<Scalar>& positions) {
  reset(Scalar(0));
  for (std::size_t i = 0; i < positions.size(); ++i)
    at(law_.joints->positions[i])[0] = all_finite(positions[i]) ? positions[i] : Scalar(0);
  start();
}

template <class Scalar>
void Evaluation<Scalar>::start() {
  run(law_.start);
  for (const PortStart& start : law_.starts)
    at(start.state)[0] = all_finite(at(start.value)[0]) ? at(start.value)[0] : Scalar(0);
}

template <class Scalar>
JointCommand<Scalar> Evaluation<Scalar>::step(const std::vector<Scalar>& positions,
                                              const std::vector<Scalar>& velocities) {
  const JointPorts& joints = *law_.joints;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    at(joints.positions[i])[0] = positions[i];
    at(joints.velocities[i])[0] = velocities[i];
  }
  run(law_.output);
  sampled_ = true;
  for (const auto* checked : {&joints.positions, &joints.velocities, &joints.dampings, &joints.torques})
    for (const VariableId id : *checked) sampled_ = sampled_ && all_finite(at(id)[0]);
  if (sampled_) run(law_.keep);
  JointCommand<Scalar> now;
  for (const VariableId id : joints.last_dampings) now.damping.push_back(at(id)[0]);
  for (const VariableId id : joints.torques) now.torque.push_back(sampled_ ? at(id)[0] : Scalar(0));
  update();
  return now;
}

template <class Scalar>
void Evaluation<Scalar>::update() {
  if (!sampled_) return;
  sampled_ = false;
  for (std::size_t i = 0; i < law_.guards.size(); ++i) take_turn(law_.guards[i], turns_[i]);
  run(law_.update);
}

template <class Scalar>
void Evaluation<Scalar>::take_turn(const GuardInTurn& guard, std::size_t& turn) {
  std::vector<Scalar>& forces = at(guard.state);
  for (std::size_t place = turn; place < std::min(turn + guard.places, forces.size()); ++place)
    forces[place] = flush_below(static_cast<Scalar>(law_.flush_threshold), forces[place]);
  turn += guard.places;
  if (turn >= law_.padded(forces.size())) turn = 0;
}

template <class Scalar>
command<Scalar> Evaluation<Scalar>::step(Scalar position, Scalar velocity) {
  const command<Scalar> result = output(position, velocity);
  update();
  return result;
}

template <class Scalar>
Scalar Evaluation<Scalar>::stored_energy() {
  run(law_.energy);
  return at(law_.stored)[0];
}

template <class Scalar>
void Evaluation<Scalar>::run(const std::vector<Statement>& program) {
  for (const Statement& statement : program)
    std::visit([&](const auto& step) { take(step, statement); }, statement.step);
}

template <class Scalar>
void Evaluation<Scalar>::take(const Assign&, const Statement& statement) {
  std::vector<Scalar>& target = at(statement.target);
  for (std::size_t place = 0; place < target.size(); ++place) target[place] = value(statement.value, place);
}

template <class Scalar>
void Evaluation<Scalar>::take(const SolveTree& step, const Statement& statement) {
  solve(law_.couplings[step.coupling], solvers_[step.coupling.place()], statement);
}

template <class Scalar>
void Evaluation<Scalar>::take(const SolveNetwork& step, const Statement& statement) {
  solve(law_.networks[step.network], network_solvers_[step.network.place()], statement);
}

template <class Scalar>
void Evaluation<Scalar>::take(const Call&, const Statement&) {
  throw std::logic_error("evaluate: a call that is not spelled out");
}

template <class Scalar>
void Evaluation<Scalar>::solve(const Coupling& coupling, Solver& solver, const Statement& statement) {
  for (std::size_t i = 0; i < coupling.held.size(); ++i)
    solver.held[i] = coupling.held[i] == no_variable ? Scalar(0) : at(coupling.held[i])[0];
  const auto tune = [&](VariableId tuned, Scalar& number) {
    if (tuned != no_variable) number = at(tuned)[0];
  };
  for (std::size_t i = 0; i < coupling.tuned.size(); ++i) {
    tune(coupling.tuned[i].stiffness, solver.nodes[i].stiffness);
    tune(coupling.tuned[i].compliance, solver.nodes[i].compliance);
    tune(coupling.tuned[i].yield, solver.nodes[i].yield);
  }
  slip_tree<Scalar> tree(solver.nodes.data(), coupling.node_count(), solver.parts.data(), solver.corners.data(),
                         solver.merged.data());
  const Scalar change = value(statement.value, 0);
  if (coupling.is_pushed())
    at(statement.target)[0] = tree.push(change, solver.held.data(), solver.elongation.data(), solver.sign.data(),
                                        at(coupling.surface_change)[0]);
  else at(statement.target)[0] = tree.step(change, solver.held.data(), solver.elongation.data(), solver.sign.data());
  for (std::size_t i = 0; i < coupling.elongation.size(); ++i)
    if (coupling.elongation[i] != no_variable) at(coupling.elongation[i])[0] = solver.elongation[i];
  for (std::size_t i = 0; i < coupling.sign.size(); ++i)
    if (coupling.sign[i] != no_variable) at(coupling.sign[i])[0] = static_cast<Scalar>(solver.sign[i]);
}

template <class Scalar>
void Evaluation<Scalar>::solve(const SlipNetwork& network, NetworkSolver& solver, const Statement& statement) {
  for (std::size_t i = 0; i < network.held.size(); ++i)
    solver.held[i] = network.held[i] == no_variable ? Scalar(0) : at(network.held[i])[0];
  for (std::size_t i = 0; i < network.sign.size(); ++i) solver.sign[i] = static_cast<int>(at(network.last_sign[i])[0]);
  const Scalar through = tune(network, solver);
  slip_network<Scalar> step(solver.links.data(), network.slip_count(),
                            {solver.between.data(), solver.to_tool.data(), solver.to_ground.data(), through},
                            network.node_count, {solver.group.data(), solver.room.data(), solver.numbers.data()});
  at(statement.target)[0] =
      step.step(value(statement.value, 0), solver.held.data(), solver.moved.data(), solver.sign.data());
  for (std::size_t i = 0; i < network.moved.size(); ++i)
    if (network.moved[i] != no_variable) at(network.moved[i])[0] = solver.moved[i];
  for (std::size_t i = 0; i < network.sign.size(); ++i) at(network.sign[i])[0] = static_cast<Scalar>(solver.sign[i]);
}

// The numbers that parameters change. Returns what joins tool and ground.
template <class Scalar>
Scalar Evaluation<Scalar>::tune(const SlipNetwork& network, NetworkSolver& solver) const {
  if (!network.tuned) return static_cast<Scalar>(network.through);
  const TunedNetwork& tuned = *network.tuned;
  for (std::size_t i = 0; i < tuned.yields.size(); ++i)
    if (tuned.yields[i] != no_variable) {
      solver.links[i].highest = at(tuned.yields[i])[0];
      solver.links[i].lowest = -solver.links[i].highest;
    }
  for (const auto& [numbers, values] :
       {std::pair(&tuned.between, &solver.between), std::pair(&tuned.to_tool, &solver.to_tool),
        std::pair(&tuned.to_ground, &solver.to_ground)})
    for (std::size_t i = 0; i < numbers->size(); ++i)
      if ((*numbers)[i] != no_variable) (*values)[i] = at((*numbers)[i])[0];
  return tuned.through == no_variable ? static_cast<Scalar>(network.through) : at(tuned.through)[0];
}

template <class Scalar>
Scalar Evaluation<Scalar>::value(ExpressionId id, std::size_t place) const {
  const auto there = [place](const std::vector<Scalar>& vector) { return vector[vector.size() == 1 ? 0 : place]; };
  const Expression& e = law_.expressions[id];
  // Most operands are leaves, and those need no call.
  const auto operand = [&](std::size_t i) {
    const Expression& inner = law_.expressions[e.operands[i]];
    if (inner.operation == Operation::read) return there(at(inner.variable));
    if (inner.operation == Operation::constant) return there(at(inner.coefficient));
    return value(e.operands[i], place);
  };
  const auto flushed = [&](Scalar number) { return flush_below(static_cast<Scalar>(law_.flush_threshold), number); };
  switch (e.operation) {
    case Operation::read: return there(at(e.variable));
    case Operation::constant: return there(at(e.coefficient));
    case Operation::add: return operand(0) + operand(1);
    case Operation::subtract: return operand(0) - operand(1);
    case Operation::multiply: return operand(0) * operand(1);
    case Operation::divide: return operand(0) / operand(1);
    case Operation::square_root: return square_root(operand(0));
    case Operation::mean_decay: return mean_decay(operand(0));
    case Operation::flush: return flushed(operand(0));
    case Operation::clamp: return clamp_to(operand(1), operand(0));
    case Operation::where: return operand(0) > 0 ? operand(1) : operand(2);
    case Operation::relax: return operand(2) + operand(0) * flushed(operand(1));
    case Operation::pick: return at(e.coefficient)[static_cast<std::size_t>(operand(0))];
    case Operation::sum: return sum(e.variable);
  }
  return Scalar(0);
}

template <class Scalar>
Scalar Evaluation<Scalar>::sum(VariableId id) const {
  const std::vector<Scalar>& vector = at(id);
  if (!law_.is_rolled(vector.size())) {
    Scalar total = vector[0];
    for (std::size_t i = 1; i < vector.size(); ++i) total += vector[i];
    return total;
  }
  std::vector<Scalar> lanes(law_.lanes, Scalar(0));
  for (std::size_t i = 0; i < vector.size(); ++i) lanes[i % law_.lanes] += vector[i];
  for (std::size_t half = law_.lanes / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  return lanes[0];
}

template class Evaluation<float>;
template class Evaluation<double>;

}  // namespace dashpot::compiler
