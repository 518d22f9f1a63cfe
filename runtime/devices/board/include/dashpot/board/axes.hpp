// What a board of one axis and one of two have in common: a message, an output or a reading holds one value for each
// joint, with its encoder and motor, and one for each brake. Where there is only one it is the value itself.
#pragma once

#include <cstddef>
#include <type_traits>

#include <dashpot/arm_description.hpp>

namespace dashpot::board {

// Brakes that there is room for. A board that has fewer states 0 as the largest damping of those it lacks.
template <unsigned Axes>
inline constexpr unsigned brakes_of = Axes == 1 ? 1 : most_arm_brakes;

template <class Value, unsigned Count>
using one_each = std::conditional_t<Count == 1, Value, Value[Count]>;

template <class Value>
constexpr Value& nth(Value& only, unsigned) noexcept {
  return only;
}
template <class Value, std::size_t Count>
constexpr Value& nth(Value (&all)[Count], unsigned number) noexcept {
  return all[number];
}

}  // namespace dashpot::board
