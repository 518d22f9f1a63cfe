#include "hertz.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <laws.hpp>

#include "chosen.hpp"

namespace dashpot::paper {
namespace {

constexpr double promised_error = 5e-4;  // of the largest force, printed in networks/README.md

// F (u/d)^p
double curve(double depth) {
  return chosen("hertz.force") * std::pow(depth / chosen("hertz.depth"), chosen("hertz.power"));
}

// b w′², w′² = (p + 1)F/(2k dᵖ) u^(p − 1): of a Kelvin network the form of viscoelastic spheres (Kuwabara & Kono 1987).
double brake(double depth) {
  const double p = chosen("hertz.power");
  const double scale =
      (p + 1) * chosen("hertz.force") / (2 * chosen("hertz.stiffness") * std::pow(chosen("hertz.depth"), p));
  return chosen("hertz.damping") * scale * std::pow(depth, p - 1);
}

Hertz::Rest at_rest(double depth) {
  laws::hertz law;
  law.reset(depth);
  const command<double> now = law.output(depth, 0);
  return {depth, now.force, curve(depth), now.damping, brake(depth)};
}

// G(t)/k of the network.
double relaxation(double time) {
  const double rate = chosen("hertz.relaxing") / chosen("hertz.damper");
  return 1 + chosen("hertz.relaxing") / chosen("hertz.stiffness") * std::exp(-rate * time);
}

// The step is made from the first sample to the second, and so in the mean half a period before that.
Hertz::Step step_to(double depth) {
  constexpr double period = laws::hertz::sample_period;  // printed in the emitted header
  laws::hertz law;
  law.reset(0);
  law.step(0, 0);
  Hertz::Step step{depth, {}, {}, {}};
  const long last = std::lround(chosen("hertz.hold") / period);
  for (long k = 1; k <= last; ++k) {
    const double since = (double(k) - 0.5) * period;
    step.time.push_back(since);
    step.force.push_back(law.step(depth, 0).force);
    step.closed_form.push_back(curve(depth) * relaxation(since));
  }
  return step;
}

template <class Value>
std::vector<double> of_rest(const Hertz& hertz, Value value) {
  std::vector<double> values;
  for (const Hertz::Rest& rest : hertz.rest) values.push_back(value(rest));
  return values;
}

std::vector<double> depths_of(const Hertz& hertz) {
  return of_rest(hertz, [](const Hertz::Rest& rest) { return 1e3 * rest.depth; });
}

constexpr const char* closed_form = "F (u/d)ᵖ, G(t)/k, b w′²";

// Every so many, for markers.
Curve marked(Curve curve, std::size_t apart) {
  Curve few{curve.name, curve.style, {}, {}, curve.maker};
  for (std::size_t i = 0; i < curve.x.size(); i += apart) few.x.push_back(curve.x[i]), few.y.push_back(curve.y[i]);
  return few;
}

std::vector<Curve> step_curves(const Hertz& hertz) {
  std::vector<Curve> curves;
  for (const Hertz::Step& step : hertz.steps) {
    curves.push_back({closed_form, ideal, step.time, step.closed_form, Maker::closed_form});
    curves.push_back(marked({"emitted", emitted, step.time, step.force}, 25));
  }
  return curves;
}

Figure figure_of(const Hertz& hertz) {
  const std::vector<double> depth = depths_of(hertz);
  const auto off = of_rest(
      hertz, [&](const Hertz::Rest& rest) { return 100 * (rest.force - rest.closed_form) / hertz.largest_force(); });
  const double reach = depth.back();
  const auto limit = [&](double sign) {
    return Curve{
        "what is promised", bound, {0, reach}, {100 * sign * promised_error, 100 * sign * promised_error}, Maker::mark};
  };
  const auto force = of_rest(hertz, [](const Hertz::Rest& rest) { return rest.force; });
  const auto wanted = of_rest(hertz, [](const Hertz::Rest& rest) { return rest.closed_form; });
  const auto damping = of_rest(hertz, [](const Hertz::Rest& rest) { return rest.damping; });
  const auto expected = of_rest(hertz, [](const Hertz::Rest& rest) { return rest.damping_expected; });
  return {"A Hertz contact whose tissue relaxes",
          {fmt::format(
               "{} N at {:g} mm, exponent {}, at rest; half of that more at once, which relaxes within {:g} s. 1 kHz.",
               chosen("hertz.force"), 1e3 * chosen("hertz.depth"), chosen("hertz.power"),
               chosen("hertz.damper") / chosen("hertz.relaxing")),
           "Steps are made within a sample, and counted from the middle of it. The closed form: F (u/d)^p at rest,",
           "that times G(t)/k after a step, b w′² for the brake, which grows with the root of the depth."},
          {{"Force at rest",
            "depth [mm]",
            "force [N]",
            {{closed_form, ideal, depth, wanted, Maker::closed_form}, marked({"emitted", emitted, depth, force}, 12)}},
           {"Error of the force at rest",
            "depth [mm]",
            "of the largest force [%]",
            {{"emitted, all depths", dual_channel, depth, off}, limit(1), limit(-1)},
            {},
            Interval{-0.06, 0.06}},
           {"Force after steps", "time [s]", "force [N]", step_curves(hertz)},
           {"Brake",
            "depth [mm]",
            "damping [N·s/m]",
            {{closed_form, ideal, depth, expected, Maker::closed_form},
             marked({"emitted", emitted, depth, damping}, 12)}}}};
}

std::vector<std::string> words_of(const Hertz& hertz) {
  const bool is_met = hertz.static_error() <= promised_error;
  return {
      fmt::format(
          "A law with the static curve u^{} {} it: at rest its force is off by {:.3f} % of the largest at most, where "
          "{:.2f} % is promised. The map behind it is a table of cubics, which is what is left of that.",
          chosen("hertz.power"), is_met ? "keeps to" : "does not keep to", 100 * hertz.static_error(),
          100 * promised_error),
      fmt::format(
          "After a step the whole force relaxes as the network does, at every depth alike: f(u) G(t)/k, to {:.0e} "
          "of it. No test of relaxation can tell that from a quasi-linear law.",
          hertz.step_error()),
      fmt::format(
          "The brake follows the contact: b w′² grows with the root of the depth, as between viscoelastic spheres. "
          "It is off by {:.2f} % of the largest at most, at the tip of the curve, where the root is steepest.",
          100 * hertz.damping_error())};
}

}  // namespace

double Hertz::static_error() const {
  double most = 0;
  for (const Rest& one : rest) most = std::max(most, std::abs(one.force - one.closed_form));
  return most / largest_force();
}

double Hertz::damping_error() const {
  double most = 0;
  for (const Rest& one : rest) most = std::max(most, std::abs(one.damping - one.damping_expected));
  return most / rest.back().damping_expected;
}

double Hertz::step_error() const {
  double most = 0;
  for (const Step& step : steps) {
    const double own = at_rest(step.depth).force;
    for (std::size_t k = 0; k < step.time.size(); ++k)
      most = std::max(most, std::abs(step.force[k] / own - step.closed_form[k] / curve(step.depth)));
  }
  return most;
}

Hertz measure_hertz() {
  Hertz hertz;
  const double points = chosen("hertz.points");
  for (double i = 0; i <= points; ++i) hertz.rest.push_back(at_rest(chosen("hertz.reach") * i / points));
  for (const double depth : chosen_list("hertz.depths")) hertz.steps.push_back(step_to(depth));
  return hertz;
}

Section show(const Hertz& hertz) {
  return {"hertz", "Beyond the paper: a Hertz contact", words_of(hertz), {figure_of(hertz)}, {}};
}

}  // namespace dashpot::paper
