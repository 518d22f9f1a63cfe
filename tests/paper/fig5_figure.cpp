#include "fig5_figure.hpp"

#include <fmt/format.h>

namespace dashpot::paper::fig5 {
namespace {

using Samples = std::vector<ResponseSample>;

Curve curve(const std::string& name, const Style& style, const Samples& samples, double (*value)(const ResponseSample&),
            Maker maker = Maker::emitted) {
  Curve result{name, style, {}, {}, maker};
  for (const ResponseSample& sample : samples) {
    result.x.push_back(sample.time);
    result.y.push_back(value(sample));
  }
  return result;
}

// The continuous answer between the samples, split as the emitted law splits it: `damping` [N·s/m] to the brake.
Samples closed_form(double damping) {
  Samples samples;
  const auto add = [&](double time, double velocity) {
    const double force = closed_form_force(solid, insertion, time);
    samples.push_back({time, insertion.position(time), force, damping * velocity, force - damping * velocity});
  };
  add(0, 0);
  for (int i = 0; i <= 800; ++i) add(i / 100.0, i <= 400 ? insertion.rate : 0);
  return samples;
}

}  // namespace

Figure figure(const Samples& exact, const Samples& euler, double damping) {
  const auto force = [](const ResponseSample& s) { return s.emitted(); };
  const auto millimetres = [](const ResponseSample& s) { return s.position * 1e3; };
  const auto brake = [](const ResponseSample& s) { return s.brake; };
  const auto motor = [](const ResponseSample& s) { return s.motor; };
  const Samples line = closed_form(damping);
  const auto panel = [&](const char* title, const char* label, double (*value)(const ResponseSample&)) {
    return Panel{title,
                 "time [s]",
                 label,
                 {curve("(6)", ideal, line, value, Maker::closed_form), curve("emitted, exact", emitted, exact, value),
                  curve("emitted, backward Euler", emitted_euler, euler, value)}};
  };
  return {"Fig. 5: 2nd-order Maxwell solid, ramp and hold in steps of 200 ms",
          {fmt::format("K1 = 12, K2 = 10, K3 = 5 N/m; B1 = 5, B2 = 6 N·s/m; {} mm/s for {} s, then held.",
                       insertion.rate * 1e3, insertion.ramp_time),
           fmt::format("Largest error of the emitted law, relative to the peak: exact {:.0e}, backward Euler {:.3f} %.",
                       relative_error(exact), 100 * relative_error(euler))},
          {panel("Total force", "force [N]", force),
           panel("Brake: b·u̇", "force [N]", brake),
           {"Displacement applied",
            "time [s]",
            "displacement [mm]",
            {curve("", plain, line, millimetres, Maker::closed_form)}},
           panel("Motor: m", "force [N]", motor)}};
}

}  // namespace dashpot::paper::fig5
