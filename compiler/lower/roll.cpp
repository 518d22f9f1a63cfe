#include "lower/roll.hpp"

#include <algorithm>

#include "discretise/rounding.hpp"
#include "law/check_law.hpp"
#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

// Vectors with more places than this become loops. Measured for Maxwell elements on an AMD EPYC (Zen 4), g++ 12 -O3,
// each form in a class of its own, the best of 200 chains of 1,000 steps and the lower quartile of 41 ticks after the
// caches were filled with other things. Straight and rolled, in SSE2, AVX2 and AVX-512 registers:
//   8 places:  12 and 14, 13 and 16, 12 and 20 ns in a chain;  1.27 and 1.16, 1.73 and 1.53, 1.43 and 1.25 µs cold
//   16 places: 29 and 16, 18 and 16, 18 and 21 ns;             1.48 and 1.54, 1.60 and 1.60, 1.31 and 1.31 µs
//   32 places: 48 and 21, 46 and 18, 45 and 21 ns;             2.35 and 1.36, 3.39 and 1.55, 2.67 and 1.34 µs
// A servo loop runs with cold caches, so the last figures count, and a loop's code does not grow.
constexpr std::size_t largest_straight_line = 8;

// Partial sums fill four registers: an addition takes two to four cycles, and one can begin in each cycle.
constexpr std::size_t registers_of_sums = 4;

std::size_t lanes_for(VectorRegisters registers, ScalarType scalar) {
  const std::size_t scalar_bytes = scalar == ScalarType::float64 ? 8 : 4;
  return registers_of_sums * std::max<std::size_t>(bytes_of(registers) / scalar_bytes, 1);
}

// The smallest decay a of the modes that an expression advances; empty if it advances none.
std::optional<double> smallest_decay(const UpdateLaw& law, ExpressionId id) {
  std::optional<double> smallest;
  each_expression(law, id, [&](const Expression& e) {
    if (e.operation != Operation::constant) return;
    const Coefficient& c = law.coefficients[e.coefficient];
    if (c.role != ConstantRole::decay && c.role != ConstantRole::loss) return;
    for (double value : c.values)
      smallest = std::min(smallest.value_or(1), c.role == ConstantRole::loss ? 1 - value : value);
  });
  return smallest;
}

// The same value without its guard; nothing if it has no guard of its own.
ExpressionId without_guard(UpdateLaw& law, ExpressionId id) {
  const Expression e = law.expressions[id];
  if (e.operation == Operation::flush) return e.operands[0];
  if (e.operation != Operation::relax) return nothing;
  const ExpressionId decayed = law.expressions.add({Operation::multiply, {e.operands[0], e.operands[1]}});
  return law.expressions.add({Operation::add, {e.operands[2], decayed}});
}

// Lets the guards of the forces take turns: each sample tests as few places as still reach every force in time. If
// every force needs its guard at each sample, nothing changes.
void take_turns(UpdateLaw& law, Statement& statement) {
  const Variable& forces = law.variables[statement.target];
  const std::optional<double> decay = smallest_decay(law, statement.value);
  if (forces.role != Role::state || !forces.is_rolled() || !decay) return;
  const std::size_t lanes = forces.lanes.count, rounds = forces.lanes.padded(forces.size) / lanes;
  const std::size_t samples = samples_without_guard(*decay, law.scalar);
  std::size_t at_once = 1;
  while (at_once < rounds && (rounds % at_once != 0 || rounds / at_once > samples)) ++at_once;
  if (at_once >= rounds) return;
  const ExpressionId unguarded = without_guard(law, statement.value);
  if (unguarded == nothing) return;
  statement.value = unguarded;
  law.guards.push_back({statement.target, at_once * lanes, forces.name + "_turn"});
}

}  // namespace

UpdateLaw rolled(UpdateLaw law, VectorRegisters registers, bool guards_each_sample) {
  const Lanes lanes{lanes_for(registers, law.scalar)};
  for (Variable& variable : law.variables)
    if (variable.size > largest_straight_line) variable.lanes = lanes;
  if (!has_loops(law)) return law;
  for (Coefficient& c : law.coefficients)
    if (c.values.size() > largest_straight_line && !c.is_table()) c.lanes = lanes;
  if (!guards_each_sample)
    for (Statement& statement : law.update) take_turns(law, statement);
  check_law(law, "rolling");
  return law;
}

}  // namespace dashpot::compiler
