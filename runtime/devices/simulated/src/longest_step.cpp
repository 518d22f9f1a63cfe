#include <dashpot/simulated/longest_step.hpp>

#include <algorithm>
#include <cmath>

namespace dashpot::simulated {
namespace {

struct engaged {
  double stiffness = 0;  // [N·m/rad] or [N/m]
  double damping = 0;    // [N·m·s/rad] or [N·s/m]
};

// Everything that can act on the shaft at once.
engaged all_of(const device_description& device, const scenario& scene, const hand& user, double ratio) {
  engaged all;
  all.damping = device.mechanics.damping + device.brake.max_damping + device.brake.residual_damping + user.damping;
  for (unsigned i = 0; i < user.states; ++i) all.stiffness += std::abs(user.input[i] * user.output[i]);
  for (const auto& stop : {scene.low, scene.high}) {
    if (!stop || std::isinf(stop->stiffness)) continue;
    all.stiffness += stop->stiffness * ratio * ratio;
    all.damping += stop->damping * ratio * ratio;
  }
  return all;
}

// A bound for the magnitudes of A's eigenvalues [1/s].
double fastest_of(const hand& user) {
  double largest = 0;
  for (unsigned i = 0; i < user.states; ++i) {
    double row = 0;
    for (unsigned j = 0; j < user.states; ++j) row += std::abs(user.dynamics[i][j]);
    largest = std::max(largest, row);
  }
  return largest;
}

double rate_of(double lag) { return lag > 0 ? 1 / lag : 0; }

}  // namespace

double longest_step(const device_description& device, const scenario& scene, const hand& user, double ratio) {
  const double period = device.loop.sample_period;
  if (scene.substeps > 0) return period / scene.substeps;
  const structural_mode& mode = device.mechanics.mode;
  const bool gives = mode.frequency > 0;
  const double inertia = gives ? std::min(mode.mass + user.mass, device.mechanics.inertia - mode.mass)
                               : device.mechanics.inertia + user.mass;
  const engaged all = all_of(device, scene, user, ratio);
  const double fastest = std::max({0.5 / period, rate_of(device.motor.amplifier_lag), rate_of(device.brake.coil_lag),
                                   all.damping / inertia, 5 * std::sqrt(all.stiffness / inertia), fastest_of(user),
                                   gives ? 5 * 2 * 3.14159265358979323846 * mode.frequency : 0});
  return std::max(0.5 / fastest, period / 64);
}

}  // namespace dashpot::simulated
