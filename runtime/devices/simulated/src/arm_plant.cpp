#include <dashpot/simulated/arm_plant.hpp>

#include <algorithm>
#include <cmath>

#include <dashpot/simulated/gauss.hpp>

namespace dashpot::simulated {
namespace {

// After so many changes between sliding and sticking in one step it goes on without further ones: a joint may tremble
// at its limit.
constexpr unsigned most_changes = 64;

struct inertia {
  double mass[arm_axes][arm_axes] = {};  // [kg·m²] or [kg]
  double bias[arm_axes] = {};            // c(q, q̇) [N·m] or [N]

  void add(double share, const arm_point& one, const arm_point& other) noexcept {
    for (unsigned j = 0; j < arm_axes; ++j)
      for (unsigned i = 0; i < 2; ++i) {
        for (unsigned k = 0; k < arm_axes; ++k) mass[j][k] += share * one.jacobian[i][j] * other.jacobian[i][k];
        bias[j] += share * one.jacobian[i][j] * other.centripetal[i];
      }
  }
  // A uniform link between two points: the mean of the products of what lies linearly between them.
  void add_link(double link_mass, const arm_point& from, const arm_point& to) noexcept {
    add(link_mass / 3, from, from), add(link_mass / 3, to, to);
    add(link_mass / 6, from, to), add(link_mass / 6, to, from);
  }
};

inertia inertia_of(const arm_description& arm, const arm_pose& pose) noexcept {
  inertia all;
  for (unsigned j = 0; j < arm_axes; ++j)
    for (unsigned k = 0; k < arm_axes; ++k) all.mass[j][k] = arm.inertia[j][k];
  if (arm.geometry.kind == arm_kind::cartesian) return all;
  const unsigned sides = arm.geometry.kind == arm_kind::five_bar ? 2 : 1;
  for (unsigned side = 0; side < sides; ++side) {
    all.add(arm.link_masses[0] / 3, pose.elbow[side], pose.elbow[side]);
    all.add_link(arm.link_masses[1], pose.elbow[side], pose.tip);
  }
  return all;
}

double form(const double (&m)[2][2], const double (&v)[2]) noexcept {
  return m[0][0] * v[0] * v[0] + (m[0][1] + m[1][0]) * v[0] * v[1] + m[1][1] * v[1] * v[1];
}

// What a matrix at the tip is at the joints, Jᵀ m J.
void add_at_joints(const arm_point& tip, const double (&m)[2][2], double (&sum)[2][2]) noexcept {
  for (unsigned j = 0; j < 2; ++j)
    for (unsigned k = 0; k < 2; ++k)
      for (unsigned a = 0; a < 2; ++a)
        for (unsigned b = 0; b < 2; ++b) sum[j][k] += tip.jacobian[a][j] * m[a][b] * tip.jacobian[b][k];
}

// Trace of m⁻¹ x: no eigenvalue of it is larger where x is positive semidefinite.
double trace_over(const double (&m)[2][2], const double (&x)[2][2]) noexcept {
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return (m[1][1] * x[0][0] - m[0][1] * x[1][0] - m[1][0] * x[0][1] + m[0][0] * x[1][1]) / determinant;
}

void velocity_of(const arm_point& point, const double (&v)[2], double (&out)[2]) noexcept {
  for (unsigned i = 0; i < 2; ++i) out[i] = point.jacobian[i][0] * v[0] + point.jacobian[i][1] * v[1];
}

double sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

scenario actuators_of(const arm_scenario& scene, unsigned brake) {
  scenario one;
  one.gain = scene.gain;
  one.seed = scene.seed + brake;
  return one;
}

}  // namespace

arm_plant::arm_plant(const arm_description& arm, const arm_scenario& scene)
    : arm_(arm),
      user_(scene.user),
      intended_(scene.intended),
      prescribed_(scene.prescribed),
      stated_step_(scene.substeps > 0 ? arm.loop().sample_period / scene.substeps : 0),
      period_(arm.loop().sample_period) {
  for (unsigned j = 0; j < arm_axes; ++j) {
    motors_.emplace_back(joint_of(arm, j), actuators_of(scene, 0));
    now_.q[j] = scene.initial_position[j];
    now_.v[j] = scene.initial_velocity[j];
  }
  if (prescribed_) now_ = prescribed_at(0), user_ = {};
  for (unsigned i = 0; i < arm.brake_count; ++i) brakes_.emplace_back(brake_of(arm, i), actuators_of(scene, i));
  if (!intended_) {
    const arm_point tip = pose_of(arm.geometry, now_.q, now_.v).tip;
    tip_motion stays;
    std::copy_n(tip.position, 2, stays.position);
    intended_ = [stays](double) { return stays; };
  }
  kinetic_at_start_ = kinetic(now_);
}

void arm_plant::advance(double duration, double end, const arm_actuation& demand,
                        shaft_sensors (&sensors)[arm_axes]) noexcept {
  for (unsigned j = 0; j < arm_axes; ++j) motors_[j].demand({demand.motor_torque[j], 0});
  for (unsigned i = 0; i < arm_.brake_count; ++i) brakes_[i].demand({0, demand.brake_damping[i]});
  settle();
  const double until_release = user_.release_time - time_;
  const bool is_released = until_release > 0 && until_release < duration;
  for (const double stretch : {is_released ? until_release : duration, is_released ? duration - until_release : 0.0}) {
    if (!(stretch > 0)) continue;
    const double steps = std::ceil(stretch / longest_step() * (1 - 1e-9));
    for (double done = 0; done < steps; ++done) integrate(stretch / steps, sensors);
    if (is_released && time_ < end) settle();
  }
  time_ = end;
}

void arm_plant::integrate(double duration, shaft_sensors (&sensors)[arm_axes]) noexcept {
  double left = duration;
  for (unsigned changes = 0;; ++changes) {
    step candidate = attempt(left);
    bool changed[arm_axes] = {};
    if (changes == most_changes || !violates(candidate, left, changed)) return commit(candidate, left, sensors);
    double before = 0, after = left;
    for (int halving = 0; halving < 48; ++halving) {
      const double middle = (before + after) / 2;
      const step tried = attempt(middle);
      bool there[arm_axes] = {};
      if (!violates(tried, middle, there)) {
        before = middle;
        continue;
      }
      after = middle;
      candidate = tried;
      std::copy_n(there, arm_axes, changed);
    }
    commit(candidate, after, sensors);
    for (unsigned j = 0; j < arm_axes; ++j)
      if (changed[j] && !is_stuck(j)) now_.v[j] = 0;
    settle();
    left -= after;
    if (!(left > 0)) return;
  }
}

void arm_plant::commit(const step& done, double duration, shaft_sensors (&sensors)[arm_axes]) noexcept {
  const shaft_motion before[arm_axes] = {shaft(0), shaft(1)};
  for (drives& motor : motors_) motor.advance(duration);
  for (drives& brake : brakes_) brake.advance(duration);
  time_ += duration;
  now_ = done.end;
  ledger_ += done.work;
  ledger_.kinetic = kinetic(now_) - kinetic_at_start_;
  for (unsigned j = 0; j < arm_axes; ++j) sensors[j].follow(before[j], shaft(j));
}

arm_plant::drive arm_plant::drive_after(double ahead) const noexcept {
  drive driven{};
  for (unsigned j = 0; j < arm_axes; ++j) driven.torque[j] = motors_[j].torque_after(ahead);
  for (unsigned i = 0; i < arm_.brake_count; ++i) driven.damping[i] = brakes_[i].damping_after(ahead);
  return driven;
}

arm_plant::forces arm_plant::balance(double ahead, const state& at, const drive& driven) const noexcept {
  const arm_pose pose = pose_of(arm_.geometry, at.q, at.v);
  const arm_point& tip = pose.tip;
  inertia all = inertia_of(arm_, pose);
  forces result{};
  double right[arm_axes], tip_velocity[2], pull[2] = {};
  velocity_of(tip, at.v, tip_velocity);
  for (unsigned j = 0; j < arm_axes; ++j) {
    const mechanics_description& joint = arm_.joints[j].mechanics;
    right[j] = driven.torque[j] - joint.damping * at.v[j] - joint.coulomb_friction * direction_[j];
    result.power.motor += driven.torque[j] * at.v[j];
    result.power.damping += joint.damping * at.v[j] * at.v[j];
    result.power.friction += joint.coulomb_friction * direction_[j] * at.v[j];
  }
  for (unsigned i = 0; i < arm_.brake_count; ++i) {
    const double(&along)[arm_axes] = arm_.brakes[i].along;
    const double rate = along[0] * at.v[0] + along[1] * at.v[1];
    const double torque = brakes_[i].at_speed(driven.damping[i], rate) * rate;
    for (unsigned j = 0; j < arm_axes; ++j) right[j] -= torque * along[j];
    result.power.brake += torque * rate;
  }
  const bool is_held = holds_hand(ahead);
  if (is_held) {
    all.add(user_.mass, tip, tip);
    const tip_motion meant = intended_(time_ + ahead);
    for (unsigned i = 0; i < 2; ++i)
      for (unsigned k = 0; k < 2; ++k)
        pull[i] += user_.stiffness[i][k] * (meant.position[k] - tip.position[k]) +
                   user_.damping[i][k] * (meant.velocity[k] - tip_velocity[k]);
  }
  for (unsigned j = 0; j < arm_axes; ++j)
    right[j] += tip.jacobian[0][j] * pull[0] + tip.jacobian[1][j] * pull[1] - all.bias[j];

  const double(&m)[2][2] = all.mass;
  double(&a)[arm_axes] = result.acceleration;
  if (is_stuck(0)) a[1] = is_stuck(1) ? 0 : right[1] / m[1][1];
  else if (is_stuck(1)) a[0] = right[0] / m[0][0];
  else {
    const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    a[0] = (m[1][1] * right[0] - m[0][1] * right[1]) / determinant;
    a[1] = (m[0][0] * right[1] - m[1][0] * right[0]) / determinant;
  }
  for (unsigned j = 0; j < arm_axes; ++j)
    if (is_stuck(j)) result.hold[j] = m[j][0] * a[0] + m[j][1] * a[1] - right[j];
  for (unsigned i = 0; i < 2 && is_held; ++i) {
    const double acceleration = tip.jacobian[i][0] * a[0] + tip.jacobian[i][1] * a[1] + tip.centripetal[i];
    result.power.hand += (pull[i] - user_.mass * acceleration) * tip_velocity[i];
  }
  return result;
}

arm_plant::state arm_plant::prescribed_at(double time) const noexcept {
  const joints_motion meant = prescribed_(time);
  state at;
  std::copy_n(meant.position, arm_axes, at.q);
  std::copy_n(meant.velocity, arm_axes, at.v);
  return at;
}

arm_plant::step arm_plant::follow(double h) const noexcept {
  step done{};
  done.end = prescribed_at(time_ + h);
  for (const double c : gauss::c) {
    const state at = prescribed_at(time_ + c * h);
    const energy_ledger power = balance(c * h, at, drive_after(c * h)).power;
    done.work.motor += h / 2 * power.motor;
    done.work.brake += h / 2 * power.brake;
    done.work.damping += h / 2 * power.damping;
    for (unsigned j = 0; j < arm_axes; ++j) done.work.friction += h / 2 * friction(j) * std::abs(at.v[j]);
  }
  done.work.hand =
      done.work.brake + done.work.damping + done.work.friction - done.work.motor + kinetic(done.end) - kinetic(now_);
  return done;
}

arm_plant::step arm_plant::attempt(double h) const noexcept {
  if (prescribed_) return follow(h);
  const drive driven[2] = {drive_after(gauss::c[0] * h), drive_after(gauss::c[1] * h)};
  forces stage[2] = {balance(0, now_, drive_after(0)), {}};
  stage[1] = stage[0];
  double off = HUGE_VAL;
  for (int round = 0; round < 50 && off > 0; ++round) {
    state at[2];
    for (unsigned j = 0; j < arm_axes; ++j) {
      for (unsigned s = 0; s < 2; ++s)
        at[s].v[j] =
            now_.v[j] + h * (gauss::a[s][0] * stage[0].acceleration[j] + gauss::a[s][1] * stage[1].acceleration[j]);
      for (unsigned s = 0; s < 2; ++s)
        at[s].q[j] = now_.q[j] + h * (gauss::a[s][0] * at[0].v[j] + gauss::a[s][1] * at[1].v[j]);
    }
    const double before = off;
    off = 0;
    for (unsigned s = 0; s < 2; ++s) {
      const forces next = balance(gauss::c[s] * h, at[s], driven[s]);
      for (unsigned j = 0; j < arm_axes; ++j)
        off = std::max(off, std::abs(next.acceleration[j] - stage[s].acceleration[j]));
      stage[s] = next;
    }
    if (round > 3 && off >= before) break;  // rounding is all that is left
  }
  step done{};
  double mean[arm_axes];
  for (unsigned j = 0; j < arm_axes; ++j) {
    const double a0 = stage[0].acceleration[j], a1 = stage[1].acceleration[j];
    const double v0 = now_.v[j] + h * (gauss::a[0][0] * a0 + gauss::a[0][1] * a1);
    const double v1 = now_.v[j] + h * (gauss::a[1][0] * a0 + gauss::a[1][1] * a1);
    mean[j] = (v0 + v1) / 2;
    done.end.v[j] = now_.v[j] + h / 2 * (a0 + a1);
    done.end.q[j] = now_.q[j] + h * mean[j];
  }
  for (const forces& one : stage) {
    done.work.hand += h / 2 * one.power.hand;
    done.work.motor += h / 2 * one.power.motor;
    done.work.brake += h / 2 * one.power.brake;
    done.work.friction += h / 2 * one.power.friction;
    done.work.damping += h / 2 * one.power.damping;
  }
  return done;
}

bool arm_plant::is_stuck(unsigned joint) const noexcept {
  return !prescribed_ && friction(joint) > 0 && direction_[joint] == 0;
}

// Which joints cannot have gone on as they were until the end of a step.
bool arm_plant::violates(const step& candidate, double duration, bool (&joints)[arm_axes]) const noexcept {
  if (prescribed_) return false;
  const bool any_stuck = is_stuck(0) || is_stuck(1);
  const forces there = any_stuck ? balance(duration, candidate.end, drive_after(duration)) : forces{};
  for (unsigned j = 0; j < arm_axes; ++j)
    joints[j] = friction(j) > 0 &&
                (is_stuck(j) ? std::abs(there.hold[j]) > friction(j) : candidate.end.v[j] * direction_[j] < 0);
  return joints[0] || joints[1];
}

// Whether, of the joints at rest, those that stick are held by friction and the others start in the direction in which
// they slide.
bool arm_plant::is_consistent(const bool (&rests)[arm_axes]) const noexcept {
  const forces now = balance(0, now_, drive_after(0));
  for (unsigned j = 0; j < arm_axes; ++j) {
    if (!rests[j]) continue;
    if (is_stuck(j) ? std::abs(now.hold[j]) > friction(j) : !(now.acceleration[j] * direction_[j] > 0)) return false;
  }
  return true;
}

// Finds which joints at rest stick. One choice alone is consistent, since the inertia is positive definite.
void arm_plant::settle() noexcept {
  if (prescribed_) return;
  bool rests[arm_axes];
  for (unsigned j = 0; j < arm_axes; ++j) {
    rests[j] = friction(j) > 0 && now_.v[j] == 0;
    direction_[j] = sign_of(now_.v[j]);
  }
  constexpr double choices[] = {0, 1, -1};
  for (unsigned choice = 0; choice < 9; ++choice) {
    if ((choice % 3 != 0 && !rests[0]) || (choice / 3 != 0 && !rests[1])) continue;
    if (rests[0]) direction_[0] = choices[choice % 3];
    if (rests[1]) direction_[1] = choices[choice / 3];
    if (is_consistent(rests)) return;
  }
  for (unsigned j = 0; j < arm_axes; ++j)
    if (rests[j]) direction_[j] = 0;  // rounding alone tells them apart
}

double arm_plant::kinetic(const state& at) const noexcept {
  return form(inertia_of(arm_, pose_of(arm_.geometry, at.q, at.v)).mass, at.v) / 2;
}

double arm_plant::longest_step() const noexcept {
  if (stated_step_ > 0) return stated_step_;
  const arm_pose pose = pose_of(arm_.geometry, now_.q, now_.v);
  inertia all = inertia_of(arm_, pose);
  double damping[2][2] = {{arm_.joints[0].mechanics.damping, 0}, {0, arm_.joints[1].mechanics.damping}};
  double stiffness[2][2] = {}, fastest = 0.5 / period_;
  const auto at_least = [&fastest](double lag) {
    if (lag > 0) fastest = std::max(fastest, 1 / lag);
  };
  for (unsigned i = 0; i < arm_.brake_count; ++i) {
    const arm_brake& one = arm_.brakes[i];
    const double most = one.brake.max_damping + one.brake.residual_damping;
    for (unsigned j = 0; j < 2; ++j)
      for (unsigned k = 0; k < 2; ++k) damping[j][k] += most * one.along[j] * one.along[k];
    at_least(one.brake.coil_lag);
  }
  for (const device_description& joint : arm_.joints) at_least(joint.motor.amplifier_lag);
  if (holds_hand(0)) {
    all.add(user_.mass, pose.tip, pose.tip);
    add_at_joints(pose.tip, user_.stiffness, stiffness);
    add_at_joints(pose.tip, user_.damping, damping);
  }
  fastest = std::max({fastest, trace_over(all.mass, damping), 5 * std::sqrt(trace_over(all.mass, stiffness))});
  return std::max(0.5 / fastest, period_ / 64);
}

arm_view arm_plant::view() const noexcept {
  arm_view seen;
  const arm_point tip = pose_of(arm_.geometry, now_.q, now_.v).tip;
  seen.time = time_;
  for (unsigned j = 0; j < arm_axes; ++j) {
    seen.position[j] = now_.q[j];
    seen.velocity[j] = now_.v[j];
    seen.motor_torque[j] = motors_[j].torque();
    seen.stuck[j] = is_stuck(j);
    seen.tip_position[j] = tip.position[j];
  }
  velocity_of(tip, now_.v, seen.tip_velocity);
  for (unsigned i = 0; i < arm_.brake_count; ++i) {
    const double(&along)[arm_axes] = arm_.brakes[i].along;
    seen.brake_damping[i] = brakes_[i].at_speed(brakes_[i].damping(), along[0] * now_.v[0] + along[1] * now_.v[1]);
  }
  return seen;
}

arm_view arm_plant::view_under(const arm_actuation& demand) const noexcept {
  arm_view now = view();
  for (unsigned j = 0; j < arm_axes; ++j) {
    drives next = motors_[j];
    next.demand({demand.motor_torque[j], 0});
    now.motor_torque[j] = next.torque();
  }
  for (unsigned i = 0; i < arm_.brake_count; ++i) {
    drives next = brakes_[i];
    next.demand({0, demand.brake_damping[i]});
    const double(&along)[arm_axes] = arm_.brakes[i].along;
    now.brake_damping[i] = next.at_speed(next.damping_after(0), along[0] * now_.v[0] + along[1] * now_.v[1]);
  }
  return now;
}

}  // namespace dashpot::simulated
