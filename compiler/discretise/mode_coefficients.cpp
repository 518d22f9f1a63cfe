#include "discretise/mode_coefficients.hpp"

#include <boost/math/special_functions/expm1.hpp>

namespace dashpot::compiler {

ModeCoefficients mode_coefficients(const Mode& mode, Scheme scheme, StateInput input, const Real& sample_period) {
  const Real x = mode.relaxation_rate * sample_period;
  const bool exact = scheme == Scheme::exact;
  const Real loss = exact ? Real(-boost::math::expm1(Real(-x))) : Real(x / (1 + x));
  const Real gain = exact ? Real(mode.stiffness * loss / x) : Real(mode.stiffness / (1 + x));
  const Real decay = exact ? Real(exp(-x)) : Real(1 / (1 + x));
  const Real spring_share = input == StateInput::position   ? Real(1)
                            : input == StateInput::velocity ? Real(0)
                                                            : mode.spring_share;
  return {decay, loss, gain * spring_share, gain * (1 - spring_share) * sample_period};
}

Real companion_stiffness(const LinearForm& form, Scheme scheme, const Real& sample_period) {
  Real g = form.static_stiffness + form.feedthrough_damping / sample_period;
  for (const Mode& mode : form.modes)
    g += mode_coefficients(mode, scheme, StateInput::position, sample_period).position_gain;
  return g;
}

}  // namespace dashpot::compiler
