#include "isotropic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <laws.hpp>

#include "chosen.hpp"
#include "polar_arm.hpp"

namespace dashpot::paper {
namespace {

using std::numbers::pi;

simulated::arm_scenario circle(double radius, double frequency) {
  simulated::arm_scenario scene;
  const double link = chosen("arm.link"), centre = chosen("isotropic.centre"), rate = 2 * pi * frequency;
  scene.prescribed = [=](double time) {
    const double c = std::cos(rate * time), s = std::sin(rate * time);
    return joints_of(link, {{radius * c, centre + radius * s}, {-radius * rate * s, radius * rate * c}});
  };
  return scene;
}

double radius_at(double frequency) { return chosen("isotropic.speed") / (2 * pi * frequency); }

// Of a velocity that turns with ω: the mean of the last n differences lags by n T/2, and a held force by T/2 more.
double real_part_of_estimate(double frequency) {
  const double rate = 2 * pi * frequency, period = 1 / chosen("arm.rate"), window = chosen("isotropic.window");
  const auto sinc = [](double x) { return std::sin(x) / x; };
  return sinc(rate * window * period / 2) * sinc(rate * period / 2) * std::cos(rate * (window + 1) * period / 2);
}

double wanted(const ArmSample& s, int i) { return chosen("isotropic.damping") * s.tip_velocity[i]; }

// After the first quarter turn.
double rms_error(const ArmTrace& trace) {
  double sum = 0, all = 0;
  for (const ArmSample& s : trace) {
    if (s.time <= 0.25 / chosen("isotropic.frequency")) continue;
    for (const int i : {0, 1}) {
      const double off = s.force[i] - wanted(s, i);
      sum += off * off, all += wanted(s, i) * wanted(s, i);
    }
  }
  return std::sqrt(sum / all);
}

// `expected` of Re G: what is taken of b v² over a turn.
template <class Law, class Expected>
Isotropic::Part part_of(const char* name, const Style& style, const char* device, Expected expected) {
  const arm_description arm = arm_of(device);
  const double slow = chosen("isotropic.frequency"), counted = chosen("isotropic.counted");
  Isotropic::Part part{name, style, run<Law>(arm, circle(chosen("isotropic.radius"), slow), 1 / slow), 0, {}, {}};
  part.error = rms_error(part.circle);
  const double full = chosen("isotropic.damping") * chosen("isotropic.speed") * chosen("isotropic.speed");
  for (const double frequency : chosen_list("isotropic.frequencies")) {
    const ArmTrace trace = run<Law>(arm, circle(radius_at(frequency), frequency), 2 * counted);
    const double share = mean_power(trace, counted, 2 * counted) / full;
    part.small.push_back({frequency, share, expected(real_part_of_estimate(frequency))});
    if (frequency == chosen("isotropic.drawn")) part.drawn = trace;
  }
  return part;
}

template <class Value>
std::vector<Curve> curves_of(const Isotropic& isotropic, ArmTrace Isotropic::Part::*trace, Value value) {
  std::vector<Curve> curves;
  for (const Isotropic::Part& part : isotropic.parts) {
    Curve curve{part.name, part.style, {}, {}};
    for (const ArmSample& s : part.*trace) curve.x.push_back(s.time), curve.y.push_back(value(s));
    curves.push_back(curve);
  }
  return curves;
}

Figure figure_of(const Isotropic& isotropic) {
  std::vector<Curve> across =
      curves_of(isotropic, &Isotropic::Part::circle, [](const ArmSample& s) { return s.force[0]; });
  Curve liquid{"the liquid, b v", ideal, {}, {}, Maker::closed_form};
  for (const ArmSample& s : isotropic.parts[0].circle) liquid.x.push_back(s.time), liquid.y.push_back(wanted(s, 0));
  across.insert(across.begin(), liquid);
  const auto off = curves_of(isotropic, &Isotropic::Part::circle, [](const ArmSample& s) {
    return 1e3 * std::hypot(s.force[0] - wanted(s, 0), s.force[1] - wanted(s, 1));
  });
  std::vector<Curve> shares{{"the liquid, b v", ideal, {0, 100}, {1, 1}, Maker::closed_form}};
  Curve expected{"late estimate", bound, {}, {}, Maker::closed_form};
  for (const Isotropic::Part& part : isotropic.parts) {
    Curve share{part.name, part.style, {}, {}}, closed = expected;
    for (const Isotropic::Small& small : part.small) {
      share.x.push_back(small.frequency), share.y.push_back(small.share);
      closed.x.push_back(small.frequency), closed.y.push_back(small.expected);
    }
    shares.push_back(share);
    shares.push_back(closed);
  }
  const auto energy = curves_of(isotropic, &Isotropic::Part::drawn, [](const ArmSample& s) { return 1e3 * s.taken; });
  const double turn = 1 / chosen("isotropic.frequency"), window = chosen("isotropic.window") + 1;
  const Interval once{0, turn}, filled{window / chosen("arm.rate"), turn};
  return {"An isotropic viscous field on an arm of two joints",
          {fmt::format("b = {:g} N·s/m on a parallelogram of links of {:g} mm; 1 kHz, differences over {:g} samples.",
                       chosen("isotropic.damping"), 1e3 * chosen("arm.link"), chosen("isotropic.window")),
           fmt::format(
               "Above: a circle of {:g} mm at {:g} Hz, {:g} mm from the motors. Below: {:g} mm/s; energy at {:g} Hz.",
               1e3 * chosen("isotropic.radius"), chosen("isotropic.frequency"), 1e3 * chosen("isotropic.centre"),
               1e3 * chosen("isotropic.speed"), chosen("isotropic.drawn")),
           "Power and energy: what motors and brakes take from the hand; below zero they give it."},
          {{"Force across, on a slow circle", "time [s]", "force [N]", across, once},
           {"Distance from the liquid’s force", "time [s]", "force [mN]", off, filled, Interval{0, 60}},
           {"Power, of the liquid’s b v²", "frequency [Hz]", "share [1]", shares, Interval{0, 100}},
           {"Energy, on a small circle", "time [s]", "energy [mJ]", energy}}};
}

std::vector<std::string> words_of(const Isotropic& isotropic) {
  const Isotropic::Part &motors = isotropic.parts[0], &joints = isotropic.parts[1], &coupled = isotropic.parts[2];
  const bool gives = motors.lowest_share()<0, never = joints.lowest_share()> 0 && coupled.lowest_share() > 0;
  return {
      fmt::format(
          "On the slow circle the force is off by {:.1f} % (rms) by motors alone, which follow an estimate that is "
          "half a "
          "window "
          "late, {:.1f} % with brakes on the joints, whose coupling of {:.2f} is left to the motors, and only {:.1f} % "
          "with "
          "brakes on "
          "sum and difference of the joints: on this arm they make every isotropic field, and the motors do nothing.",
          100 * motors.error, 100 * joints.error, std::abs(isotropic.coupling), 100 * coupled.error),
      fmt::format("On fast circles motors alone {} energy, up to {:.2f} of b v²; {} brakes, however late the estimate.",
                  gives ? "give" : "give no", std::abs(motors.lowest_share()), never ? "never with" : "also with")};
}

}  // namespace

double Isotropic::Part::lowest_share() const {
  double lowest = small.front().share;
  for (const Small& one : small) lowest = std::min(lowest, one.share);
  return lowest;
}

Isotropic measure_isotropic() {
  Isotropic isotropic;
  const double half = std::acos(chosen("isotropic.centre") / (2 * chosen("arm.link")));
  const double c = isotropic.coupling = std::cos(2 * half);
  isotropic.parts = {
      part_of<laws::isotropic_motors_alone>("motors alone", single_motor, "motors_alone", [](double g) { return g; }),
      part_of<laws::isotropic_joint_brakes>("brakes on the joints", third, "joint_brakes",
                                            [c](double g) { return (1 - c * c * g) / (1 - c * c); }),
      part_of<laws::isotropic_coupled_brakes>("brakes on sum and difference", dual_channel, "coupled_brakes",
                                              [](double) { return 1.0; })};
  return isotropic;
}

Section show(const Isotropic& isotropic) {
  return {"isotropic",
          "Beyond the paper: a liquid, by brakes and by motors",
          words_of(isotropic),
          {figure_of(isotropic)},
          {}};
}

}  // namespace dashpot::paper
