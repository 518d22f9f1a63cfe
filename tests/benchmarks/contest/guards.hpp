// The two guards that every contender carries: decaying states stay out of the subnormal range, and an input or a force
// that is no finite number leaves the states alone and gives a motor force of 0.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot::contest {

// As in emitted code: its square is still a normal number.
constexpr double threshold = 6.223015277861142e-61;  // [N], or [m] for states that are displacements

constexpr double awake(double state) noexcept { return state > threshold || state < -threshold ? state : 0; }

// Of a force that is a sum with finite gains other than 0, so that each input that is not finite makes it so as well.
constexpr bool is_finite(double value) noexcept { return value - value == value - value; }

}  // namespace dashpot::contest
