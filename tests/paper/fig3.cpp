#include "fig3.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "chosen.hpp"
#include "claims.hpp"
#include "decompose/spectrum.hpp"
#include "evaluated_law.hpp"

namespace dashpot::paper {
namespace {

using std::numbers::pi;
constexpr double usual_delay = 5e-3;  // of Fig. 6, as printed [s]
constexpr double slow = 0.5;          // of Fig. 6, as printed [Hz]

std::string network_of(const KelvinPair& p) {
  return fmt::format(R"({{ "dashpot": 1, "name": "pair", "motion": "translation", "network": {{ "series": [
      {{ "parallel": [ {{ "spring": {} }}, {{ "damper": {} }} ] }},
      {{ "parallel": [ {{ "spring": {} }}, {{ "damper": {} }} ] }} ] }} }})",
                     p.K1, p.B1, p.K2, p.B2);
}

// The canonical form with the spring shares of the realisation whose first element is at the tool.
compiler::LinearForm form_of(const KelvinPair& pair) {
  return compiler::linear_form(compiled(network_of(pair), {})->network);
}

// b + what position drives + what the estimate drives, late by `delay`.
std::complex<double> felt(const compiler::LinearForm& form, double brake, compiler::StateInput input, double delay,
                          double omega) {
  const compiler::MotorImpedance motor = compiler::motor_impedance(form, brake, input, omega);
  return brake + motor.position_driven + motor.velocity_driven * std::polar(1.0, -omega * delay);
}

// Frequencies from 0.01 Hz to 3 kHz, a hundred a decade.
std::vector<double> frequencies(double end) {
  std::vector<double> all;
  for (double f = 0.01; f <= end; f *= std::pow(10, 0.01)) all.push_back(2 * pi * f);
  return all;
}

double missing_damping(const compiler::LinearForm& form, double brake, compiler::StateInput input, double delay,
                       double brake_error) {
  double least = 0;
  for (const double omega : frequencies(3000))
    least = std::min(least, felt(form, brake, input, delay, omega).real() - brake_error * brake);
  return std::abs(least);
}

double error_at(const compiler::LinearForm& form, double brake, compiler::StateInput input, double delay,
                double omega) {
  const std::complex<double> truth = compiler::viscous_impedance(form, omega);
  const std::complex<double> whole =
      truth + compiler::to_double(form.static_stiffness) / std::complex<double>(0, omega);
  return std::abs(felt(form, brake, input, delay, omega) - truth) / std::abs(whole);
}

double largest_error(const compiler::LinearForm& form, double brake, compiler::StateInput input, double delay) {
  double largest = 0;
  for (const double omega : frequencies(chosen("fig3.band_end")))
    largest = std::max(largest, error_at(form, brake, input, delay, omega));
  return largest;
}

Observer observer(const std::string& name, const compiler::LinearForm& form, double brake, compiler::StateInput input,
                  const std::vector<double>& delays) {
  Observer result{name, brake, {}, {}, {}, {}};
  for (const double delay : delays) {
    result.missing.push_back(missing_damping(form, brake, input, delay, 0));
    result.missing_when_short.push_back(missing_damping(form, brake, input, delay, rig().description.brake.tolerance));
    result.error.push_back(largest_error(form, brake, input, delay));
    result.slow_error.push_back(error_at(form, brake, input, delay, 2 * pi * slow));
  }
  return result;
}

KelvinPair swapped(const KelvinPair& p) { return {p.K2, p.B2, p.K1, p.B1}; }

std::vector<Observer> observers_of(const KelvinPair& pair, const std::vector<double>& delays) {
  const auto nodal = compiler::StateInput::nodal;
  const compiler::LinearForm first = form_of(pair), second = form_of(swapped(pair));
  return {
      observer("element 1 observed, b = B1", first, pair.B1, nodal, delays),
      observer("element 2 observed, b = B2", second, pair.B2, nodal, delays),
      observer("b = Z_d(0), driven by velocity", first, compiler::to_double(compiler::zero_frequency_damping(first)),
               compiler::StateInput::velocity, delays),
      observer("single motor, element 1 observed", first, 0, nodal, delays)};
}

KelvinPair chosen_pair(const char* name) {
  const std::vector<double> values = chosen_list(name);
  return {values.at(0), values.at(1), values.at(2), values.at(3)};
}

KelvinPair random_pair(std::mt19937_64& generator) {
  const auto decade = [&](double from, double decades) {
    return from * std::pow(10, decades * static_cast<double>(generator() >> 11) * 0x1p-53);
  };
  const double K = chosen("fig3.least_stiffness"), B = chosen("fig3.least_damping"), wide = chosen("fig3.decades");
  const double K1 = decade(K, wide), B1 = decade(B, wide), K2 = decade(K, wide);
  return {K1, B1, K2, decade(B, wide)};
}

void count(Fig3::Poll& poll, const Observer& chosen, const Observer& other) {
  constexpr double noticeable = 1e-9;
  const auto is_as_good = [&](const std::vector<double> Observer::*figure) {
    return (chosen.*figure)[0] <= (other.*figure)[0] + noticeable;
  };
  ++poll.pairs;
  poll.less_missing += is_as_good(&Observer::missing);
  poll.less_missing_when_short += is_as_good(&Observer::missing_when_short);
  poll.less_error += is_as_good(&Observer::error);
  poll.less_slow_error += is_as_good(&Observer::slow_error);
}

std::vector<Fig3::Poll> ask_random_pairs() {
  Fig3::Poll by_share{"the larger share, B/K²"}, by_damping{"the larger damping, B"},
      by_little{"the smaller damping, B"};
  std::mt19937_64 generator(2009);
  for (double i = 0; i < chosen("fig3.pairs"); ++i) {
    const KelvinPair pair = random_pair(generator);
    const std::vector<Observer> both = observers_of(pair, {usual_delay});
    const std::size_t share = pair.share(1) >= pair.share(2) ? 0 : 1, damping = pair.B1 >= pair.B2 ? 0 : 1;
    count(by_share, both[share], both[1 - share]);
    count(by_damping, both[damping], both[1 - damping]);
    count(by_little, both[1 - damping], both[damping]);
  }
  return {by_share, by_damping, by_little};
}

constexpr Style style_of[] = {{"#c1440e", 1.8}, {"#0b5fa5", 1.8}, {"#2f8f5b", 1.4, "6 3"}, {"#1a1a1a", 1.2, "2 3"}};

Panel panel(const Fig3& fig3, const Fig3::Case& each, bool error) {
  Panel panel{each.title,
              "delay of the estimate [ms]",
              error ? "error below 5 Hz [%]" : "missing damping [N·s/m]",
              {},
              {},
              {},
              Scale::linear,
              Scale::linear,
              false};
  for (std::size_t i = 0; i < each.observers.size(); ++i) {
    Curve curve{each.observers[i].name, style_of[i], {}, {}, Maker::analysis};
    for (std::size_t k = 0; k < fig3.delays.size(); ++k) {
      curve.x.push_back(fig3.delays[k] * 1e3);
      curve.y.push_back(error ? 100 * each.observers[i].error[k] : each.observers[i].missing[k]);
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

std::string values(const KelvinPair& p) {
  return fmt::format("K1 = {}, K2 = {} N/m, B1 = {}, B2 = {} N·s/m", p.K1, p.K2, p.B1, p.B2);
}

std::size_t sample_of(const Fig3& fig3, double delay) {
  return static_cast<std::size_t>(std::find(fig3.delays.begin(), fig3.delays.end(), delay) - fig3.delays.begin());
}

Table table_of(const Fig3& fig3) {
  Table table{"At a delay of 5 ms",
              {"pair", "observed", "b [N·s/m]", "share B/K²", "missing [N·s/m]", "brake 5 % short [N·s/m]",
               "error below 5 Hz [%]", "at 0.5 Hz [%]"},
              {}};
  const std::size_t k = sample_of(fig3, usual_delay);
  for (const Fig3::Case& each : fig3.cases)
    for (std::size_t i = 0; i < each.observers.size(); ++i) {
      const Observer& o = each.observers[i];
      table.rows.push_back({values(each.pair), o.name, fmt::format("{:.3g}", o.brake),
                            i < 2 ? fmt::format("{:.3g}", each.pair.share(static_cast<int>(i) + 1)) : "",
                            fmt::format("{:.4g}", o.missing[k]), fmt::format("{:.4g}", o.missing_when_short[k]),
                            fmt::format("{:.4g}", 100 * o.error[k]), fmt::format("{:.4g}", 100 * o.slow_error[k])});
    }
  return table;
}

std::vector<std::string> words_of(const Fig3& fig3) {
  constexpr double rounding = 1e-9;  // [N·s/m]
  double most = 0;                   // that any observer with an exact brake lacks at any delay [N·s/m]
  for (const Fig3::Case& each : fig3.cases)
    for (std::size_t observed = 0; observed < 2; ++observed)
      most = std::max(
          most, *std::max_element(each.observers[observed].missing.begin(), each.observers[observed].missing.end()));
  const Fig3::Poll &share = fig3.polls[0], &damping = fig3.polls[1], &little = fig3.polls[2];
  const Fig3::Case &equal = fig3.cases[0], &unequal = fig3.cases[2];
  const double by_damping = damping.share(&Fig3::Poll::less_error), by_share = share.share(&Fig3::Poll::less_error);
  const double slow_share = share.share(&Fig3::Poll::less_slow_error);
  const std::size_t k = sample_of(fig3, usual_delay);
  return {
      fmt::format(
          "With an exact brake {} What separates them in the paper’s “numerical tests”, passivity, {} separate them "
          "here. With a brake that is 5 % short, the observer of the smaller damping needs no more than the other in "
          "{:.1f} % of random pairs.",
          most < rounding ? "every observer is passive under any delay."
                          : fmt::format("an observer lacks up to {:.3g} N·s/m.", most),
          most < rounding ? "does not" : "does", 100 * little.share(&Fig3::Poll::less_missing_when_short)),
      fmt::format(
          "Which one errs less below 5 Hz at 5 ms? The larger damping, which the paper’s words suggest, in {:.0f} % of "
          "random pairs; the larger share of the slow dissipation, B/K², in {:.0f} % (at 0.5 Hz {:.0f} %); the smaller "
          "damping in {:.0f} %. So the paper’s rule {}, and that of the share {} for fast motion, {} for slow. Where a "
          "soft, lightly damped element carries the motion (last pair, 0.5 Hz) element 1 errs by {:.2g} %, element 2 "
          "by "
          "{:.2g} %.",
          100 * by_damping, 100 * by_share, 100 * slow_share, 100 * little.share(&Fig3::Poll::less_error),
          outcome(by_damping > 0.5), outcome(by_share > 0.5), outcome(slow_share > 0.5),
          100 * unequal.observers[0].slow_error[k], 100 * unequal.observers[1].slow_error[k]),
      fmt::format(
          "Equal elements are one element of half the stiffness and damping. Observed singly, b = B is {:.3g} times "
          "the "
          "network’s own viscosity and errs by {:.1f} %; merged first, as dashpot does, b = B/2 errs by {:.1g} %.",
          equal.observers[0].brake / equal.observers[2].brake, 100 * equal.observers[0].error[k],
          100 * equal.observers[2].error[k])};
}

}  // namespace

double KelvinPair::share(int element) const { return element == 1 ? B1 / (K1 * K1) : B2 / (K2 * K2); }

Fig3 measure_fig3() {
  Fig3 fig3;
  for (int i = 0; i <= chosen("fig3.longest_delay"); ++i) fig3.delays.push_back(i * 1e-3);
  fig3.cases = {{"Equal elements", chosen_pair("fig3.equal"), {}},
                {"Damping differs", chosen_pair("fig3.damping_differs"), {}},
                {"Stiff and damped, soft and free", chosen_pair("fig3.unequal"), {}}};
  for (Fig3::Case& each : fig3.cases) each.observers = observers_of(each.pair, fig3.delays);
  fig3.polls = ask_random_pairs();
  return fig3;
}

const Fig3& measured_fig3() {
  static const Fig3 measured = measure_fig3();
  return measured;
}

Section show(const Fig3& fig3) {
  Figure figure{"Fig. 3: which of two Kelvin elements in series to observe", {}, {}};
  for (const Fig3::Case& each : fig3.cases) {
    figure.panels.push_back(panel(fig3, each, false));
    figure.panels.push_back(panel(fig3, each, true));
    figure.caption.push_back(each.title + ": " + values(each.pair));
  }
  Table polls{
      fmt::format("Of {} random pairs over {} decades, at 5 ms: how often the rule’s observer is the better one",
                  chosen("fig3.pairs"), chosen("fig3.decades")),
      {"observed", "needs no more damping", "brake 5 % short", "no larger error below 5 Hz", "at 0.5 Hz"},
      {}};
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100 * share); };
  for (const Fig3::Poll& poll : fig3.polls)
    polls.rows.push_back({poll.rule, percent(poll.share(&Fig3::Poll::less_missing)),
                          percent(poll.share(&Fig3::Poll::less_missing_when_short)),
                          percent(poll.share(&Fig3::Poll::less_error)),
                          percent(poll.share(&Fig3::Poll::less_slow_error))});
  return {"fig3", "Fig. 3: which element to observe", words_of(fig3), {figure}, {table_of(fig3), polls}};
}

}  // namespace dashpot::paper
