// What an update law returns every sample, and the one place where the sign convention is stated.
//
// The port displacement u [m or rad] grows as the tool pushes into the tissue; u̇ [m/s or rad/s] is its velocity. The
// network opposes the tool with the force f [N or N·m], positive against +u, so that f·u̇ [W] flows into the network.
// It is split into f = damping·u̇ + force: the brake makes the first part by physics, the motor makes the second.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "dashpot needs IEEE arithmetic: finite checks and compensated sums survive no -ffast-math or -ffinite-math-only"
#endif

namespace dashpot {

enum class motion : unsigned char { translation, rotation };

template <class Scalar>
struct command {
  Scalar damping;  // brake damping [N·s/m], or [N·m·s/rad] in rotation; never negative
  Scalar force;    // motor force opposing +u [N], or torque [N·m] in rotation
};

// Of a device of several axes: a damping for each brake, along the direction of joint velocities that the device's
// description states, and a torque for each motor, opposing +q. With `axes` positions q [rad or m] of the joints.
template <class Scalar, int axes, int brakes>
struct commands {
  Scalar damping[unsigned{brakes}];  // [N·m·s/rad] or [N·s/m]; never negative
  Scalar torque[unsigned{axes}];     // [N·m] or [N]
};

// True when every argument is finite: x − x is 0 for a finite x and NaN for the others, and NaN alone differs from
// itself.
template <class Scalar>
constexpr bool all_finite(Scalar a) noexcept {
  const Scalar nothing = a - a;
  return nothing == nothing;
}
template <class Scalar>
constexpr bool all_finite(Scalar a, Scalar b) noexcept {
  return all_finite((a - a) + (b - b));
}
template <class Scalar>
constexpr bool all_finite(Scalar a, Scalar b, Scalar c) noexcept {
  return all_finite((a - a) + (b - b) + (c - c));
}
template <class Scalar, class... Scalars>
constexpr bool all_finite(Scalar a, Scalar b, Scalar c, Scalars... more) noexcept {
  return all_finite(a, b, c) && all_finite(more...);
}

// Whether `value` lies beyond ± `threshold`. One question in two forms: a desktop's processor predicts two comparisons
// and takes them out of the chain of states; a micro-controller has one instruction for the magnitude, and without a
// branch needs the same time for either sign.
#if defined(__arm__) && defined(__GNUC__)
constexpr bool is_beyond(float threshold, float value) noexcept { return __builtin_fabsf(value) > threshold; }
constexpr bool is_beyond(double threshold, double value) noexcept { return __builtin_fabs(value) > threshold; }
#else
template <class Scalar>
constexpr bool is_beyond(Scalar threshold, Scalar value) noexcept {
  return value > threshold || value < -threshold;
}
#endif

// Zero for a magnitude below `threshold`, the value itself otherwise. Keeps decaying states out of the subnormal
// range, where arithmetic is tens of times slower on many processors.
template <class Scalar>
constexpr Scalar flush_below(Scalar threshold, Scalar value) noexcept {
  return is_beyond(threshold, value) ? value : Scalar(0);
}

// drive + decay · force, where a force below ± `threshold` counts as zero. The guard looks at the force before, so that
// nothing waits for it; on processors that predict jumps, nothing ever waits at all.
template <class Scalar>
constexpr Scalar relaxed(Scalar threshold, Scalar decay, Scalar force, Scalar drive) noexcept {
#if defined(__GNUC__) && !defined(__arm__)
  if (__builtin_expect(is_beyond(threshold, force), true)) return drive + decay * force;
  return drive + Scalar(0);
#else
  return is_beyond(threshold, force) ? drive + decay * force : drive + Scalar(0);
#endif
}

// `value` within ± `limit`, which is not negative: what a slip holds of the force that acts on it.
template <class Scalar>
constexpr Scalar clamp_to(Scalar limit, Scalar value) noexcept {
  const Scalar below = value < limit ? value : limit;
  return below > -limit ? below : -limit;
}

// How far a tool at `position` has pushed in a surface that lies at `at`, unloaded; 0 before it.
template <class Scalar>
constexpr Scalar pushed_in(Scalar at, Scalar position) noexcept {
  return position > at ? position - at : Scalar(0);
}

}  // namespace dashpot
