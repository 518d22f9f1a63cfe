#include "lower/begun_at_rest.hpp"

#include "law/evaluate.hpp"

namespace dashpot::compiler {
namespace {

template <class Scalar>
void begin_at_rest(UpdateLaw& law) {
  Evaluation<Scalar> at_first(law);
  if (law.joints) at_first.reset(std::vector<Scalar>(law.joints->positions.size()));
  else at_first.reset();
  for (Variable& variable : law.variables)
    if (variable.is_kept() && variable.size == 1)
      variable.rest_value = at_first.value_of(law.variables.id_of(variable));
}

}  // namespace

UpdateLaw begun_at_rest(UpdateLaw law) {
  if (law.tune.empty() && law.start.empty() && law.rest.empty()) return law;
  law.scalar == ScalarType::float32 ? begin_at_rest<float>(law) : begin_at_rest<double>(law);
  return law;
}

}  // namespace dashpot::compiler
