#include "certify/unproved.hpp"

#include <fmt/format.h>

#include <dashpot/estimators/estimator_names.hpp>

namespace dashpot::compiler {

PassivityBound not_proved(std::string reason) {
  PassivityBound bound;
  bound.reason = std::move(reason);
  return bound;
}

std::string not_proved_for(const SampledLoop& loop) {
  return fmt::format("nothing is proved for the estimator {} in the motor", name_of(loop.velocity.estimator));
}

PassivityBound of_a_free_tool(const PassivityBound& bound, const SampledLoop& loop) {
  if (Rational(bound.needed) <= assured_damping(loop, 0)) return bound;
  PassivityBound beyond = not_proved(
      "the brake leaves a free tool alone, so that in the sample of the touch only the device's own damping acts");
  beyond.needed = bound.needed;
  return beyond;
}

}  // namespace dashpot::compiler
