#include <dashpot/simulated/shaft_sensors.hpp>

#include <cmath>

namespace dashpot::simulated {

double shaft_sensors::cubic::position(double share) const noexcept {
  if (share == 0) return before.position;
  if (share == 1) return after.position;
  const double rest = 1 - share;
  const double bend = duration() * share * rest * (before.velocity * rest - after.velocity * share);
  return before.position * rest * rest * (1 + 2 * share) + after.position * share * share * (1 + 2 * rest) + bend;
}

// Where the path reaches `level`, by false position (Illinois), to well below a nanosecond: it is nearly straight.
double shaft_sensors::cubic::crossing(double level, double from, double to) const noexcept {
  double before_level = position(from) - level;
  double after_level = position(to) - level;
  double share = to;
  for (int round = 0; round < 40 && before_level * after_level < 0; ++round) {
    const double guess = (from * after_level - to * before_level) / (after_level - before_level);
    const double moved = guess - share;
    share = guess;
    const double there = position(share) - level;
    if (there * after_level > 0) {
      to = share;
      after_level = there;
      before_level /= 2;
    } else {
      from = share;
      before_level = there;
      after_level /= 2;
    }
    if (std::abs(moved) * duration() < 1e-9) break;
  }
  return share;
}

shaft_sensors::shaft_sensors(const device_description& device, const shaft_motion& start)
    : encoder_(device.encoder),
      has_velocity_sensor_(device.velocity.estimator == estimator_kind::sensor),
      sensor_rate_(2 * 3.14159265358979323846 * device.velocity.bandwidth),
      sensed_velocity_(has_velocity_sensor_ ? start.velocity : 0) {}

void shaft_sensors::follow(const shaft_motion& before, const shaft_motion& after) noexcept {
  if (has_velocity_sensor_) sense_velocity(before, after);
  if (!(encoder_.step > 0)) return;
  const cubic path{before, after};
  if (before.velocity * after.velocity < 0) {
    const double turn = before.velocity / (before.velocity - after.velocity);
    find_edge(path, 0, turn);
    find_edge(path, turn, 1);
  } else {
    find_edge(path, 0, 1);
  }
}

double shaft_sensors::whole_steps(double position) const noexcept {
  return std::floor(position / encoder_.step + (encoder_.rounding == quantiser::round ? 0.5 : 0.0));
}

std::int64_t shaft_sensors::counts(double position) const noexcept {
  if (!(encoder_.step > 0)) return 0;
  // A simulation that runs away must not take the counter with it.
  constexpr double most = 0x1p62;
  const double steps = whole_steps(position);
  return std::abs(steps) < most ? static_cast<std::int64_t>(steps) : 0;
}

double shaft_sensors::quantised(double position) const noexcept {
  return encoder_.step > 0 ? whole_steps(position) * encoder_.step : position;
}

// Notes the last edge on a stretch of the path that does not turn back.
void shaft_sensors::find_edge(const cubic& path, double from, double to) noexcept {
  const double start = path.position(from);
  const double end = path.position(to);
  const std::int64_t last = counts(end);
  if (counts(start) == last) return;
  const std::int64_t boundary = end > start ? last : last + 1;
  const double offset = encoder_.rounding == quantiser::round ? 0.5 : 0.0;
  edge_ = {path, (static_cast<double>(boundary) - offset) * encoder_.step, from, to, true};
}

double shaft_sensors::newest_edge() const noexcept {
  if (!edge_.exists) return -1;
  return edge_.path.before.time + edge_.path.duration() * edge_.path.crossing(edge_.level, edge_.from, edge_.to);
}

// First-order low-pass, exact for a velocity that is linear between the two instants.
void shaft_sensors::sense_velocity(const shaft_motion& before, const shaft_motion& after) noexcept {
  const double duration = after.time - before.time;
  if (!(sensor_rate_ > 0) || !(duration > 0)) {
    sensed_velocity_ = after.velocity;
    return;
  }
  const double lag = (after.velocity - before.velocity) / duration / sensor_rate_;
  const double transient = sensed_velocity_ - before.velocity + lag;
  sensed_velocity_ = after.velocity - lag + transient * std::exp(-sensor_rate_ * duration);
}

}  // namespace dashpot::simulated
