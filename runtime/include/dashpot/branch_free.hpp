// The decisions of command.hpp without a jump: the same numbers in a time that no value changes (`dashpot compile
// --constant-time`).
//
// Compilers turn `?:` into jumps, and masks back into `?:`, as they see fit. So a mask is made of the comparison,
// hidden from the optimiser, and the numbers are put together from bits.
#pragma once

namespace dashpot::branch_free {

template <class Scalar>
struct bits_of;
template <>
struct bits_of<double> {
  using type = unsigned long long;
};
template <>
struct bits_of<float> {
  using type = unsigned;
};

// All ones or all zeros.
template <class Scalar>
using mask = typename bits_of<Scalar>::type;

template <class Scalar>
mask<Scalar> bits(Scalar value) noexcept {
  static_assert(sizeof(mask<Scalar>) == sizeof(Scalar), "a mask has a bit for each of the number's");
  return __builtin_bit_cast(mask<Scalar>, value);
}

template <class Scalar>
mask<Scalar> mask_of(bool is_set) noexcept {
  mask<Scalar> all = mask<Scalar>(0) - static_cast<mask<Scalar>>(is_set);
#if defined(__GNUC__)
  __asm__("" : "+r"(all));
#endif
  return all;
}

// `yes` where the mask is ones, else `no`.
template <class Scalar>
Scalar chosen(mask<Scalar> which, Scalar yes, Scalar no) noexcept {
  return __builtin_bit_cast(Scalar, (bits(yes) & which) | (bits(no) & ~which));
}

// `yes` where `condition` is above zero, else `no`.
template <class Scalar>
Scalar where(Scalar condition, Scalar yes, Scalar no) noexcept {
  return chosen(mask_of<Scalar>(condition > Scalar(0)), yes, no);
}

// As the functions of these names in command.hpp.
template <class Scalar>
Scalar flush_below(Scalar threshold, Scalar value) noexcept {
  const mask<Scalar> sign = bits(-Scalar(0));
  const Scalar magnitude = __builtin_bit_cast(Scalar, bits(value) & ~sign);
  return chosen(mask_of<Scalar>(magnitude > threshold), value, Scalar(0));
}

template <class Scalar>
Scalar clamp_to(Scalar limit, Scalar value) noexcept {
  const Scalar below = chosen(mask_of<Scalar>(value < limit), value, limit);
  return chosen(mask_of<Scalar>(below > -limit), below, -limit);
}

}  // namespace dashpot::branch_free
