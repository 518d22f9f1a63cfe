// The paper's (21) by hand, as printed: a spring that yields at δ_max = Y/K, and dampers by regime. The printed sliding
// force lacks its sign; here it has that of the deflection. `brake`: the dampers are the brake's, else the motor's
// through the estimate.
#pragma once

#include <algorithm>
#include <cmath>

#include "law.hpp"

namespace dashpot::paper {

class PrintedNeedle {
 public:
  enum class Dampers { in_motor, in_brake, left_out };
  PrintedNeedle(double stiffness, double yield, double B1, double B2, Dampers dampers)
      : stiffness_(stiffness), presliding_(yield / stiffness), B1_(B1), B2_(B2), dampers_(dampers) {}

  void reset(double position) noexcept { anchor_ = position; }
  command<double> output(double position, double velocity) noexcept {
    const double deflection = position - anchor_;
    const bool slides = std::abs(deflection) > presliding_;
    const double held = std::clamp(deflection, -presliding_, presliding_);
    anchor_ = position - held;
    const double damping = slides ? B1_ + B2_ : B1_, elastic = stiffness_ * held;
    if (dampers_ == Dampers::in_brake) return {damping, elastic};
    return {0, dampers_ == Dampers::in_motor ? elastic + damping * velocity : elastic};
  }
  void update() noexcept {}

 private:
  double stiffness_, presliding_, B1_, B2_;  // K [N/m], δ_max [m], [N·s/m]
  Dampers dampers_;
  double anchor_ = 0;  // x [m]
};

}  // namespace dashpot::paper
