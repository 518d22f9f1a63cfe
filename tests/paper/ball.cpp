#include "ball.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <laws.hpp>

#include "chosen.hpp"

namespace dashpot::paper {
namespace {

constexpr double period = laws::ball::sample_period;  // printed in the emitted header

double relaxation_rate() { return chosen("ball.relaxing") / chosen("ball.damper"); }

// The force at rest and a Prony series on the rest of it, both by components: F ← a F + c Δy of each, y the component
// of the force that relaxes.
class PronyOnComponents {
 public:
  void reset(const double (&position)[2]) noexcept {
    for (double& force : force_) force = 0;
    for (int i = 0; i < 2; ++i) last_[i] = relaxing(position, i);
  }
  ArmCommand output(const double (&position)[2], const double (&)[2]) noexcept {
    ArmCommand command{};
    for (int i = 0; i < 2; ++i) {
      now_[i] = relaxing(position, i);
      force_[i] = kept_ * force_[i] + step_ * (now_[i] - last_[i]);
      command.torque[i] = stays_ * now_[i] + force_[i];
    }
    return command;
  }
  void update() noexcept {
    for (int i = 0; i < 2; ++i) last_[i] = now_[i];
  }

 private:
  // Of the ball's force, along −x or −y, that opposes the tool.
  double relaxing(const double (&position)[2], int i) const {
    const double from_centre = std::hypot(position[0], position[1]);
    return -relaxing_ * (radius_ - from_centre) * position[i] / from_centre;
  }

  double radius_ = chosen("ball.radius"), relaxing_ = chosen("ball.relaxing");
  double stays_ = chosen("ball.stiffness") / relaxing_;  // of what relaxes
  double kept_ = std::exp(-relaxation_rate() * period);
  double step_ = (1 - kept_) / (relaxation_rate() * period);  // of a straight change within a period
  double force_[2] = {}, now_[2] = {}, last_[2] = {};
};

// Pressed straight in, then round: at rest at both ends of the press.
simulated::joints_motion motion_at(double time, double speed, double press, double depth, double radius) {
  const double share = std::min(time / press, 1.0);
  const double distance = radius - depth * share * share * (3 - 2 * share);
  const double inwards = -depth * 6 * share * (1 - share) / press;
  const double angle = time > press ? speed * (time - press) : 0, turning = time > press ? speed : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {{distance * c, distance * s}, {inwards * c - distance * turning * s, inwards * s + distance * turning * c}};
}

Ball::Slide slide_at(double speed) {
  simulated::arm_scenario scene;
  const double press = chosen("ball.press"), depth = chosen("ball.depth"), ball = chosen("ball.radius");
  scene.prescribed = [=](double time) { return motion_at(time, speed, press, depth, ball); };
  const arm_description plane = ideal_plane(period);
  const double end = press + chosen("ball.duration"), radius = ball - depth, rate = relaxation_rate();
  const double quarter = std::numbers::pi / (2 * speed);  // of a turn: after each, x and y have changed places
  const double from = end - quarter * std::floor(chosen("ball.duration") / (2 * quarter));
  const double relaxing = chosen("ball.relaxing") * depth, stays = chosen("ball.stiffness") * chosen("ball.depth");
  Ball::Slide slide{speed, run<laws::ball>(plane, scene, end), run<PronyOnComponents>(plane, scene, end), 0, 0, 0, 0};
  slide.depth_power = mean_power(slide.by_depth, from, end);
  slide.component_power = mean_power(slide.by_components, from, end);
  slide.expected = -relaxing * radius * speed * speed * rate / (speed * speed + rate * rate);
  slide.held = stays * radius * speed * speed * period / 2;
  return slide;
}

template <class Value>
Curve curve_of(const char* name, const Style& style, const ArmTrace& trace, Value value, Maker maker = Maker::emitted) {
  Curve curve{name, style, {}, {}, maker};
  for (const ArmSample& sample : trace) curve.x.push_back(sample.time), curve.y.push_back(value(sample));
  return curve;
}

double along(const ArmSample& s) {
  return (s.force[1] * s.tip[0] - s.force[0] * s.tip[1]) / std::hypot(s.tip[0], s.tip[1]);
}
double outwards(const ArmSample& s) {
  return -(s.force[0] * s.tip[0] + s.force[1] * s.tip[1]) / std::hypot(s.tip[0], s.tip[1]);
}

Figure figure_of(const Ball& ball) {
  const Ball::Slide& drawn = ball.slides.front();
  const auto both = [&](auto value) {
    return std::vector<Curve>{curve_of("Prony on components", single_motor, drawn.by_components, value, Maker::by_hand),
                              curve_of("dashpot, depth as map", dual_channel, drawn.by_depth, value)};
  };
  Curve expected{"−F r ω²λ/(ω² + λ²)", ideal, {}, {}, Maker::closed_form};
  const double rate = relaxation_rate();
  for (double speed = 0; speed <= 40; speed += 0.5) {
    expected.x.push_back(speed);
    expected.y.push_back(drawn.expected * (2 * speed * speed / (speed * speed + rate * rate)) * 1e3);
  }
  Curve components{"Prony on components", emitted_euler, {}, {}, Maker::by_hand},
      depth{"dashpot, depth as map", emitted, {}, {}};
  for (const Ball::Slide& slide : ball.slides) {
    components.x.push_back(slide.speed), components.y.push_back(1e3 * slide.component_power);
    depth.x.push_back(slide.speed), depth.y.push_back(1e3 * slide.depth_power);
  }
  const Interval whole{0, drawn.by_depth.back().time};
  return {"A slide round a ball of tissue that relaxes",
          {fmt::format("Pressed {:g} mm into a ball of {:g} mm within {:g} s, then round it at {:g} rad/s. 10 kHz.",
                       1e3 * chosen("ball.depth"), 1e3 * chosen("ball.radius"), chosen("ball.press"), drawn.speed),
           fmt::format("Of the force, {:g} N relax at λ = {:g}/s, and {:g} N stay.",
                       chosen("ball.relaxing") * chosen("ball.depth"), rate,
                       chosen("ball.stiffness") * chosen("ball.depth")),
           "Energy and power: what motors and brakes take from the hand; below zero they give it."},
          {{"Energy taken from the hand", "time [s]", "energy [mJ]",
            both([](const ArmSample& s) { return 1e3 * s.taken; }), whole},
           {"Force against the slide", "time [s]", "force [N]", both(along), whole},
           {"Force out of the ball", "time [s]", "force [N]", both(outwards), whole},
           {"Power taken while it slides", "speed [rad/s]", "power [mW]", {expected, components, depth}}}};
}

std::vector<std::string> words_of(const Ball& ball) {
  const Ball::Slide& drawn = ball.slides.front();
  const bool gives = drawn.component_power < 0, takes = drawn.depth_power >= 0;
  return {
      fmt::format(
          "A Prony series on the components of the force {} {:.3f} W, for as long as the tool slides: the part that "
          "relaxes stays behind the tool's turning, and what it pushes aside is pushed along.",
          gives ? "gives" : "takes", std::abs(drawn.component_power)),
      fmt::format(
          "dashpot lets the depth relax, which does not change: the force is straight out of the ball, its part along "
          "the slide 0 at each sample, and it {} energy. That a motor holds it for a period takes {:.2f} mW, ½ F r "
          "ω²T: "
          "the tool turns under it.",
          takes ? "gives no" : "gives", 1e3 * drawn.depth_power)};
}

}  // namespace

Ball measure_ball() {
  Ball ball;
  for (const double speed : chosen_list("ball.speeds")) ball.slides.push_back(slide_at(speed));
  return ball;
}

Section show(const Ball& ball) {
  return {"ball", "Beyond the paper: a slide round a ball", words_of(ball), {figure_of(ball)}, {}};
}

}  // namespace dashpot::paper
