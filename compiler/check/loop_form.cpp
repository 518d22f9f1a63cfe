#include <algorithm>
#include <cmath>
#include <numbers>

#include "check.hpp"

namespace dashpot_check {

Form operator+(Form sum, const Form& other) {
  for (const auto& [name, value] : other)
    if ((sum[name] += value) == 0) sum.erase(name);
  return sum;
}
Form operator*(const Rational& factor, Form form) {
  for (auto& [name, value] : form) value *= factor;
  return factor == 0 ? Form{} : form;
}
Rational of(const Form& form, const std::string& name) { return form.count(name) ? form.at(name) : Rational(0); }

namespace {

Form substituted(const Form& form, const std::map<std::string, Form>& values) {
  Form result;
  for (const auto& [name, value] : form) result = std::move(result) + value * values.at(name);
  return result;
}
std::string displacement(unsigned age) { return "q" + std::to_string(age); }
Form add(LoopForm& loop, const std::string& state, const Form& next) {
  loop.states.push_back(state), loop.next[state] = next;
  return {{state, 1}};
}

// The velocity estimate in terms of the states after the sample; adds those that it has of its own. Its coefficients
// are those of the certificate, which must be what the description says, to the rounding of doubles.
Form estimate(const Device& device, LoopForm& loop) {
  std::size_t at = device.estimator == "foaw" ? device.chosen - 1 : 0;
  const auto coefficient = [&](long double derived, long double off = 1e-13L) {
    const double given = device.estimator_coefficients.at(at++);
    if (std::fabs(given - derived) <= off * std::fabs(derived)) return Rational(given);
    throw Unknown("a coefficient of the estimator is not what its description gives");
  };
  const long double T = device.sample_period;
  const Form arriving = loop.next.at(displacement(device.delay_samples));
  if (device.estimator == "butterworth") {  // sections of two trapezoidal integrators
    const unsigned order = device.order < 4 ? 2 : 4;
    const long double turn = std::numbers::pi_v<long double>, warped = std::tan(turn * (device.cutoff * T));
    Form value = coefficient(1 / T) * arriving;
    const Rational g = coefficient(warped);
    for (unsigned i = 0; i < order / 2; ++i) {
      const long double k = 2 * std::sin(turn * (order - 1 - 2 * i) / (2 * order));
      const std::string band = "band" + std::to_string(i), low = "low" + std::to_string(i);
      const Rational solve = coefficient(1 / (1 + warped * (warped + k))), damped = coefficient(warped + k);
      const Form high = solve * (value + Form{{band, -damped}, {low, -1}}), middle = Form{{band, 1}} + g * high;
      value = Form{{low, 1}} + g * middle;
      add(loop, band, middle + g * high), add(loop, low, value + g * middle);
    }
    return add(loop, "estimate", value);
  }
  if (device.estimator == "kalman") {  // e ← Δ + r² e − T v̂, v̂ ← v̂ + (β/T) e
    const long double L = device.acceleration * T * T * std::sqrt(12.0L) / device.joint_encoder_step;
    const long double r = 4 / (4 + L + std::sqrt(8 * L + L * L)), gain = 2 * (1 - r) * (1 - r) / T;
    const Rational period = coefficient(T), leak = coefficient(r * r), beta = coefficient(gain, 1e-14L / (1 - r));
    const Form innovation = arriving + Form{{"innovation", leak}, {"estimate", -period}};
    return add(loop, "innovation", innovation), add(loop, "estimate", Form{{"estimate", 1}} + beta * innovation);
  }
  if (device.estimator == "interval_difference") {
    if (device.jitter >= device.sample_period) throw Unknown("the estimate may divide by no time at all");
    Form newest = {{"pace", 1}};
    for (unsigned age = 0; age <= device.delay_samples; ++age) newest = add(loop, "pace" + std::to_string(age), newest);
    return newest;
  }
  const bool adapts = device.estimator == "foaw", is_one = device.estimator == "difference of two samples";
  const bool slope = adapts ? device.best_fit : device.estimator == "least_squares";
  if (!adapts && !slope && !is_one && device.estimator != "backward_difference")
    throw Unknown("nothing is known of the estimator " + device.estimator);
  if (adapts && device.amplifier_lag != 0)
    throw Unknown("the window adapts, and the force that lacks is of two windows");
  const unsigned longest = is_one ? 1 : std::max(device.window, 1u), n = adapts ? device.chosen : longest;
  const Rational rate = coefficient((slope ? 6.0L / (n * (n + 1.0L) * (n + 2.0L)) : 1.0L / n) / T);
  Form sum;
  for (unsigned j = 0, age = device.delay_samples; j < longest; ++j, ++age) {
    if (j > 0) add(loop, displacement(age), {{displacement(age - 1), 1}});
    if (j < n) sum[displacement(age)] = rate * (slope ? (j + 1) * (n - j) : 1);
  }
  return sum;
}

}  // namespace

LoopForm loop_form(Program program, const Device& device) {
  if (device.delay_samples > 1000 || device.window > 1000) throw Unknown("more than a thousand samples are remembered");
  auto& next = program.next;
  const auto stays_at_zero = [](const auto& of) { return of.second.size() == of.second.count(of.first); };
  for (auto at = next.begin(); (at = std::find_if(next.begin(), next.end(), stays_at_zero)) != next.end();
       next.erase(at)) {
    program.force.erase(at->first);
    for (auto& [other, form] : next) form.erase(at->first);
  }
  LoopForm loop;
  const std::string drive = displacement(device.delay_samples);
  for (unsigned age = 0; age <= device.delay_samples; ++age)
    add(loop, displacement(age), {{age == 0 ? "w" : displacement(age - 1), 1}});
  const Form last = {{"position", 1}};
  Form sum, all;  // of the states but for a last position, and of what they become
  bool follows = program.force.count("velocity") > 0;
  for (const auto& [state, form] : next) {
    if (form != last) sum[state] = 1, all = std::move(all) + form;
    follows |= form.count("velocity") > 0;
  }
  std::map<std::string, Form> values = {{"position", {{"u", 1}}}};
  if (follows) values["velocity"] = estimate(device, loop);
  for (const std::string& state : program.states) {
    if (next.count(state) == 0) continue;
    if (next[state] == last) values[state] = {{"u", 1}, {drive, -1}};
    else if (!all.count(state) && all == Rational(2) * next[state])
      values[state] = sum + Form{{state, -1}};  // of the rest
    else values[state] = add(loop, state, next[state]);
  }
  for (auto& [state, form] : loop.next)
    if (next.count(state)) form = substituted(form, values);
  loop.force = substituted(program.force, values);
  loop.stiffness = of(loop.force, "u");
  for (unsigned age = 0; age < device.delay_samples; ++age)
    loop.force = loop.force + Form{{displacement(age), -loop.stiffness}};
  loop.force.erase("u");
  if (device.amplifier_lag == 0) return loop;
  values = loop.next, values["w"] = {{"w", 1}};
  add(loop, "lacking", loop.force + Form{{"w", -loop.stiffness}} + Rational(-1) * substituted(loop.force, values));
  return loop;
}

}  // namespace dashpot_check
