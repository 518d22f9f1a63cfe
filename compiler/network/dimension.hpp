// What a quantity measures, as powers of the base units.
#pragma once

#include <string>

namespace dashpot::compiler {

// The radian counts as a base unit, so that a torque [N m] and a rotational stiffness [N m/rad] are told apart.
struct Dimension {
  int kilogram = 0;
  int metre = 0;
  int second = 0;
  int ampere = 0;
  int radian = 0;

  friend bool operator==(const Dimension&, const Dimension&) = default;
};

Dimension product(const Dimension& x, const Dimension& y);
Dimension power(const Dimension& x, int exponent);

namespace dimensions {

inline constexpr Dimension number{};
inline constexpr Dimension mass{1, 0, 0};
inline constexpr Dimension length{0, 1, 0};
inline constexpr Dimension time{0, 0, 1};
inline constexpr Dimension angle{0, 0, 0, 0, 1};
inline constexpr Dimension frequency{0, 0, -1};
inline constexpr Dimension velocity{0, 1, -1};
inline constexpr Dimension angular_velocity{0, 0, -1, 0, 1};
inline constexpr Dimension acceleration{0, 1, -2};
inline constexpr Dimension angular_acceleration{0, 0, -2, 0, 1};
inline constexpr Dimension force{1, 1, -2};
inline constexpr Dimension torque{1, 2, -2};
inline constexpr Dimension force_rate{1, 1, -3};
inline constexpr Dimension torque_rate{1, 2, -3};
inline constexpr Dimension stiffness{1, 0, -2};
inline constexpr Dimension rotational_stiffness{1, 2, -2, 0, -1};
inline constexpr Dimension damping{1, 0, -1};
inline constexpr Dimension rotational_damping{1, 2, -1, 0, -1};
inline constexpr Dimension inertia{1, 2, 0};
inline constexpr Dimension current{0, 0, 0, 1};
inline constexpr Dimension current_rate{0, 0, -1, 1};
inline constexpr Dimension force_constant{1, 1, -2, -1};
inline constexpr Dimension torque_constant{1, 2, -2, -1};
inline constexpr Dimension damping_per_current_squared{1, 0, -1, -2};
inline constexpr Dimension rotational_damping_per_current_squared{1, 2, -1, -2, -1};

}  // namespace dimensions

// "N m s/rad" for rotational_damping; the base units where the dimension has no name; "1" for a plain number.
std::string unit_of(const Dimension& dimension);

// "a stiffness [N/m]", "a plain number", or "a quantity [kg/s^3]" where the dimension has no name.
std::string describe(const Dimension& dimension);

}  // namespace dashpot::compiler
