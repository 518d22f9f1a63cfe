#include "certify/assumed_values.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

struct VariedValue {
  const char* key;
  void (*scale)(device_description& device, double factor);
};

// Dotted keys of the device file.
constexpr VariedValue varied_values[] = {
    {"arm_radius", [](device_description& d, double factor) { d.arm_radius *= factor; }},
    {"loop.jitter", [](device_description& d, double factor) { d.loop.jitter *= factor; }},
    {"loop.write_delay",
     [](device_description& d, double factor) {
       d.loop.write_earliest *= factor;
       d.loop.write_latest *= factor;
     }},
    {"loop.band",
     [](device_description& d, double factor) {
       d.loop.band_low *= factor;
       d.loop.band_high = std::min(d.loop.band_high * factor, 0.5 / d.loop.sample_period);
     }},
    {"encoder.max_speed", [](device_description& d, double factor) { d.encoder.max_speed *= factor; }},
    {"velocity.cutoff",
     [](device_description& d, double factor) {
       d.velocity.cutoff = std::min(d.velocity.cutoff * factor, 0.49 / d.loop.sample_period);
     }},
    {"velocity.acceleration", [](device_description& d, double factor) { d.velocity.acceleration *= factor; }},
    {"velocity.bandwidth", [](device_description& d, double factor) { d.velocity.bandwidth *= factor; }},
    {"motor.amplifier_lag", [](device_description& d, double factor) { d.motor.amplifier_lag *= factor; }},
    {"brake.max_damping", [](device_description& d, double factor) { d.brake.max_damping *= factor; }},
    {"brake.residual_damping", [](device_description& d, double factor) { d.brake.residual_damping *= factor; }},
    {"brake.tolerance",
     [](device_description& d, double factor) { d.brake.tolerance = std::min(d.brake.tolerance * factor, 1.0); }},
    {"brake.critical_speed", [](device_description& d, double factor) { d.brake.critical_speed *= factor; }},
    {"mechanics.damping", [](device_description& d, double factor) { d.mechanics.damping *= factor; }},
};

}  // namespace

std::vector<VariedDevice> with_assumed_varied(const Device& device) {
  std::vector<VariedDevice> all;
  for (const VariedValue& value : varied_values) {
    if (std::find(device.assumed.begin(), device.assumed.end(), value.key) == device.assumed.end()) continue;
    for (const double factor : {1 - assumed_spread, 1 + assumed_spread}) {
      all.push_back({value.key, device});
      value.scale(all.back().device.description, factor);
    }
  }
  return all;
}

}  // namespace dashpot::compiler
