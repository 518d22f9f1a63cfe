#include "curl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <laws.hpp>

#include "chosen.hpp"

namespace dashpot::paper {
namespace {

using std::numbers::pi;

// The same field as the emitted law's with brakes on the joints, [[p, r + σ], [r − σ, s]] with p = s = b l², and no
// gate.
class WithoutGate {
 public:
  void reset(const double (&)[2]) noexcept {}
  ArmCommand output(const double (&q)[2], const double (&v)[2]) const noexcept {
    const double apart = q[1] - q[0], r = damping_ * std::cos(apart), turning = -turning_ * std::sin(apart);
    return {{damping_, damping_}, {(r + turning) * v[1], (r - turning) * v[0]}};
  }
  void update() noexcept {}

 private:
  double area_ = chosen("arm.link") * chosen("arm.link");
  double damping_ = chosen("curl.damping") * area_, turning_ = chosen("curl.turning") * area_;
};

// A late estimate gives most where all of the lateness is a quarter of a turn: delay, half of the window, half of a
// hold.
double lateness() { return (chosen("curl.delay") + chosen("curl.window") / 2 + 0.5) / chosen("arm.rate"); }
double frequency() { return 1 / (4 * lateness()); }

// γ of the estimate and the hold at that frequency.
double gain() {
  const auto sinc = [](double x) { return std::sin(x) / x; };
  const double turn = 2 * pi * frequency() / chosen("arm.rate");  // a sample
  return sinc(turn * chosen("curl.window") / 2) * sinc(turn / 2);
}

// Both joints a quarter of a turn apart.
simulated::arm_scenario circles_at(double angle) {
  simulated::arm_scenario scene;
  scene.gain = simulated::brake_gain::lowest;
  const double half = angle * pi / 360, rate = 2 * pi * frequency(), speed = chosen("curl.rate"), size = speed / rate;
  scene.prescribed = [=](double time) -> simulated::joints_motion {
    const double c = std::cos(rate * time), s = std::sin(rate * time);
    return {{pi / 2 - half - size * c, pi / 2 + half + size * s}, {speed * s, speed * c}};
  };
  return scene;
}

// σ of what the law passes: with both joints at 1 rad/s, told where the gate has opened, the torques are r ± σ.
double turning_of(double angle) {
  laws::curl law;
  const double half = angle * pi / 360, q[2] = {pi / 2 - half, pi / 2 + half}, v[2] = {1, 1};
  law.reset(q);
  ArmCommand now{};
  for (double time = 0; time < chosen("curl.duration"); time += laws::curl::sample_period) now = law.step(q, v);
  return (now.torque[0] - now.torque[1]) / 2;
}

Curl::Place place_at(const arm_description& arm, double angle) {
  const simulated::arm_scenario scene = circles_at(angle);
  const double end = chosen("curl.duration"), from = chosen("curl.settled"), speed = chosen("curl.rate");
  const double area = chosen("arm.link") * chosen("arm.link"), full = chosen("curl.damping") * area * speed * speed;
  Curl::Place place{angle, run<laws::curl>(arm, scene, end), run<WithoutGate>(arm, scene, end), 0, 0, 0, 0, 0};
  place.gated_power = mean_power(place.gated, from, end) / full;
  place.ungated_power = mean_power(place.ungated, from, end) / full;
  const double turning = chosen("curl.turning") * area * std::sin(angle * pi / 180);
  place.passed = std::abs(turning_of(angle)) / turning;
  place.wanted = turning / (chosen("curl.damping") * area);
  place.expected = 1 - chosen("curl.tolerance") / 100 - gain() * place.wanted;
  return place;
}

template <class Value>
Curve over_angle(const Curl& curl, const char* name, const Style& style, Maker maker, Value value) {
  Curve curve{name, style, {}, {}, maker};
  for (const Curl::Place& place : curl.places) curve.x.push_back(place.angle), curve.y.push_back(value(place));
  return curve;
}

constexpr const char* with_gate = "dashpot, behind its gate";
constexpr const char* without_gate = "without a gate";

std::vector<Curve> energies(const Curl::Place& place) {
  std::vector<Curve> curves{{without_gate, single_motor, {}, {}, Maker::by_hand}, {with_gate, dual_channel, {}, {}}};
  for (const ArmSample& s : place.ungated) curves[0].x.push_back(s.time), curves[0].y.push_back(1e3 * s.taken);
  for (const ArmSample& s : place.gated) curves[1].x.push_back(s.time), curves[1].y.push_back(1e3 * s.taken);
  return curves;
}

Figure figure_of(const Curl& curl) {
  const std::vector<double> drawn = chosen_list("curl.drawn");
  const double first = curl.places.front().angle, last = curl.places.back().angle;
  const Interval angles{40, 140}, whole{0, chosen("curl.duration")};
  std::vector<Curve> powers{
      over_angle(curl, "1 − ε − γ|σ|/p", ideal, Maker::closed_form, [](const Curl::Place& p) { return p.expected; }),
      over_angle(curl, without_gate, emitted_euler, Maker::by_hand,
                 [](const Curl::Place& p) { return p.ungated_power; }),
      over_angle(curl, with_gate, emitted, Maker::emitted, [](const Curl::Place& p) { return p.gated_power; })};
  std::vector<Curve> turned{
      over_angle(curl, without_gate, single_motor, Maker::by_hand, [](const Curl::Place& p) { return p.wanted; }),
      over_angle(curl, with_gate, emitted, Maker::emitted, [](const Curl::Place& p) { return p.passed * p.wanted; }),
      {"all that the brakes pay for",
       bound,
       {first, last},
       {1 - chosen("curl.tolerance") / 100, 1 - chosen("curl.tolerance") / 100},
       Maker::mark}};
  return {
      "A viscous field that turns the tool, at the edge of its gate",
      {fmt::format(
           "b = {:g} N·s/m, and {:g} aside, links of {:g} mm; 1 kHz, {:g} samples of delay, brakes {:g} % short.",
           chosen("curl.damping"), chosen("curl.turning"), 1e3 * chosen("arm.link"), chosen("curl.delay"),
           chosen("curl.tolerance")),
       fmt::format(
           "Both joints swing by {:g} rad/s at {:.0f} Hz, a quarter of a turn apart, where late estimates give most.",
           chosen("curl.rate"), frequency()),
       "Power and energy: what motors and brakes take from the hand; below zero they give it."},
      {{"Power taken, of the joints’ own", "angle between links [deg]", "share [1]", powers, angles},
       {"Curl, of the joints’ damping", "angle between links [deg]", "|σ|/p [1]", turned, angles},
       {fmt::format("Energy inside, links {:g}° apart", drawn[0]), "time [s]", "energy [mJ]",
        energies(curl.at(drawn[0])), whole},
       {fmt::format("Energy beyond, links {:g}° apart", drawn[1]), "time [s]", "energy [mJ]",
        energies(curl.at(drawn[1])), whole}}};
}

std::vector<std::string> words_of(const Curl& curl) {
  double lowest = curl.places[0].gated_power, lowest_without = curl.places[0].ungated_power;
  double from = 0;
  for (const Curl::Place& place : curl.places) {
    lowest = std::min(lowest, place.gated_power), lowest_without = std::min(lowest_without, place.ungated_power);
    if (from == 0 && place.passed < 1 - 1e-9) from = place.angle;
  }
  return {
      fmt::format(
          "A curl takes no power by itself; from a late estimate it gives some, for one way round. Without a gate it "
          "{} up to {:.2f} of the power that the brakes’ damping takes at its full value; behind dashpot’s gate it "
          "{} energy: {:.2f} of that are still taken where it is least.",
          lowest_without < 0 ? "gives" : "leaves", std::abs(lowest_without), lowest >= 0 ? "never gives" : "gives",
          lowest),
      fmt::format(
          "The whole curl passes where |σ| is at most {:.1f} % of the joints’ damping p. From {:g}° on, where the arm "
          "makes more of it, the gate holds it there. The brakes pay for {:g} %; the gate keeps the difference for "
          "limits that grow while the arm moves.",
          100 * curl.limit, from, 100 - chosen("curl.tolerance"))};
}

}  // namespace

const Curl::Place& Curl::at(double angle) const {
  for (const Place& place : places)
    if (place.angle == angle) return place;
  throw std::out_of_range(fmt::format("{} degrees", angle));
}

Curl measure_curl() {
  Curl curl;
  const arm_description arm = arm_of("curl_arm");
  for (const double angle : chosen_list("curl.angles")) curl.places.push_back(place_at(arm, angle));
  for (const Curl::Place& place : curl.places) curl.limit = std::max(curl.limit, place.passed * place.wanted);
  return curl;
}

Section show(const Curl& curl) {
  return {"curl", "Beyond the paper: a curl at the edge of its gate", words_of(curl), {figure_of(curl)}, {}};
}

}  // namespace dashpot::paper
