// What the motor does at every sample, as the constants that are really emitted (theory, sections 3 and 4):
//     m = k0 u + s Δu + Σ G_i + g v̂,      G_i ← a_i G_i + d_i Δu + e_i v̂
// where G_i is a mode's force decayed to the next sample, so that d_i = a_i c_i.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <optional>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

using Rational = boost::multiprecision::cpp_rational;

struct MotorMode {
  double decay = 0;           // a [1]; as emitted, or 1 − loss, rounded
  double loss = 0;            // α = 1 − a [1]; as emitted, or 1 − decay, rounded
  double position_drive = 0;  // d [N/m]
  double velocity_drive = 0;  // e [N·s/m]
  double energy_weight = 0;   // 1/(2 k a²) [m/N]
};

struct MotorConstants {
  double static_stiffness = 0;       // k0 [N/m]
  double half_static_stiffness = 0;  // [N/m]
  double step_stiffness = 0;         // s = Σ c_i [N/m]
  double velocity_gain = 0;          // g [N·s/m]
  bool loss_is_emitted = false;      // the decay is exactly 1 − loss; else the loss is exactly 1 − decay
  std::vector<MotorMode> modes;
  double unit_roundoff = 0;  // of the law's scalar type
  double error_bound = 0;    // error of a mode's force from rounding, relative to its peak

  bool is_idle() const;           // it makes no force
  bool follows_estimate() const;  // the motor uses v̂ anywhere
  bool estimate_drives_modes() const;
};

// The motor without its response to the estimate.
MotorConstants position_driven(MotorConstants motor);

// a, exactly.
Rational exact_decay(const MotorConstants& motor, const MotorMode& mode);

// For a law with slips: the motor of the part that reaches ground without one.
MotorConstants linear_motor_constants(const UpdateLaw& law);

// The modes behind slips, one entry for each part.
std::vector<MotorConstants> parts_behind_slips(const UpdateLaw& law);

// Empty for a law with slips or a contact, which is not linear, and for one whose parameters change.
std::optional<MotorConstants> motor_constants(const UpdateLaw& law);

}  // namespace dashpot::compiler
