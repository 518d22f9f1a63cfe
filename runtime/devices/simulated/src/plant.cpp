#include <dashpot/simulated/plant.hpp>

#include <cmath>

#include <dashpot/simulated/gauss.hpp>

namespace dashpot::simulated {

plant::plant(const device_description& device, const scenario& scene)
    : stepped_plant(device, scene), prescribed_(scene.prescribed) {
  const motion_point start =
      prescribed_ ? intended(0) : motion_point{scene.initial_position / ratio_, scene.initial_velocity / ratio_};
  shaft_ = {0, start.position, start.velocity};
  grip_ = taking_hold_at(user_, start.position);
  kinetic_at_start_ = kinetic(start.velocity);
  settle();
}

void plant::commit(const step& done, shaft_sensors& sensors) noexcept {
  sensors.follow(shaft_, done.shaft);
  shaft_ = done.shaft;
  grip_ = done.grip;
  drives_.advance(done.duration);
  ledger_ += done.work;
  ledger_.kinetic = kinetic(shaft_.velocity) - kinetic_at_start_;
}

plant::step plant::attempt(double duration, const hand_step& grip) const noexcept {
  if (prescribed_) return follow(duration);
  return direction_ == 0 ? stay(duration, grip) : slide(duration, grip);
}

// The shaft goes where it is told; the hand does what that takes.
plant::step plant::follow(double duration) const noexcept {
  step done;
  done.duration = duration;
  const motion_point end = intended(shaft_.time + duration);
  done.shaft = {shaft_.time + duration, end.position, end.velocity};
  const double weight = duration / 2;
  for (const double c : gauss::c) {
    const double velocity = intended(shaft_.time + c * duration).velocity;
    const double damping = drives_.at_speed(drives_.damping_after(c * duration), velocity);
    done.work.motor += weight * drives_.torque_after(c * duration) * velocity;
    done.work.brake += weight * damping * velocity * velocity;
    done.work.damping += weight * mechanics_.damping * velocity * velocity;
    done.work.friction += weight * mechanics_.coulomb_friction * std::abs(velocity);
  }
  done.work.hand = done.work.brake + done.work.damping + done.work.friction - done.work.motor + kinetic(end.velocity) -
                   kinetic(shaft_.velocity);
  return done;
}

// Stuck: the hand's states go on, the shaft does not, and no force does any work.
plant::step plant::stay(double duration, const hand_step& grip) const noexcept {
  const motion_point intention[2] = {intended(shaft_.time + gauss::c[0] * duration),
                                     intended(shaft_.time + gauss::c[1] * duration)};
  step done;
  done.duration = duration;
  done.shaft = {shaft_.time + duration, shaft_.position, 0};
  done.grip = grip.advanced(grip_, intention, {0, 0});
  return done;
}

plant::step plant::slide(double duration, const hand_step& grip) const noexcept {
  motion_point intention[2];
  stages s;
  for (unsigned i = 0; i < 2; ++i) {
    const double time = gauss::c[i] * duration;
    intention[i] = intended(shaft_.time + time);
    s.torque[i] = drives_.torque_after(time);
    s.damping[i] = drives_.damping_after(time);
  }
  grip.forces_at_rest(grip_, intention, s.grip);
  balance(s, equations(s, grip, duration));
  step done;
  done.duration = duration;
  done.shaft = {shaft_.time + duration, shaft_.position + duration / 2 * (s.velocity[0] + s.velocity[1]),
                gauss::end(shaft_.velocity, s.velocity)};
  done.grip = grip.advanced(grip_, intention, s.velocity);
  add_sliding_work(s, grip, done);
  return done;
}

// (J + m)/h Σ_j ā_ij (v_j − v_0) = forces at stage i, ā the inverse of a; all but the brake's.
plant::stage_equations plant::equations(const stages& s, const hand_step& grip, double duration) const noexcept {
  const double rate = inertia() / duration;
  const double stiffness = low_.stiffness() + high_.stiffness();
  const double steady = direction_ * mechanics_.coulomb_friction + stop_force(shaft_.position, 0);
  stage_equations e;
  for (unsigned i = 0; i < 2; ++i) {
    e.right[i] = s.torque[i] + s.grip[i] - steady;
    for (unsigned j = 0; j < 2; ++j) {
      e.right[i] += rate * gauss::a_inverse[i][j] * shaft_.velocity;
      e.matrix[i][j] = rate * gauss::a_inverse[i][j] - grip.coupling(i, j) + stiffness * duration * gauss::a[i][j];
    }
    e.matrix[i][i] += mechanics_.damping + low_.damping() + high_.damping();
  }
  return e;
}

// Solves for the stage velocities. `s.damping` is the brake's at no speed before and at these velocities after. It
// fades by a share that changes little within a step, so that each round gains several digits.
void plant::balance(stages& s, const stage_equations& e) const noexcept {
  constexpr int most_rounds = 8;
  const double at_no_speed[2] = {s.damping[0], s.damping[1]};
  s.velocity[0] = s.velocity[1] = shaft_.velocity;
  for (int round = 0; round < most_rounds; ++round) {
    const double guess[2] = {s.velocity[0], s.velocity[1]};
    for (unsigned i = 0; i < 2; ++i) s.damping[i] = drives_.at_speed(at_no_speed[i], guess[i]);
    const double first = e.matrix[0][0] + s.damping[0];
    const double second = e.matrix[1][1] + s.damping[1];
    const double determinant = first * second - e.matrix[0][1] * e.matrix[1][0];
    s.velocity[0] = (e.right[0] * second - e.matrix[0][1] * e.right[1]) / determinant;
    s.velocity[1] = (first * e.right[1] - e.matrix[1][0] * e.right[0]) / determinant;
    if (!drives_.fades_with_speed() || (s.velocity[0] == guess[0] && s.velocity[1] == guess[1])) break;
  }
}

void plant::add_sliding_work(const stages& s, const hand_step& grip, step& done) const noexcept {
  const double weight = done.duration / 2;
  for (unsigned i = 0; i < 2; ++i) {
    const double v = s.velocity[i];
    double hand = s.grip[i];
    double position = shaft_.position;
    double acceleration = 0;
    for (unsigned j = 0; j < 2; ++j) {
      hand += grip.coupling(i, j) * s.velocity[j];
      position += done.duration * gauss::a[i][j] * s.velocity[j];
      acceleration += gauss::a_inverse[i][j] * (s.velocity[j] - shaft_.velocity) / done.duration;
    }
    done.work.hand += weight * (hand - user_.mass * acceleration) * v;
    done.work.motor += weight * s.torque[i] * v;
    done.work.brake += weight * s.damping[i] * v * v;
    done.work.damping += weight * mechanics_.damping * v * v;
    done.work.friction += weight * direction_ * mechanics_.coulomb_friction * v;
    done.work.stop += weight * stop_force(position, v) * v;
  }
}

// Whether the step has ended in the same state of sticking, sliding and touching as it began in.
bool plant::is_consistent(const step& candidate) const noexcept {
  const shaft_motion& end = candidate.shaft;
  if (prescribed_) return true;
  if (direction_ == 0) {
    return can_hold(end.position, force_at_rest(end, candidate.grip, drives_.torque_after(candidate.duration)));
  }
  if (mechanics_.coulomb_friction > 0 && direction_ * end.velocity < 0) return false;
  if (low_.is_passed(end.position) || high_.is_passed(end.position)) return false;
  return low_.is_settled(end) && high_.is_settled(end);
}

// After an event: what the shaft does from here on.
void plant::settle() noexcept {
  if (low_.is_passed(shaft_.position)) land(low_);
  if (high_.is_passed(shaft_.position)) land(high_);
  if (mechanics_.coulomb_friction > 0 && direction_ * shaft_.velocity < 0) shaft_.velocity = 0;
  low_.touch(shaft_);
  high_.touch(shaft_);
  if (shaft_.velocity != 0) {
    direction_ = shaft_.velocity > 0 ? 1 : -1;
    return;
  }
  const double force = force_at_rest(shaft_, grip_, drives_.torque());
  direction_ = can_hold(shaft_.position, force) ? 0 : force > 0 ? 1 : -1;
}

// A rigid stop takes all the momentum, the hand's through the tool.
void plant::land(const stop_contact& stop) noexcept {
  const double by_hand = user_.mass * shaft_.velocity * shaft_.velocity / 2;
  ledger_.hand += by_hand;
  ledger_.stop += by_hand + kinetic(shaft_.velocity);
  ledger_.kinetic = -kinetic_at_start_;
  shaft_.position = stop.position();
  shaft_.velocity = 0;
}

bool plant::can_hold(double position, double force) const noexcept {
  if (std::abs(force) <= mechanics_.coulomb_friction) return true;
  return (low_.is_reached(position) && low_.holds_against(force)) ||
         (high_.is_reached(position) && high_.holds_against(force));
}

double plant::force_at_rest(const shaft_motion& shaft, const hand_state& grip, double torque) const noexcept {
  return torque + force_of(user_, grip, intended(shaft.time), 0) - stop_force(shaft.position, 0);
}

plant_view plant::view() const noexcept {
  plant_view seen = view_of_shaft();
  seen.stop_torque = stop_force(shaft_.position, shaft_.velocity);
  seen.stuck = !prescribed_ && direction_ == 0;
  const double grip = prescribed_ ? 0 : force_of(user_, grip_, intended(shaft_.time), shaft_.velocity);
  const double resistance = (mechanics_.damping + seen.brake_damping) * shaft_.velocity + seen.stop_torque;
  const double sliding = mechanics_.coulomb_friction * (shaft_.velocity > 0 ? 1 : shaft_.velocity < 0 ? -1 : 0);
  const double driving = seen.motor_torque + grip - resistance;
  seen.friction_torque = seen.stuck ? driving : sliding;
  seen.hand_torque = prescribed_ ? 0 : grip - user_.mass / inertia() * (driving - seen.friction_torque);
  return seen;
}

}  // namespace dashpot::simulated
