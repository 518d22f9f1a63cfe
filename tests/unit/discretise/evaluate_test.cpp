// What each operation of a law means, on laws written by hand.
#include "law/evaluate.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace dashpot::compiler;

// A law of one sum: force = f(position, velocity) and nothing kept.
class HandWritten {
 public:
  HandWritten() {
    law.damping = 2;
    law.position = variable("position", Role::input);
    law.velocity = variable("velocity", Role::input);
    law.force = variable("force", Role::local);
    law.stored = variable("stored", Role::local);
  }

  VariableId variable(const char* name, Role role, std::size_t size = 1) {
    return law.variables.add({name, "", "", role, size, {}});
  }
  ExpressionId constant(std::vector<double> values) {
    const CoefficientId id = law.coefficients.add({"c", "", "", std::move(values), {}});
    return law.expressions.add({Operation::constant, {}, {}, id});
  }
  ExpressionId node(Operation operation, ExpressionId first, ExpressionId second = {}, ExpressionId third = {}) {
    return law.expressions.add({operation, {first, second, third}});
  }
  ExpressionId read(VariableId variable) { return law.expressions.add({Operation::read, {}, variable}); }
  ExpressionId sum(VariableId vector) { return law.expressions.add({Operation::sum, {}, vector}); }

  UpdateLaw law;
};

double force_of(const HandWritten& h, double position, double velocity) {
  return Evaluation<double>(h.law).output(position, velocity).force;
}

// Fails if an operation is not what its name says, or takes its operands the other way round.
TEST(Evaluate, Arithmetic) {
  for (const auto& [operation, expected] :
       {std::pair{Operation::add, 7.0}, {Operation::subtract, 3.0}, {Operation::multiply, 10.0}}) {
    HandWritten h;
    h.law.output.push_back({h.law.force, h.node(operation, h.read(h.law.position), h.read(h.law.velocity)), "", {}});
    EXPECT_EQ(force_of(h, 5, 2), expected);
  }
}

// Fails if a value at the threshold is kept or one above it is not, on either side of zero.
TEST(Evaluate, Flush) {
  HandWritten h;
  h.law.flush_threshold = 0.5;
  h.law.output.push_back({h.law.force, h.node(Operation::flush, h.read(h.law.position)), "", {}});
  EXPECT_EQ(force_of(h, 0.5, 0), 0);
  EXPECT_EQ(force_of(h, -0.5, 0), 0);
  EXPECT_EQ(force_of(h, 0.75, 0), 0.75);
  EXPECT_EQ(force_of(h, -0.75, 0), -0.75);
}

// Fails if a force that relaxes is not what it is driven by and its decayed rest, which is nothing below the threshold.
TEST(Evaluate, Relax) {
  for (const auto& [held, expected] : {std::pair{0.75, 4.5}, {0.5, 3.0}, {-0.75, 1.5}}) {
    HandWritten h;
    h.law.flush_threshold = 0.5;
    const ExpressionId decay = h.constant({2}), drive = h.constant({3});
    h.law.output.push_back({h.law.force, h.node(Operation::relax, decay, h.read(h.law.position), drive), "", {}});
    EXPECT_EQ(force_of(h, held, 0), expected);
  }
}

// 1, 2⁻⁵³, −1, 2⁻⁵³ in double: from the first to the last 2⁻⁵³, in two lanes 2⁻⁵², and so in four, of which the second
// half is added to the first.
double sum_in(std::size_t lanes) {
  HandWritten h;
  const VariableId terms = h.variable("terms", Role::local, 4);
  h.law.variables[terms].lanes = {lanes};
  h.law.output.push_back({terms, h.constant({1, 0x1p-53, -1, 0x1p-53}), "", {}});
  h.law.output.push_back({h.law.force, h.sum(terms), "", {}});
  return force_of(h, 0, 0);
}

// Fails if a sum is added up in another order than the emitted code's, so that the two differ in their last bits.
TEST(Evaluate, OrderOfSums) {
  EXPECT_EQ(sum_in(1), 0x1p-53);
  EXPECT_EQ(sum_in(2), 0x1p-52);
  EXPECT_EQ(sum_in(4), 0x1p-52);
}

// Fails if a scalar is not the same for every place of a vector.
TEST(Evaluate, ScalarsBroadcastToVectors) {
  HandWritten h;
  const VariableId terms = h.variable("terms", Role::local, 3);
  h.law.output.push_back(
      {terms, h.node(Operation::multiply, h.constant({1, 10, 100}), h.read(h.law.position)), "", {}});
  h.law.output.push_back({h.law.force, h.sum(terms), "", {}});
  EXPECT_EQ(force_of(h, 3, 0), 333);
}

// An integrator: state ← state + sampled position, force = state + position.
HandWritten integrator() {
  HandWritten h;
  const VariableId state = h.variable("state", Role::state), sampled = h.variable("sampled", Role::state);
  h.law.rest_position = state;
  h.law.output.push_back({h.law.force, h.node(Operation::add, h.read(state), h.read(h.law.position)), "", {}});
  h.law.keep.push_back({sampled, h.read(h.law.position), "", {}});
  h.law.update.push_back({state, h.node(Operation::add, h.read(state), h.read(sampled)), "", {}});
  h.law.energy.push_back({h.law.stored, h.read(state), "", {}});
  return h;
}

// Fails if states move before the command has left, or move twice for one sample.
TEST(Evaluate, OutputThenUpdate) {
  const HandWritten h = integrator();
  Evaluation<double> law(h.law);
  law.reset(1);
  EXPECT_EQ(law.output(4, 0).force, 5);
  EXPECT_EQ(law.stored_energy(), 1);
  law.update();
  EXPECT_EQ(law.stored_energy(), 5);
  law.update();
  EXPECT_EQ(law.stored_energy(), 5);
  EXPECT_EQ(law.step(2, 0).force, 7);
  EXPECT_EQ(law.stored_energy(), 7);
}

// Fails if a NaN or infinite input or force reaches a state, or leaves the motor anything but 0.
TEST(Evaluate, NonFiniteInputsReachNoState) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const double max = std::numeric_limits<double>::max();
  const HandWritten h = integrator();
  Evaluation<double> law(h.law);
  law.reset(max);
  for (const auto& [position, velocity] :
       {std::pair{nan, 0.0}, {inf, 0.0}, {-inf, 0.0}, {0.0, nan}, {0.0, -inf}, {max, 0.0}}) {
    const auto now = law.step(position, velocity);
    EXPECT_EQ(now.force, 0);
    EXPECT_EQ(now.damping, 2);
    EXPECT_EQ(law.stored_energy(), max);
  }
}

// Fails if anything of the past survives reset().
TEST(Evaluate, ResetForgets) {
  const HandWritten h = integrator();
  Evaluation<double> law(h.law);
  law.reset(7);
  law.output(3, 0);
  law.reset(1);
  law.update();
  EXPECT_EQ(law.stored_energy(), 1);
}

// Fails if a brake that changes is not what is commanded, or a NaN or infinite sample is not answered with the last
// safe one, which is the rest value after a reset.
TEST(Evaluate, BrakeThatChanges) {
  HandWritten h;
  h.law.brake = h.variable("damping", Role::local);
  h.law.last_brake = h.variable("last_damping", Role::state);
  h.law.variables[h.law.last_brake].rest_value = 3;
  h.law.output.push_back({h.law.brake, h.read(h.law.position), "", {}});
  h.law.output.push_back({h.law.force, h.read(h.law.velocity), "", {}});
  h.law.keep.push_back({h.law.last_brake, h.read(h.law.brake), "", {}});
  Evaluation<double> law(h.law);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [&](const dashpot::command<double>& now, double damping, double force) {
    EXPECT_EQ(now.damping, damping);
    EXPECT_EQ(now.force, force);
  };
  expect(law.step(nan, 1), 3, 0);
  expect(law.step(5, 7), 5, 7);
  expect(law.step(6, nan), 5, 0);
  law.reset(0);
  expect(law.step(1, nan), 3, 0);
}

}  // namespace
