#include "commands/hand_motion.hpp"

#include <algorithm>

namespace dashpot::compiler {
namespace {

constexpr double frequency = 0.5;      // of the swing [Hz]
constexpr double lead_in = 1;          // to where it is about [s]
constexpr double share_of_room = 0.4;  // that a swing takes of the way to the end of the range

simulated::trajectory swing(double amplitude, double centre) {
  return simulated::sine(amplitude, frequency, 0, centre);
}

simulated::trajectory swing_led_to(double amplitude, double centre) {
  return [lead = simulated::smoothly_through({{0, 0}, {lead_in, centre}}),
          then = swing(amplitude, centre)](double time) { return time < lead_in ? lead(time) : then(time - lead_in); };
}

}  // namespace

HandMotion hand_motion(const device_description& device, bool rotary_tool) {
  const double wanted = rotary_tool ? 0.2 : 0.01;
  const double ratio = device.arm_radius > 0 && !rotary_tool ? device.arm_radius : 1;
  const double low = ratio * device.encoder.range_low, high = ratio * device.encoder.range_high;
  if (low == high) return {0, swing(wanted, 0)};
  const double about_zero = share_of_room * std::min(-low, high);
  if (about_zero >= wanted / 2) return {0, swing(std::min(wanted, about_zero), 0)};
  const double middle = (low + high) / 2, amplitude = std::min(wanted, share_of_room * (high - low) / 2);
  if (low > 0 || high < 0 || middle == 0) return {middle, swing(amplitude, middle)};
  return {0, swing_led_to(amplitude, middle)};
}

}  // namespace dashpot::compiler
