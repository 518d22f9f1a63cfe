#include "discretise/evaluate.hpp"

namespace dashpot::compiler {

template <class Scalar>
Evaluation<Scalar>::Evaluation(const UpdateLaw& law) : law_(law) {
  for (const Variable& variable : law.variables) variables_.emplace_back(variable.size, Scalar(0));
  for (const Coefficient& coefficient : law.coefficients)
    coefficients_.emplace_back(coefficient.values.begin(), coefficient.values.end());
}

template <class Scalar>
void Evaluation<Scalar>::reset(Scalar position) {
  for (std::vector<Scalar>& variable : variables_) std::fill(variable.begin(), variable.end(), Scalar(0));
  if (law_.rest_position != no_variable) variables_[law_.rest_position][0] = position;
  sampled_ = false;
}

template <class Scalar>
command<Scalar> Evaluation<Scalar>::output(Scalar position, Scalar velocity) {
  variables_[law_.position][0] = position;
  variables_[law_.velocity][0] = velocity;
  run(law_.output);
  const Scalar force = variables_[law_.force][0];
  sampled_ = all_finite(position, velocity, force);
  if (!sampled_) return {static_cast<Scalar>(law_.damping), Scalar(0)};
  run(law_.keep);
  return {static_cast<Scalar>(law_.damping), force};
}

template <class Scalar>
void Evaluation<Scalar>::update() {
  if (!sampled_) return;
  sampled_ = false;
  run(law_.update);
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
  return variables_[law_.stored][0];
}

template <class Scalar>
void Evaluation<Scalar>::run(const std::vector<Statement>& program) {
  for (const Statement& statement : program) {
    std::vector<Scalar>& target = variables_[statement.target];
    for (std::size_t place = 0; place < target.size(); ++place) target[place] = value(statement.value, place);
  }
}

template <class Scalar>
Scalar Evaluation<Scalar>::value(ExpressionId id, std::size_t place) const {
  const auto at = [place](const std::vector<Scalar>& vector) { return vector[vector.size() == 1 ? 0 : place]; };
  const Expression& expression = law_.expressions[id];
  switch (expression.operation) {
    case Operation::read: return at(variables_[expression.left]);
    case Operation::constant: return at(coefficients_[expression.left]);
    case Operation::add: return value(expression.left, place) + value(expression.right, place);
    case Operation::subtract: return value(expression.left, place) - value(expression.right, place);
    case Operation::multiply: return value(expression.left, place) * value(expression.right, place);
    case Operation::flush:
      return flush_below(static_cast<Scalar>(law_.flush_threshold), value(expression.left, place));
    case Operation::clamp: return clamp_to(value(expression.right, place), value(expression.left, place));
    case Operation::where:
      return value(expression.condition, place) > 0 ? value(expression.left, place) : value(expression.right, place);
    case Operation::sum: return sum(expression.left);
  }
  return Scalar(0);
}

// Partial sums in turn, then those in order; one lane is the plain sum from the first to the last.
template <class Scalar>
Scalar Evaluation<Scalar>::sum(ExpressionId id) const {
  const std::vector<Scalar>& vector = variables_[law_.expressions[id].left];
  if (law_.lanes == 1) {
    Scalar total = vector[0];
    for (std::size_t i = 1; i < vector.size(); ++i) total += vector[i];
    return total;
  }
  std::vector<Scalar> lanes(law_.lanes, Scalar(0));
  for (std::size_t i = 0; i < vector.size(); ++i) lanes[i % law_.lanes] += vector[i];
  Scalar total = lanes[0];
  for (std::size_t i = 1; i < lanes.size(); ++i) total += lanes[i];
  return total;
}

template class Evaluation<float>;
template class Evaluation<double>;

}  // namespace dashpot::compiler
