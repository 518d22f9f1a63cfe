// Runs an update law without emission, in the same order of the same operations as the emitted code: with
// -ffp-contract=off the two agree to the last bit.
#pragma once

#include <dashpot/command.hpp>

#include <array>
#include <cstddef>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// The command of a law of several joints, as the emitted code returns it.
template <class Scalar>
struct JointCommand {
  std::vector<Scalar> damping;  // one for each brake
  std::vector<Scalar> torque;   // one for each motor
};

// Scalar is float or double, as the law's scalar type.
template <class Scalar>
class Evaluation {
 public:
  explicit Evaluation(const UpdateLaw& law);

  void reset(Scalar position = 0);
  command<Scalar> output(Scalar position, Scalar velocity);
  void update();
  command<Scalar> step(Scalar position, Scalar velocity);
  // The same for a law of several joints.
  void reset(const std::vector<Scalar>& positions);
  JointCommand<Scalar> step(const std::vector<Scalar>& positions, const std::vector<Scalar>& velocities);
  Scalar stored_energy();
  Scalar value_of(VariableId scalar) const { return at(scalar)[0]; }
  // The share of all forces that the last output() kept so that the motor can follow; 1 for a law that does not shed.
  Scalar kept_share() const;
  // Values of the tunables in the order of the network's parameters; bit i: value i was NaN or beyond its range.
  unsigned set(const std::vector<Scalar>& values);

 private:
  // Inputs and results of a step of slips.
  struct Lists {
    std::vector<Scalar> held, moved;
    std::vector<int> sign;
    Scalar surface = 0;
  };

  // The tables of coupled slips and the room for their steps.
  struct Solver : Lists {
    std::vector<slip_node<Scalar>> nodes;
    std::vector<slip_part_state<Scalar>> parts;
    std::vector<slip_corner<Scalar>> corners, merged;
  };

  // The same for slips outside a tree.
  struct NetworkSolver : Lists {
    std::vector<slip_link<Scalar>> links;
    std::vector<Scalar> between, to_tool, to_ground;
    std::vector<int> group;
    std::vector<Scalar> room, numbers;
  };

  // Where a scalar, or the first of several, lies in the memory.
  struct Place {
    std::size_t first = 0;
    std::size_t step = 0;  // distance to the next; 0 for a scalar, which every place reads
  };

  // One operation at `count` places, or a solver's step whose input is operand 0.
  struct Instruction {
    Operation operation;
    std::size_t count;
    std::size_t target;
    std::array<Place, 4> operands = {};  // followed by what the operation refers to
    std::size_t last = 0;                // last place of a table or vector
    std::size_t lanes = 1;               // of a sum
    const Statement* solver = nullptr;   // for a solver's step
  };
  using Instructions = std::vector<Instruction>;

  class Translation;  // of one statement into instructions

  static tunable_range<Scalar> range_of(const Tunable& parameter);
  static Solver solver_of(const Coupling& coupling);
  static NetworkSolver solver_of(const SlipNetwork& network);
  void translate();
  void run(const Instructions& program);
  // `at_each` is given the operation as a function of its operands.
  template <class AtEach>
  void take(const Instruction& instruction, const AtEach& at_each);
  void take(const Assign& step, const Statement& statement, Scalar given);
  void take(const SolveTree& step, const Statement& statement, Scalar given);
  void take(const SolveNetwork& step, const Statement& statement, Scalar given);
  void take_turn(const GuardInTurn& guard, std::size_t& turn);
  void solve(const Coupling& coupling, Solver& solver, VariableId target, Scalar change);
  void solve(const SlipNetwork& network, NetworkSolver& solver, VariableId target, Scalar change);
  void give_held(const SolvedSlips& solved, Lists& lists) const;
  void take_results(const SolvedSlips& solved, const Lists& lists);
  Scalar tune(const SlipNetwork& network, NetworkSolver& solver) const;
  void start();  // sets the states that start from the position
  Scalar damping(VariableId changing) const;
  static Scalar picked(const Scalar* table, std::size_t last, Scalar place);
  Scalar sum(const Scalar* vector, std::size_t size, std::size_t lanes);
  Scalar* at(VariableId id) { return memory_.data() + variables_[id.place()]; }
  const Scalar* at(VariableId id) const { return memory_.data() + variables_[id.place()]; }

  const UpdateLaw& law_;
  std::vector<Scalar> memory_;                         // variables, then constants, then intermediate values
  std::vector<std::size_t> variables_, coefficients_;  // where each begins
  Instructions output_, keep_, update_, energy_, start_, rest_, tune_, carry_;
  std::vector<Scalar> lanes_;       // room for the partial sums of a sum
  std::vector<std::size_t> turns_;  // for each guard, the first place that it tests next
  std::vector<Solver> solvers_;     // one for each coupling
  std::vector<NetworkSolver> network_solvers_;
  bool sampled_ = false;  // a finite sample waits for update()
};

extern template class Evaluation<float>;
extern template class Evaluation<double>;

}  // namespace dashpot::compiler
