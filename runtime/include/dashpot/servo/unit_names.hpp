// The two kinds of motion and their units, as files and logs spell them.
#pragma once

#include <dashpot/command.hpp>

namespace dashpot {

constexpr const char* name_of(motion kind) noexcept { return kind == motion::rotation ? "rotation" : "translation"; }
constexpr const char* position_unit(motion kind) noexcept { return kind == motion::rotation ? "rad" : "m"; }
constexpr const char* velocity_unit(motion kind) noexcept { return kind == motion::rotation ? "rad/s" : "m/s"; }
constexpr const char* force_unit(motion kind) noexcept { return kind == motion::rotation ? "N m" : "N"; }
constexpr const char* damping_unit(motion kind) noexcept { return kind == motion::rotation ? "N m s/rad" : "N s/m"; }

}  // namespace dashpot
