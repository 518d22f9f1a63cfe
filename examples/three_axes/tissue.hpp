// A tissue for the haptics thread of a library such as CHAI3D: position and velocity in, force out. Three laws, one an
// axis, that know nothing of each other.
#pragma once

#include <across.hpp>
#include <along.hpp>
#include <into.hpp>

// Any vector with x, y and z as functions, as cVector3d has them, made of three numbers.
template <class Vector>
class anisotropic_tissue {
 public:
  // The tool is at rest at `position`, and the tissue relaxed there.
  explicit anisotropic_tissue(const Vector& position) : rest_(position) {}

  // Once a period: position [m] and velocity [m/s] as the device says, the force [N] that its motors are to make. What
  // is NaN or infinite makes no force.
  Vector force(const Vector& position, const Vector& velocity) noexcept {
    return Vector(answer(along_, position.x() - rest_.x(), velocity.x()),
                  answer(across_, position.y() - rest_.y(), velocity.y()),
                  answer(into_, position.z() - rest_.z(), velocity.z()));
  }

  double stored_energy() const noexcept {
    return along_.stored_energy() + across_.stored_energy() + into_.stored_energy();
  }

 private:
  // Without a brake the law's damping is 0, and the motor makes all of the force; it opposes the motion.
  template <class Law>
  static double answer(Law& law, double position, double velocity) noexcept {
    return -law.step(position, velocity).force;
  }

  Vector rest_;
  dashpot::generated::along along_;
  dashpot::generated::across across_;
  dashpot::generated::into into_;
};
