// Whether a model may drive a device: made for this rate and, unless compiled for the ideal device, for this very
// device, estimator and loop delay; and, where that is required, certified on it.
#pragma once

#include <string>

#include <dashpot/arm_description.hpp>
#include <dashpot/arm_model.hpp>
#include <dashpot/device_description.hpp>
#include <dashpot/model.hpp>

namespace dashpot {

// Which device file a description came from: its name and the digest of its bytes. Empty: not known.
struct device_identity {
  const char* name = "";
  const char* digest = "";
};

// The loop's side of the comparison with a model's facts.
struct loop_facts {
  device_identity identity;
  device_description device;
  const char* estimator = "";
};

struct arm_loop_facts {
  device_identity identity;
  arm_description device;
  const char* estimators[arm_axes] = {"", ""};
};

enum class admission : unsigned char {
  admitted,
  admitted_uncertified,  // compiled for the ideal device, or not certified on this one: runs, with a warning
  no_period,             // the device states no sample period
  other_rate,
  other_motion,   // force and torque do not match, and no arm radius converts them
  not_certified,  // compiled for the ideal device, or not certified on this one, where a certificate is required
  other_device,
  other_digest,  // same name, another file
  other_estimator,
  other_delay,
  other_brakes,  // of two axes: not as many brakes as the model commands
};

constexpr bool is_admitted(admission verdict) noexcept {
  return verdict == admission::admitted || verdict == admission::admitted_uncertified;
}

// Periods are equal when they agree in single precision, which is all that a float model can state.
admission admit(const model_facts& model, const loop_facts& loop, bool require_certified) noexcept;

// Of two axes: what stands against it at either joint.
admission admit(const arm_model_facts& model, const arm_loop_facts& loop, bool require_certified) noexcept;

// One line for the log, what the model is made for against what is there; empty for `admitted`.
std::string to_text(admission verdict, const model_facts& model, const loop_facts& loop);
std::string to_text(admission verdict, const arm_model_facts& model, const arm_loop_facts& loop);

}  // namespace dashpot
