#include <cmath>
#include <numbers>

#include "check.hpp"

namespace dashpot_check {
namespace {

std::string displacement(unsigned age) { return "q" + std::to_string(age); }

Form substituted(const Form& form, const std::map<std::string, Form>& values) {
  Form result;
  for (const auto& [name, value] : form) result = result + value * values.at(name);
  return result;
}

// The velocity estimate in terms of the states after the sample; adds those that it has of its own. Its coefficients
// are those of the certificate, which must be what the description says, to the rounding of doubles.
Form estimate(const Device& device, LoopForm& loop) {
  std::size_t at = 0;
  const auto coefficient = [&](long double derived, long double off = 1e-13L) {
    const double given = device.estimator_coefficients.at(at++);
    if (!(std::fabs(given - derived) <= off * std::fabs(derived)))
      throw Unknown("a coefficient of the estimator is not what its description gives");
    return Rational(given);
  };
  const auto keep = [&](const std::string& state, const Form& next) {
    loop.states.push_back(state), loop.next[state] = next;
    return Form{{state, 1}};
  };
  const long double T = device.sample_period;
  const Form arriving = loop.next.at(displacement(device.delay_samples));
  if (device.estimator == "butterworth") {  // sections of two trapezoidal integrators
    const unsigned order = device.order < 4 ? 2 : 4;
    const long double turn = std::numbers::pi_v<long double>,
                      warped = std::tan(turn * (device.cutoff * device.sample_period));
    Form value = coefficient(1 / T) * arriving;
    const Rational g = coefficient(warped);
    for (unsigned i = 0; i < order / 2; ++i) {
      const long double k = 2 * std::sin(turn * (order - 1 - 2 * i) / (2 * order));
      const std::string band = "band" + std::to_string(i), low = "low" + std::to_string(i);
      const Rational solve = coefficient(1 / (1 + warped * (warped + k))), damped = coefficient(warped + k);
      const Form high = solve * (value + Form{{band, -damped}, {low, -1}}), middle = Form{{band, 1}} + g * high;
      value = Form{{low, 1}} + g * middle;
      keep(band, middle + g * high), keep(low, value + g * middle);
    }
    return keep("estimate", value);
  }
  if (device.estimator == "kalman") {  // e ← Δ + r² e − T v̂, v̂ ← v̂ + (β/T) e
    const long double L = device.acceleration * T * T * std::sqrt(12.0L) / device.joint_encoder_step;
    const long double r = 4 / (4 + L + std::sqrt(8 * L + L * L));
    const Rational period = coefficient(T), leak = coefficient(r * r),
                   gain = coefficient(2 * (1 - r) * (1 - r) / T, 1e-14L / (1 - r));
    const Form innovation = arriving + Form{{"innovation", leak}, {"estimate", -period}};
    return keep("innovation", innovation), keep("estimate", Form{{"estimate", 1}} + gain * innovation);
  }
  const bool adapts = device.estimator == "foaw", is_mean = device.estimator == "backward_difference";
  const bool slope = adapts ? device.best_fit : device.estimator == "least_squares";
  if (!adapts && !slope && !is_mean && device.estimator != "difference of two samples")
    throw Unknown("nothing is known of the estimator " + device.estimator);
  if (adapts && device.amplifier_lag != 0)  // the force that is lacking is of two windows
    throw Unknown("the window adapts, and the amplifier lags");
  const unsigned longest = adapts || slope || is_mean ? std::max(device.window, 1u) : 1;
  const unsigned n = adapts ? device.chosen : longest;
  at = adapts ? n - 1 : 0;
  const Rational rate = coefficient((slope ? 6.0L / (n * (n + 1.0L) * (n + 2.0L)) : 1.0L / n) / T);
  Form sum;
  for (unsigned j = 0, age = device.delay_samples; j < longest; ++j, ++age) {
    if (j > 0) keep(displacement(age), {{displacement(age - 1), 1}});
    if (j < n) sum[displacement(age)] = rate * (slope ? (j + 1) * (n - j) : 1);
  }
  return sum;
}

}  // namespace

LoopForm loop_form(Program program, const Device& device) {
  for (auto at = program.next.begin(); at != program.next.end();) {  // what stays at zero is left out
    if (at->second.size() != at->second.count(at->first)) {
      ++at;
      continue;
    }
    program.force.erase(at->first);
    for (auto& [other, form] : program.next) form.erase(at->first);
    program.next.erase(at), at = program.next.begin();
  }
  if (device.delay_samples > 1000 || device.window > 1000) throw Unknown("more than a thousand samples are remembered");
  LoopForm loop;
  const std::string drive = displacement(device.delay_samples);
  for (unsigned age = 0; age <= device.delay_samples; ++age) {
    loop.states.push_back(displacement(age));
    loop.next[displacement(age)] = {{age == 0 ? "w" : displacement(age - 1), 1}};
  }
  std::map<std::string, Form> values = {{"position", {{"u", 1}}}};
  Form all, sum;
  bool follows = program.force.count("velocity") > 0;
  std::vector<std::string> own;
  for (const std::string& state : program.states) {
    if (program.next.count(state) == 0 || state.rfind("sampled_", 0) == 0)
      continue;  // the latter are for update() alone
    const Form& next = program.next.at(state);
    const bool is_place = next == Form{{"position", 1}};
    values[state] = is_place ? Form{{"u", 1}, {drive, -1}} : Form{{state, 1}};
    if (!is_place) own.push_back(state), all = all + next, sum = sum + values[state];
    follows |= next.count("velocity") > 0;
  }
  if (follows) values["velocity"] = estimate(device, loop);
  loop.states.insert(loop.states.end(), own.begin(), own.end());
  std::erase_if(loop.states, [&](const std::string& state) {  // that only adds all others up: replaced by them
    if (!program.next.count(state) || all.count(state) || all != Rational(2) * program.next.at(state)) return false;
    values[state] = sum + Form{{state, -1}};
    return true;
  });
  for (const std::string& state : loop.states)
    if (program.next.count(state)) loop.next[state] = substituted(program.next.at(state), values);
  loop.force = substituted(program.force, values);
  loop.stiffness = of(loop.force, "u");
  loop.force.erase("u");
  for (unsigned age = 0; age < device.delay_samples; ++age)
    loop.force = loop.force + Form{{displacement(age), -loop.stiffness}};
  if (device.amplifier_lag == 0) return loop;
  loop.next["w"] = {{"w", 1}};
  loop.next["lacking"] = loop.force + Form{{"w", -loop.stiffness}} + Rational(-1) * substituted(loop.force, loop.next);
  loop.states.push_back("lacking");
  return loop;
}

Rational hold_stiffness(const LoopForm& loop, const Device& device) {
  const std::string drive = displacement(device.delay_samples);
  Rational sum = loop.stiffness / 2, left = of(loop.force, drive);
  if (device.amplifier_lag != 0 || loop.stiffness < 0) throw Unknown("the amplifier lags, or the spring pushes");
  for (std::size_t i = device.delay_samples + 1; i < loop.states.size(); ++i) {
    const Form& next = loop.next.at(loop.states[i]);
    const Rational a = of(next, loop.states[i]), d = of(next, drive);
    if (next.size() != (a == 0 ? 1u : 2u) || a < 0 || a >= 1 || d <= 0 || of(loop.force, loop.states[i]) != 1)
      throw Unknown("'" + loop.states[i] + "' is not a mode that relaxes and that position alone drives");
    sum += a == 0 ? d : Rational(d / (a + a * a)), left -= a == 0 ? Rational(0) : Rational(d / a);
  }
  return (sum + abs(left)) * (1 + 2 * device.delay_samples);
}

}  // namespace dashpot_check
