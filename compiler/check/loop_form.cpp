#include <cmath>
#include <numbers>
#include <set>

#include "check.hpp"

namespace dashpot_check {
namespace {

Form substituted(const Form& form, const std::map<std::string, Form>& values) {
  Form result;
  for (const auto& [name, value] : form) result = result + value * values.at(name);
  return result;
}

std::string displacement(unsigned age) { return "q" + std::to_string(age); }

// Displacements that the estimate is a sum of, for those that are.
unsigned window_of(const Device& device) {
  const bool is_long = device.estimator == "backward_difference" || device.estimator == "least_squares";
  return is_long && device.window > 1 ? device.window : 1;
}

// The velocity estimate in terms of the states after the sample; adds the states that the estimator has of its own. Its
// coefficients are those that the certificate gives, which must be what the description says, to the rounding of
// doubles.
Form estimate(const Device& device, LoopForm& loop) {
  std::size_t at = 0;
  const auto coefficient = [&](long double derived) {
    const double given = device.estimator_coefficients.at(at++);
    if (!(std::fabs(given - derived) <= 1e-13L * std::fabs(derived)))
      throw Unknown("a coefficient of the estimator is not what its description gives");
    return Rational(given);
  };
  const long double T = device.sample_period;
  const Form arriving = loop.next.at(displacement(device.delay_samples));
  if (device.estimator == "butterworth") {  // sections of two trapezoidal integrators
    const unsigned order = device.order < 4 ? 2 : 4;
    const long double pi = std::numbers::pi_v<long double>, warped = std::tan(pi * device.cutoff * T);
    Form value = coefficient(1 / T) * arriving;
    const Rational g = coefficient(warped);
    for (unsigned i = 0; i < order / 2; ++i) {
      const long double k = 2 * std::sin(pi * (order - 1 - 2 * i) / (2 * order));
      const std::string band = "band" + std::to_string(i), low = "low" + std::to_string(i);
      const Rational solve = coefficient(1 / (1 + warped * (warped + k))), damped = coefficient(warped + k);
      const Form high = solve * (value + Form{{band, -damped}, {low, -1}}), middle = Form{{band, 1}} + g * high;
      value = Form{{low, 1}} + g * middle;
      loop.states.insert(loop.states.end(), {band, low});
      loop.next[band] = middle + g * high;
      loop.next[low] = value + g * middle;
    }
    loop.next["estimate"] = value;
  } else if (device.estimator == "kalman") {  // e ← Δ + r² e − T v̂, v̂ ← v̂ + (β/T) e
    const long double step = device.joint_encoder_step, L = device.acceleration * T * T * std::sqrt(12.0L) / step;
    const long double r = 4 / (4 + L + std::sqrt(8 * L + L * L));
    const Rational period = coefficient(T), leak = coefficient(r * r), gain = coefficient(2 * (1 - r) * (1 - r) / T);
    loop.states.push_back("innovation");
    loop.next["innovation"] = arriving + Form{{"innovation", leak}, {"estimate", -period}};
    loop.next["estimate"] = Form{{"estimate", 1}} + gain * loop.next["innovation"];
  } else {
    const bool slope = device.estimator == "least_squares";
    if (!slope && device.estimator != "difference of two samples" && device.estimator != "backward_difference")
      throw Unknown("nothing is known of the estimator " + device.estimator);
    const unsigned n = window_of(device);
    const Rational rate = coefficient((slope ? 6.0L / (n * (n + 1.0L) * (n + 2.0L)) : 1.0L / n) / T);
    Form sum;
    for (unsigned j = 0; j < n; ++j)
      sum[displacement(device.delay_samples + j)] = rate * (slope ? (j + 1) * (n - j) : 1);
    return sum;
  }
  loop.states.push_back("estimate");
  return {{"estimate", 1}};
}

// The states that the force reads, and those that these read, but for those that stay zero.
std::set<std::string> live_states(const Program& program) {
  std::set<std::string> live;
  for (std::vector<Form> open = {program.force}; !open.empty();) {
    const Form form = open.back();
    open.pop_back();
    for (const auto& [name, value] : form)
      if (program.next.count(name) && !program.next.at(name).empty() && live.insert(name).second)
        open.push_back(program.next.at(name));
  }
  return live;
}

// A state that only adds all others up, for the force, is replaced by them.
void remove_sum(std::map<std::string, Form>& law, Form& force) {
  Form all;
  for (const auto& [state, form] : law) all = all + form;
  for (const auto& [state, form] : law) {
    bool is_sum = law.size() > 1 && all == Rational(2) * form;
    for (const auto& [other, its_form] : law) is_sum = is_sum && its_form.count(state) == 0;
    if (!is_sum) continue;
    const Rational read = of(force, state);
    for (const auto& [other, its_form] : law) force = force + Form{{other, other == state ? Rational(-read) : read}};
    law.erase(state);
    return;
  }
}

}  // namespace

LoopForm loop_form(const Program& program, const Device& device) {
  LoopForm loop;
  std::string last;  // the state that keeps the position
  std::map<std::string, Form> law;
  for (const std::string& state : live_states(program))
    if (program.next.at(state) != Form{{"position", 1}}) law[state] = program.next.at(state);
    else if (!std::exchange(last, state).empty()) throw Unknown("two states keep the position");
  Form force = program.force;
  remove_sum(law, force);

  const std::string drive = displacement(device.delay_samples);
  loop.follows_estimate = force.count("velocity") > 0;
  for (const auto& [state, form] : law) loop.follows_estimate |= form.count("velocity") > 0;
  const unsigned memory = device.delay_samples + (loop.follows_estimate ? window_of(device) : 1);
  if (memory > 1000) throw Unknown("more than a thousand samples are remembered");
  for (unsigned age = 0; age < memory; ++age) {
    loop.states.push_back(displacement(age));
    loop.next[displacement(age)] = {{age == 0 ? "w" : displacement(age - 1), 1}};
  }
  const Form velocity = loop.follows_estimate ? estimate(device, loop) : Form{};
  std::map<std::string, Form> values, answers;  // G in terms of the states, and F − G
  for (const std::string& state : program.states) {
    values[state];
    if (law.count(state) == 0) continue;  // it stays zero, or is not read
    const Rational decay = of(law[state], state), by_step = -of(law[state], last),
                   by_speed = of(law[state], "velocity");
    if (decay != 0)
      answers[state] = Form{{drive, Rational((by_step / decay).convert_to<double>())}} +
                       Rational((by_speed / decay).convert_to<double>()) * velocity;
    values[state] = Form{{state, 1}} + Rational(-1) * answers[state];
    loop.states.push_back(state);
  }
  values["velocity"] = velocity;
  const auto carried_out = [&](Form form, const Rational& at_rest) {
    const Rational by_step = -of(form, last), by_place = of(form, "position");
    if (by_place - by_step != at_rest) throw Unknown("a force depends on where the tool is, not only on how it moves");
    form.erase(last);
    form.erase("position");
    return substituted(form, values) + by_step * Form{{drive, 1}};
  };
  for (const auto& [state, form] : law)
    loop.next[state] = carried_out(form, 0) + substituted(answers[state], loop.next);
  loop.stiffness = of(force, "position") + of(force, last);
  loop.force = carried_out(force, loop.stiffness);
  for (unsigned age = 0; age < device.delay_samples; ++age)
    loop.force = loop.force + Form{{displacement(age), -loop.stiffness}};
  if (device.amplifier_lag > 0) {
    loop.next["w"] = {{"w", 1}};
    loop.next["lacking"] =
        loop.force + Form{{"w", -loop.stiffness}} + Rational(-1) * substituted(loop.force, loop.next);
    loop.states.push_back("lacking");
  }
  return loop;
}

}  // namespace dashpot_check
