#include <dashpot/simulated/stop_contact.hpp>

#include <cmath>

namespace dashpot::simulated {

stop_contact::stop_contact(const std::optional<end_stop>& obstacle, double side, double ratio)
    : present_(obstacle.has_value()),
      rigid_(present_ && std::isinf(obstacle->stiffness)),
      side_(side),
      position_(present_ ? obstacle->position / ratio : 0),
      stiffness_(present_ ? obstacle->stiffness * ratio * ratio : 0),
      damping_(present_ ? obstacle->damping * ratio * ratio : 0) {}

bool stop_contact::would_push(const shaft_motion& shaft) const noexcept {
  if (!present_ || rigid_ || !(depth(shaft.position) > 0)) return false;
  return stiffness_ * depth(shaft.position) + damping_ * side_ * shaft.velocity > 0;
}

}  // namespace dashpot::simulated
