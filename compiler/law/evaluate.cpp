#include "law/evaluate.hpp"

#include <dashpot/elementary.hpp>
#include <dashpot/exponential.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>

#include "law/walk.hpp"

namespace dashpot::compiler {

template <class Scalar>
class Evaluation<Scalar>::Translation {
 public:
  Translation(Evaluation& evaluation, Instructions& to) : of_(evaluation), law_(evaluation.law_), to_(to) {}

  void add(const Statement& statement) {
    if (statement.value == nothing) return add_step(statement, {});
    if (!statement.assigns()) return add_step(statement, value(statement.value).place);
    Instruction root = instruction(statement.value);
    root.count = law_.variables[statement.target].size;
    root.target = of_.variables_[statement.target.place()];
    to_.push_back(root);
  }

  std::size_t room() const { return room_; }  // places between two operations, of the widest statement

 private:
  // Where an expression's value stands once the earlier instructions have run.
  struct Value {
    Place place;
    std::size_t count;
  };

  void add_step(const Statement& statement, Place given) {
    Instruction step{Operation::read, 1, 0};
    step.operands[0] = given;
    step.solver = &statement;
    to_.push_back(step);
  }

  static Place place(std::size_t first, std::size_t count) { return {first, count == 1 ? 0u : 1u}; }

  // Variables and constants stand where they are; an expression that is used twice is worked out once.
  Value value(ExpressionId id) {
    const Expression& e = law_.expressions[id];
    if (e.operation == Operation::read || e.operation == Operation::constant) {
      const Instruction copy = instruction(id);
      return {copy.operands[0], copy.count};
    }
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    Instruction one = instruction(id);
    one.target = of_.memory_.size() + used_;
    used_ += one.count;
    room_ = std::max(room_, used_);
    to_.push_back(one);
    return known_.emplace(id, Value{place(one.target, one.count), one.count}).first->second;
  }

  // The instruction without its target; those of its operands come first.
  Instruction instruction(ExpressionId id) {
    const Expression& e = law_.expressions[id];
    Instruction one{e.operation, 1, 0};
    const std::span<const ExpressionId> all = operands(e);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Value operand = value(all[i]);
      one.operands[i] = operand.place;
      one.count = std::max(one.count, operand.count);
    }
    refer(e, one);
    return one;
  }

  // What an operation refers to follows its operands: a value for each place, or a table or vector as a whole.
  void refer(const Expression& e, Instruction& one) const {
    const OperationFacts& facts = facts_of(e.operation);
    if (facts.refers_to == Referent::operands_only) return;
    const bool is_variable = facts.refers_to == Referent::variable;
    const std::size_t size =
        is_variable ? law_.variables[e.variable].size : law_.coefficients[e.coefficient].values.size();
    const std::size_t first =
        is_variable ? of_.variables_[e.variable.place()] : of_.coefficients_[e.coefficient.place()];
    const bool is_value = e.operation == Operation::read || e.operation == Operation::constant;
    one.operands[facts.operands] = is_value ? place(first, size) : Place{first, 0};
    one.last = size - 1;
    if (e.operation == Operation::sum) one.lanes = law_.variables[e.variable].lanes.count;
    if (is_value) one.count = size;
  }

  Evaluation& of_;
  const UpdateLaw& law_;
  Instructions& to_;
  std::map<ExpressionId, Value> known_;
  std::size_t used_ = 0, room_ = 0;
};

template <class Scalar>
tunable_range<Scalar> Evaluation<Scalar>::range_of(const Tunable& parameter) {
  const tunable_range<double>& range = parameter.range;
  return {static_cast<Scalar>(range.value), static_cast<Scalar>(range.min), static_cast<Scalar>(range.max)};
}

template <class Scalar>
Evaluation<Scalar>::Evaluation(const UpdateLaw& law) : law_(law) {
  for (const Variable& variable : law.variables) {
    variables_.push_back(memory_.size());
    memory_.insert(memory_.end(), variable.size, static_cast<Scalar>(variable.rest_value));
  }
  for (const Tunable& parameter : law.parameters()) at(parameter.value)[0] = static_cast<Scalar>(parameter.range.value);
  for (const Coefficient& coefficient : law.coefficients) {
    coefficients_.push_back(memory_.size());
    for (const double value : coefficient.values) memory_.push_back(static_cast<Scalar>(value));
  }
  translate();
  turns_.assign(law.guards.size(), 0);
  for (const Coupling& coupling : law.couplings) solvers_.push_back(solver_of(coupling));
  for (const SlipNetwork& network : law.networks) network_solvers_.push_back(solver_of(network));
  run(tune_);
  run(carry_);
  run(rest_);
}

template <class Scalar>
void Evaluation<Scalar>::translate() {
  std::size_t room = 0;
  for (const auto& [program, to] : {std::pair(&law_.output, &output_),
                                    {&law_.keep, &keep_},
                                    {&law_.update, &update_},
                                    {&law_.energy, &energy_},
                                    {&law_.start, &start_},
                                    {&law_.rest, &rest_},
                                    {&law_.tune, &tune_},
                                    {&law_.carry, &carry_}})
    for (const Statement& statement : *program) {
      Translation one(*this, *to);
      one.add(statement);
      room = std::max(room, one.room());
    }
  memory_.resize(memory_.size() + room);
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
  solver.merged.resize(static_cast<std::size_t>(slip_curve_room(coupling.slip_count())));
  solver.held.resize(coupling.held.size());
  solver.moved.resize(coupling.moved.size());
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
    std::fill_n(at(law_.variables.id_of(variable)), variable.size, static_cast<Scalar>(variable.rest_value));
  }
  if (!law_.joints) {
    at(law_.position)[0] = all_finite(position) ? position : Scalar(0);
    start();
  }
  std::fill(turns_.begin(), turns_.end(), 0);
  run(rest_);
  sampled_ = false;
}

template <class Scalar>
command<Scalar> Evaluation<Scalar>::output(Scalar position, Scalar velocity) {
  at(law_.position)[0] = position;
  at(law_.velocity)[0] = velocity;
  run(output_);
  const Scalar force = at(law_.force)[0];
  sampled_ = all_finite(position, velocity, at(law_.checked())[0]);
  if (!sampled_) return {damping(law_.last_brake), Scalar(0)};
  run(keep_);
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
  run(tune_);
  run(carry_);
  return clamped;
}

template <class Scalar>
void Evaluation<Scalar>::reset(const std::vector<Scalar>& positions) {
  reset(Scalar(0));
  for (std::size_t i = 0; i < positions.size(); ++i)
    at(law_.joints->positions[i])[0] = all_finite(positions[i]) ? positions[i] : Scalar(0);
  start();
  run(rest_);
}

template <class Scalar>
void Evaluation<Scalar>::start() {
  run(start_);
  for (const Variable& variable : law_.variables) {
    const VariableId state = law_.variables.id_of(variable), start = law_.start_of(state);
    if (start != no_variable) at(state)[0] = all_finite(at(start)[0]) ? at(start)[0] : Scalar(0);
  }
}

template <class Scalar>
JointCommand<Scalar> Evaluation<Scalar>::step(const std::vector<Scalar>& positions,
                                              const std::vector<Scalar>& velocities) {
  const JointPorts& joints = *law_.joints;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    at(joints.positions[i])[0] = positions[i];
    at(joints.velocities[i])[0] = velocities[i];
  }
  run(output_);
  sampled_ = true;
  for (const auto* checked : {&joints.positions, &joints.velocities, &joints.dampings, &joints.torques})
    for (const VariableId id : *checked) sampled_ = sampled_ && all_finite(at(id)[0]);
  if (sampled_) run(keep_);
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
  run(update_);
}

template <class Scalar>
void Evaluation<Scalar>::take_turn(const GuardInTurn& guard, std::size_t& turn) {
  Scalar* const forces = at(guard.state);
  const std::size_t size = law_.variables[guard.state].size;
  for (std::size_t place = turn; place < std::min(turn + guard.places, size); ++place)
    forces[place] = flush_below(static_cast<Scalar>(law_.flush_threshold), forces[place]);
  turn += guard.places;
  if (turn >= law_.variables[guard.state].lanes.padded(size)) turn = 0;
}

template <class Scalar>
command<Scalar> Evaluation<Scalar>::step(Scalar position, Scalar velocity) {
  const command<Scalar> result = output(position, velocity);
  update();
  return result;
}

template <class Scalar>
Scalar Evaluation<Scalar>::stored_energy() {
  run(energy_);
  return at(law_.stored)[0];
}

template <class Scalar>
void Evaluation<Scalar>::run(const Instructions& program) {
  Scalar* const memory = memory_.data();
  for (const Instruction& one : program) {
    const Place *const a = &one.operands[0], *const b = a + 1, *const c = a + 2;
    if (one.solver != nullptr) {
      const Statement& statement = *one.solver;
      std::visit([&](const auto& step) { take(step, statement, memory[a->first]); }, statement.step);
    } else if (one.count == 1) {
      take(one, [=](const auto& value) {
        memory[one.target] = value(memory + a->first, memory + b->first, memory + c->first);
      });
    } else {
      take(one, [=, &one](const auto& value) {
        for (std::size_t i = 0; i < one.count; ++i)
          memory[one.target + i] =
              value(memory + a->first + i * a->step, memory + b->first + i * b->step, memory + c->first + i * c->step);
      });
    }
  }
}

template <class Scalar>
void Evaluation<Scalar>::take(const Assign&, const Statement&, Scalar) {
  throw std::logic_error("evaluate: an assignment that solves for nothing");
}

template <class Scalar>
void Evaluation<Scalar>::take(const SolveTree& step, const Statement& statement, Scalar given) {
  solve(law_.couplings[step.coupling], solvers_[step.coupling.place()], statement.target, given);
}

template <class Scalar>
void Evaluation<Scalar>::take(const SolveNetwork& step, const Statement& statement, Scalar given) {
  solve(law_.networks[step.network], network_solvers_[step.network.place()], statement.target, given);
}

template <class Scalar>
void Evaluation<Scalar>::give_held(const SolvedSlips& solved, Lists& lists) const {
  for (std::size_t i = 0; i < solved.held.size(); ++i)
    lists.held[i] = solved.held[i] == no_variable ? Scalar(0) : at(solved.held[i])[0];
}

template <class Scalar>
void Evaluation<Scalar>::take_results(const SolvedSlips& solved, const Lists& lists) {
  each_result(solved, [&](VariableId id, SlipResult what, std::size_t i) {
    switch (what) {
      case SlipResult::surface: at(id)[0] = lists.surface; break;
      case SlipResult::moved: at(id)[0] = lists.moved[i]; break;
      case SlipResult::sign: at(id)[0] = static_cast<Scalar>(lists.sign[i]); break;
    }
  });
}

template <class Scalar>
void Evaluation<Scalar>::solve(const Coupling& coupling, Solver& solver, VariableId target, Scalar change) {
  give_held(coupling, solver);
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
  at(target)[0] = coupling.is_pushed()
                      ? tree.push(change, solver.held.data(), solver.moved.data(), solver.sign.data(), solver.surface)
                      : tree.step(change, solver.held.data(), solver.moved.data(), solver.sign.data());
  take_results(coupling, solver);
}

template <class Scalar>
void Evaluation<Scalar>::solve(const SlipNetwork& network, NetworkSolver& solver, VariableId target, Scalar change) {
  give_held(network, solver);
  for (std::size_t i = 0; i < network.sign.size(); ++i) solver.sign[i] = static_cast<int>(at(network.last_sign[i])[0]);
  const Scalar through = tune(network, solver);
  slip_network<Scalar> step(solver.links.data(), network.slip_count(),
                            {solver.between.data(), solver.to_tool.data(), solver.to_ground.data(), through},
                            network.node_count, {solver.group.data(), solver.room.data(), solver.numbers.data()});
  at(target)[0] = step.step(change, solver.held.data(), solver.moved.data(), solver.sign.data());
  take_results(network, solver);
}

// Copies the numbers that parameters change. Returns the stiffness between tool and ground.
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
template <class AtEach>
void Evaluation<Scalar>::take(const Instruction& one, const AtEach& at_each) {
  using Operand = const Scalar*;
  const auto flushed = [&](Scalar number) { return flush_below(static_cast<Scalar>(law_.flush_threshold), number); };
  switch (one.operation) {
    case Operation::read:
    case Operation::constant: return at_each([](Operand a, Operand, Operand) { return *a; });
    case Operation::add: return at_each([](Operand a, Operand b, Operand) { return *a + *b; });
    case Operation::subtract: return at_each([](Operand a, Operand b, Operand) { return *a - *b; });
    case Operation::multiply: return at_each([](Operand a, Operand b, Operand) { return *a * *b; });
    case Operation::divide: return at_each([](Operand a, Operand b, Operand) { return *a / *b; });
    case Operation::square_root: return at_each([](Operand a, Operand, Operand) { return square_root(*a); });
    case Operation::mean_decay: return at_each([](Operand a, Operand, Operand) { return mean_decay(*a); });
    case Operation::flush: return at_each([&](Operand a, Operand, Operand) { return flushed(*a); });
    case Operation::clamp: return at_each([](Operand a, Operand b, Operand) { return clamp_to(*b, *a); });
    case Operation::where: return at_each([](Operand a, Operand b, Operand c) { return *a > 0 ? *b : *c; });
    case Operation::relax: return at_each([&](Operand a, Operand b, Operand c) { return *c + *a * flushed(*b); });
    case Operation::pick: return at_each([&](Operand a, Operand b, Operand) { return picked(b, one.last, *a); });
    case Operation::sum: return at_each([&](Operand a, Operand, Operand) { return sum(a, one.last + 1, one.lanes); });
  }
}

// A choice computes both of its values, so the index may lie outside of the table in the one that is not taken.
template <class Scalar>
Scalar Evaluation<Scalar>::picked(const Scalar* table, std::size_t last, Scalar place) {
  if (!(place > 0)) return table[0];
  return table[place < static_cast<Scalar>(last) ? static_cast<std::size_t>(place) : last];
}

// Adds from the first place to the last. With lanes, places go to the lanes in turn, and lanes are joined half by half.
template <class Scalar>
Scalar Evaluation<Scalar>::sum(const Scalar* vector, std::size_t size, std::size_t lanes) {
  if (lanes == 1) {
    Scalar total = vector[0];
    for (std::size_t i = 1; i < size; ++i) total += vector[i];
    return total;
  }
  lanes_.assign(lanes, 0);
  for (std::size_t i = 0; i < size; ++i) lanes_[i % lanes] += vector[i];
  for (std::size_t half = lanes / 2; half > 0; half /= 2)
    for (std::size_t i = 0; i < half; ++i) lanes_[i] += lanes_[i + half];
  return lanes_[0];
}

template class Evaluation<float>;
template class Evaluation<double>;

}  // namespace dashpot::compiler
