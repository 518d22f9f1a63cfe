#include "verify/verify_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <dashpot/estimators/any_estimator.hpp>

namespace dashpot::compiler {
namespace {

// Σ |e_j| and Σ |e_j| (j − 1) of h v̂(k) = Σ_j e_j Δq(k + 1 − j), j = 1, 2, …
struct Weights {
  double sum = 0, ages = 0;
};

Weights weights_of(const device_description& joint) {
  constexpr int most_samples = 200000, quiet_samples = 2000;
  constexpr double step = 1e-3;  // [rad] or [m]
  const double period = joint.loop.sample_period;
  any_estimator<double> estimator(joint.velocity, period, joint.encoder.step);
  estimator.reset(0);
  Weights weights;
  int quiet = 0;
  for (int k = 0; k < most_samples && quiet < quiet_samples; ++k) {
    device_sample sample{};
    sample.position = step;
    sample.timestamp_ns = static_cast<decltype(sample.timestamp_ns)>(std::llround(1e9 * period * k));
    const double weight = std::abs(period * estimator.update(sample) / step);
    weights.sum += weight;
    weights.ages += k * weight;
    quiet = weight < 1e-13 ? quiet + 1 : 0;
  }
  return weights;
}

// What a brake is sure to make of its command: the tolerance, and fading at the fastest that the joints go.
double sure_share(const AlongBrake& brake, const AxesDevice& device) {
  const double fastest = std::abs(brake.along[0]) * device.joints[0].encoder.max_speed +
                         std::abs(brake.along[1]) * device.joints[1].encoder.max_speed;
  const double critical = brake.brake.critical_speed;
  return (1 - brake.brake.tolerance) / (critical > 0 ? 1 + fastest * fastest / (critical * critical) : 1);
}

}  // namespace

void verify_gate(const axes::CurlGate& gate, const AxesDevice& device, const HeaderConstants& header,
                 Diagnostics& diagnostics) {
  const auto number = [&](const char* name, double due) {
    for (const HeaderConstant& constant : header.all)
      if (constant.name == name && constant.values.size() == 1) return constant.values.front();
    return due;
  };
  // A decimal of the header is rounded, in float32 by 6e-8; the compiler keeps 1e-6 of the allowances back for it.
  const double slack = header.scalar == ScalarType::float64 ? 1e-9 : 1e-6;
  const auto at_most = [&](const char* name, double value, double limit) {
    if (value > 0 && value <= limit * (1 + slack)) return;
    diagnostics.report<DiagnosticCode::constant_wrong>({}, fmt::format("'{}'", name), value,
                                                       fmt::format("at most {:.17g}", limit));
  };
  const loop_description& loop = device.loop();
  const double late = loop.write_latest > 0 ? loop.delay_samples + 1.0 : loop.delay_samples;
  double sum = 1, ages = 0;
  for (const device_description& joint : device.joints) {
    const Weights weights = weights_of(joint);
    sum = std::max(sum, weights.sum);
    ages = std::max(ages, weights.ages + weights.sum * late);
  }
  const double longest = loop.sample_period + loop.jitter + (loop.write_latest - loop.write_earliest);
  const double holds = loop.sample_period / longest;
  const double first = number("gate_factor_1", gate.factor[0]), second = number("gate_factor_2", gate.factor[1]);
  at_most("gate_factor_1", first,
          4 * holds * holds * sure_share(device.brakes[0], device) * sure_share(device.brakes[1], device) / second);
  at_most("gate_share", number("gate_share", 1 / gate.gain), 1 / sum);
  at_most("gate_half", number("gate_half", 0.5 / gate.gain), 0.5 / sum);
  const double reserve = number("gate_reserve", gate.reserve), recovery = number("gate_recovery", gate.recovery);
  const double due = std::abs(recovery) * ages;
  if (recovery < 0 || reserve < due * (1 - slack))
    diagnostics.report<DiagnosticCode::constant_wrong>({}, "'gate_reserve'", reserve,
                                                       fmt::format("at least {:.17g}", due));
}

}  // namespace dashpot::compiler
