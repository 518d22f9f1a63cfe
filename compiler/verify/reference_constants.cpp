#include "verify/reference_constants.hpp"

#include <cmath>
#include <limits>

namespace dashpot::compiler {
namespace {

Reference spring_share(const ReferenceMode& mode, StateInput input) {
  if (input == StateInput::position) return 1;
  return input == StateInput::velocity ? Reference(0) : mode.spring_share;
}

double nearest(const Reference& value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? value.convert_to<double>() : static_cast<double>(value.convert_to<float>());
}

const Reference cancellation_share{"1e-30"};  // share of the whole; anything smaller is left over from rounding

const Reference halfway{"1e-25"};  // relative; two numbers whose distances differ by less are equally near

// 2⁻²⁰⁰ N and 2⁻⁶⁰ N are taken for zero; a constant is zero where its product with them would be subnormal.
double threshold(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-200 : 0x1p-60; }
double smallest(ScalarType scalar) { return scalar == ScalarType::float64 ? 0x1p-822 : 0x1p-66; }

double neighbour(double value, double towards, ScalarType scalar) {
  if (scalar == ScalarType::float64) return std::nextafter(value, towards);
  return static_cast<double>(std::nextafter(static_cast<float>(value), static_cast<float>(towards)));
}

}  // namespace

// exact: a = e^{−x}, c = k (1 − a)/x. backward-euler: a = 1/(1 + x), c = k a. x = λ h; 1 − e^{−x} = 2 e^{−x/2}
// sinh(x/2).
ModeFactors mode_factors(const ReferenceMode& mode, const LawFacts& facts) {
  const Reference x = mode.relaxation_rate / Reference(facts.rate);
  if (facts.scheme == Scheme::backward_euler) return {1 / (1 + x), x / (1 + x), mode.stiffness / (1 + x)};
  const Reference decay = exp(-x);
  const Reference loss = x < Reference(1e-3) ? Reference(2 * exp(-x / 2) * sinh(x / 2)) : Reference(1 - decay);
  return {decay, loss, mode.stiffness * loss / x};
}

Reference energy_weight(const ReferenceMode& mode, const ModeFactors& factors, ScalarType scalar) {
  const double vanishing = scalar == ScalarType::float64 ? 1e-100 : 1e-12;
  return factors.decay < vanishing ? Reference(0) : Reference(1 / (2 * mode.stiffness * factors.decay * factors.decay));
}

Reference companion(const ReferenceForm& form, const LawFacts& facts) {
  Reference g = form.static_stiffness + form.feedthrough_damping * Reference(facts.rate);
  for (const ReferenceMode& mode : form.modes) g += mode_factors(mode, facts).gain;
  return g;
}

std::map<std::string, std::vector<Reference>> reference_constants(const ReferenceForm& form, const LawFacts& facts) {
  const Reference period = 1 / Reference(facts.rate);
  std::map<std::string, std::vector<Reference>> all;
  Reference step = 0, from_velocity = 0;
  for (const ReferenceMode& mode : form.modes) {
    const ModeFactors f = mode_factors(mode, facts);
    const Reference share = spring_share(mode, facts.state_input);
    step += f.gain * share;
    from_velocity += f.gain * (1 - share) * period;
    all["decay"].push_back(f.decay);
    all["loss"].push_back(f.loss);
    all["gain"].push_back(f.decay * f.gain * share);
    all["velocity_drive"].push_back(f.decay * f.gain * (1 - share) * period);
    all["energy_weight"].push_back(energy_weight(mode, f, facts.scalar));
  }
  const double brake = nearest(facts.damping, facts.scalar);
  const bool all_in_brake = nearest(form.feedthrough_damping, facts.scalar) == brake;
  all["sample_period"] = {period};
  all["threshold"] = {Reference(threshold(facts.scalar))};
  all["static_stiffness"] = {form.static_stiffness};
  all["half_static_stiffness"] = {form.static_stiffness / 2};
  all["step_stiffness"] = {step};
  const Reference of_motor = all_in_brake ? Reference(0) : Reference(form.feedthrough_damping - brake),
                  together = of_motor + from_velocity;
  const bool is_left_over = abs(together) <= cancellation_share * abs(from_velocity);  // from cancellation
  all["velocity_gain"] = {is_left_over ? Reference(0) : together};
  all["no_force"] = all["no_energy"] = {0};
  return all;
}

bool is_correctly_rounded(double value, const Reference& exact, ScalarType scalar) {
  if (value == 0) return abs(exact) <= Reference(smallest(scalar));
  if (std::abs(value) < smallest(scalar)) return false;
  const Reference error = abs(Reference(value) - exact) * (1 - halfway);
  for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()})
    if (abs(Reference(neighbour(value, towards, scalar)) - exact) < error) return false;
  return true;
}

}  // namespace dashpot::compiler
