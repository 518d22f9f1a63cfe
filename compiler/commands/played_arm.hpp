// played_motion.hpp for networks of two axes.
#pragma once

#include "commands/played_motion.hpp"
#include "emit/axes_emission.hpp"

namespace dashpot::compiler {

// The joints are led along the motion. Refuses: joint positions that the arm cannot take, and what play() refuses.
// Warns where the tip leaves the workspace.
std::optional<PlayedMotion> play(const AxesCompilation& compilation, const JointMotion& motion, std::uint64_t seed,
                                 Diagnostics& diagnostics);

std::string csv_of(const PlayedMotion& played, const AxesCompilation& compilation);
std::string to_text(const PlayedMotion& played, const AxesCompilation& compilation);
std::string to_json(const PlayedMotion& played, const AxesCompilation& compilation, const std::string& file);

}  // namespace dashpot::compiler
