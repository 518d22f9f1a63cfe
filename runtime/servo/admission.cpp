#include <dashpot/servo/admission.hpp>

#include <charconv>
#include <cstring>

#include <dashpot/servo/unit_names.hpp>
#include <dashpot/transmission.hpp>

namespace dashpot {
namespace {

bool same(const char* one, const char* other) noexcept { return std::strcmp(one, other) == 0; }

bool same_period(double one, double other) noexcept { return static_cast<float>(one) == static_cast<float>(other); }

admission hold_against_certificate(const model_facts& model, const loop_facts& loop) noexcept {
  if (!same(model.device, loop.identity.name)) return admission::other_device;
  if (!same(model.device_digest, loop.identity.digest)) return admission::other_digest;
  if (!same(model.estimator, loop.estimator)) return admission::other_estimator;
  if (model.loop_delay != loop.device.loop.delay_samples) return admission::other_delay;
  return admission::admitted;
}

// Nine digits tell any two periods apart that single precision does.
std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9).ptr};
}

std::string quoted(const char* text) { return "'" + std::string(text) + "'"; }

std::string made_for(const model_facts& model) {
  return (model.is_certified ? "model is certified for device " : "model is made for device ") + quoted(model.device);
}

// Of a model that was compiled for the ideal device, or not certified on its own.
std::string uncertified(const model_facts& model) {
  return model.any_device ? "model is compiled for the ideal device" : made_for(model) + " and not certified on it";
}

}  // namespace

admission admit(const model_facts& model, const loop_facts& loop, bool require_certified) noexcept {
  if (!(loop.device.loop.sample_period > 0)) return admission::no_period;
  if (!same_period(model.sample_period, loop.device.loop.sample_period)) return admission::other_rate;
  if (!can_drive(loop.device, model.port_motion)) return admission::other_motion;
  if (!model.any_device) {
    const admission verdict = hold_against_certificate(model, loop);
    if (verdict != admission::admitted || model.is_certified) return verdict;
  }
  return require_certified ? admission::not_certified : admission::admitted_uncertified;
}

std::string to_text(admission verdict, const model_facts& model, const loop_facts& loop) {
  const loop_description& timing = loop.device.loop;
  switch (verdict) {
    case admission::admitted: return {};
    case admission::admitted_uncertified:
      return uncertified(model) + "; " +
             (model.any_device ? "nothing is certified about device " + quoted(loop.identity.name)
                               : "it may give more energy than it got");
    case admission::no_period:
      return "device " + quoted(loop.identity.name) + " states a sample period of " + number(timing.sample_period) +
             " s; a loop needs one above zero";
    case admission::other_rate:
      return "model is made for a period of " + number(model.sample_period) + " s, device " +
             quoted(loop.identity.name) + " runs at " + number(timing.sample_period) + " s";
    case admission::other_motion:
      return std::string("model is made for ") + name_of(model.port_motion) + ", device " + quoted(loop.identity.name) +
             " moves in " + name_of(loop.device.motion) + " and states no arm radius that would convert it";
    case admission::not_certified:
      return uncertified(model) + "; this loop requires one certified for device " + quoted(loop.identity.name);
    case admission::other_device: return made_for(model) + ", this is device " + quoted(loop.identity.name);
    case admission::other_digest:
      return made_for(model) + " with digest " + quoted(model.device_digest) + ", this one's is " +
             quoted(loop.identity.digest);
    case admission::other_estimator:
      return made_for(model) + " with estimator " + quoted(model.estimator) + ", this loop uses " +
             quoted(loop.estimator);
    case admission::other_delay:
      return made_for(model) + " with a loop delay of " + std::to_string(model.loop_delay) +
             " samples, the device states " + std::to_string(timing.delay_samples);
    case admission::other_brakes: break;  // of two axes alone
  }
  return "unknown verdict";
}

namespace {

loop_facts of_joint(const arm_loop_facts& loop, unsigned joint) noexcept {
  return {loop.identity, loop.device.joints[joint], loop.estimators[joint]};
}

}  // namespace

admission admit(const arm_model_facts& model, const arm_loop_facts& loop, bool require_certified) noexcept {
  admission verdict = admission::admitted;
  for (unsigned joint = arm_axes; joint-- > 0;) {
    const admission of_this = admit(model.joints[joint], of_joint(loop, joint), require_certified);
    if (is_admitted(verdict) && of_this != admission::admitted) verdict = of_this;
  }
  if (is_admitted(verdict) && model.brakes != loop.device.brake_count) return admission::other_brakes;
  return verdict;
}

std::string to_text(admission verdict, const arm_model_facts& model, const arm_loop_facts& loop) {
  if (verdict == admission::other_brakes)
    return "model commands " + std::to_string(model.brakes) + " brakes, device " + quoted(loop.identity.name) +
           " has " + std::to_string(loop.device.brake_count);
  for (unsigned joint = 0; joint < arm_axes; ++joint) {
    const loop_facts one = of_joint(loop, joint);
    if (admit(model.joints[joint], one, verdict == admission::not_certified) == verdict)
      return to_text(verdict, model.joints[joint], one);
  }
  return {};
}

}  // namespace dashpot
