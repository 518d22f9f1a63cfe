#include "law/add_damping.hpp"

#include <algorithm>
#include <vector>

#include "law/check_law.hpp"

namespace dashpot::compiler {

UpdateLaw with_steady_damping(UpdateLaw law, double damping) {
  const auto raise = [&](double& value) {
    value = law.scalar == ScalarType::float64 ? value + damping : double(float(value) + float(damping));
  };
  const auto steady = std::find_if(law.coefficients.begin(), law.coefficients.end(),
                                   [](const Coefficient& c) { return c.role == ConstantRole::steady_damping; });
  if (steady != law.coefficients.end()) {
    raise(steady->values.front());
  } else {
    const CoefficientId added = law.coefficients.add({"steady_damping",
                                                      law.variables[law.brake].unit,
                                                      "of what no slip changes",
                                                      {damping},
                                                      {},
                                                      ConstantRole::steady_damping});
    const ExpressionId constant = law.expressions.add({Operation::constant, {}, {}, added});
    for (std::vector<Statement>* program : {&law.output, &law.rest})
      for (Statement& told : *program)
        if (told.target == law.brake || told.target == law.last_brake)
          told.value = law.expressions.add({Operation::add, {told.value, constant}});
  }
  for (double* value : {&law.damping, &law.largest_damping, &law.variables[law.last_brake].rest_value}) raise(*value);
  check_law(law, "adding damping");
  return law;
}

}  // namespace dashpot::compiler
