#include <dashpot/simulated/compliant_plant.hpp>

#include <cmath>
#include <utility>

#include <dashpot/simulated/gauss.hpp>

namespace dashpot::simulated {
namespace {

constexpr double turn = 2 * 3.14159265358979323846;

double reduced_mass(const mechanics_description& mechanics) {
  return mechanics.mode.mass * (mechanics.inertia - mechanics.mode.mass) / mechanics.inertia;
}

// Gauss's elimination with the largest pivot; the matrix is never singular, as inertias stand on its diagonal.
void solve(double (&matrix)[4][4], double (&right)[4]) {
  for (unsigned k = 0; k < 4; ++k) {
    unsigned pivot = k;
    for (unsigned row = k + 1; row < 4; ++row)
      if (std::abs(matrix[row][k]) > std::abs(matrix[pivot][k])) pivot = row;
    std::swap(right[k], right[pivot]);
    for (unsigned column = 0; column < 4; ++column) std::swap(matrix[k][column], matrix[pivot][column]);
    for (unsigned row = k + 1; row < 4; ++row) {
      const double factor = matrix[row][k] / matrix[k][k];
      for (unsigned column = k; column < 4; ++column) matrix[row][column] -= factor * matrix[k][column];
      right[row] -= factor * right[k];
    }
  }
  for (unsigned k = 4; k-- > 0;) {
    for (unsigned column = k + 1; column < 4; ++column) right[k] -= matrix[k][column] * right[column];
    right[k] /= matrix[k][k];
  }
}

}  // namespace

compliant_plant::compliant_plant(const device_description& device, const scenario& scene)
    : stepped_plant(device, scene),
      shaft_inertia_(mechanics_.inertia - mechanics_.mode.mass),
      stiffness_(reduced_mass(mechanics_) * turn * mechanics_.mode.frequency * turn * mechanics_.mode.frequency),
      structure_damping_(2 * mechanics_.mode.damping_ratio * reduced_mass(mechanics_) * turn *
                         mechanics_.mode.frequency),
      half_backlash_(mechanics_.backlash / 2) {
  shaft_ = tool_ = {0, scene.initial_position / ratio_, scene.initial_velocity / ratio_};
  grip_ = taking_hold_at(user_, tool_.position);
  kinetic_at_start_ = kinetic();
  settle();
}

void compliant_plant::commit(const step& done, shaft_sensors& sensors) noexcept {
  sensors.follow(shaft_, done.shaft);
  shaft_ = done.shaft;
  tool_ = done.tool;
  grip_ = done.grip;
  drives_.advance(done.duration);
  ledger_ += done.work;
  ledger_.kinetic = kinetic() - kinetic_at_start_;
}

compliant_plant::step compliant_plant::attempt(double duration, const hand_step& grip) const noexcept {
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
  const double end = shaft_.time + duration;
  step done;
  done.duration = duration;
  done.shaft = {end, shaft_.position + duration / 2 * (s.shaft[0] + s.shaft[1]), gauss::end(shaft_.velocity, s.shaft)};
  done.tool = {end, tool_.position + duration / 2 * (s.tool[0] + s.tool[1]), gauss::end(tool_.velocity, s.tool)};
  done.grip = grip.advanced(grip_, intention, s.tool);
  add_work(s, grip, done);
  return done;
}

// Inertia/h Σ_j ā_ij (v_j − v_0) = forces at stage i, ā the inverse of a, for shaft and tool; all but the brake's.
compliant_plant::stage_equations compliant_plant::equations(const stages& s, const hand_step& grip,
                                                            double duration) const noexcept {
  const double shaft_rate = shaft_inertia_ / duration, tool_rate = (mechanics_.mode.mass + user_.mass) / duration;
  const double stop_stiffness = low_.stiffness() + high_.stiffness();
  const double pull = stiffness() * (tool_.position - shaft_.position - offset());
  stage_equations e;
  for (unsigned i = 0; i < 2; ++i) {
    e.right[i] = s.torque[i] - direction_ * mechanics_.coulomb_friction + pull;
    e.right[2 + i] = s.grip[i] - stop_force(tool_.position, 0) - pull;
    for (unsigned j = 0; j < 2; ++j) {
      e.right[i] += shaft_rate * gauss::a_inverse[i][j] * shaft_.velocity;
      e.right[2 + i] += tool_rate * gauss::a_inverse[i][j] * tool_.velocity;
      e.matrix[i][j] = shaft_rate * gauss::a_inverse[i][j];
      e.matrix[2 + i][2 + j] =
          tool_rate * gauss::a_inverse[i][j] - grip.coupling(i, j) + stop_stiffness * duration * gauss::a[i][j];
    }
    e.matrix[i][i] += mechanics_.damping;
    e.matrix[2 + i][2 + i] += low_.damping() + high_.damping();
  }
  couple(e, duration);
  return e;
}

// What the structure's spring and damper do within the step; a stuck shaft does not move.
void compliant_plant::couple(stage_equations& e, double duration) const noexcept {
  for (unsigned i = 0; i < 2; ++i)
    for (unsigned j = 0; j < 2; ++j) {
      const double force = stiffness() * duration * gauss::a[i][j] + (i == j ? structure_damping() : 0);
      e.matrix[i][j] += force;
      e.matrix[i][2 + j] -= force;
      e.matrix[2 + i][j] -= force;
      e.matrix[2 + i][2 + j] += force;
    }
  if (!stuck_) return;
  for (unsigned i = 0; i < 2; ++i) {
    for (double& entry : e.matrix[i]) entry = 0;
    e.matrix[i][i] = 1;
    e.right[i] = 0;
  }
}

// Solves for the stage velocities; the brake's damping fades with the shaft's (plant.cpp).
void compliant_plant::balance(stages& s, const stage_equations& without_brake) const noexcept {
  constexpr int most_rounds = 8;
  const double at_no_speed[2] = {s.damping[0], s.damping[1]};
  s.shaft[0] = s.shaft[1] = shaft_.velocity;
  for (int round = 0; round < most_rounds; ++round) {
    const double guess[2] = {s.shaft[0], s.shaft[1]};
    stage_equations e = without_brake;
    for (unsigned i = 0; i < 2; ++i) {
      s.damping[i] = drives_.at_speed(at_no_speed[i], guess[i]);
      if (!stuck_) e.matrix[i][i] += s.damping[i];
    }
    solve(e.matrix, e.right);
    for (unsigned i = 0; i < 2; ++i) s.shaft[i] = e.right[i], s.tool[i] = e.right[2 + i];
    if (!drives_.fades_with_speed() || (s.shaft[0] == guess[0] && s.shaft[1] == guess[1])) break;
  }
}

void compliant_plant::add_work(const stages& s, const hand_step& grip, step& done) const noexcept {
  const double weight = done.duration / 2;
  for (unsigned i = 0; i < 2; ++i) {
    const double v = s.shaft[i], w = s.tool[i];
    double hand = s.grip[i], acceleration = 0, position = tool_.position;
    double deflection = tool_.position - shaft_.position - offset();
    for (unsigned j = 0; j < 2; ++j) {
      hand += grip.coupling(i, j) * s.tool[j];
      acceleration += gauss::a_inverse[i][j] * (s.tool[j] - tool_.velocity) / done.duration;
      position += done.duration * gauss::a[i][j] * s.tool[j];
      deflection += done.duration * gauss::a[i][j] * (s.tool[j] - s.shaft[j]);
    }
    done.work.hand += weight * (hand - user_.mass * acceleration) * w;
    done.work.motor += weight * s.torque[i] * v;
    done.work.brake += weight * s.damping[i] * v * v;
    done.work.damping += weight * mechanics_.damping * v * v;
    done.work.friction += weight * direction_ * mechanics_.coulomb_friction * v;
    done.work.stop += weight * stop_force(position, w) * w;
    done.work.mode += weight * (stiffness() * deflection + structure_damping() * (w - v)) * (w - v);
  }
}

// Whether the step has ended in the same state of sticking, sliding, engagement and touching as it began in.
bool compliant_plant::is_consistent(const step& candidate) const noexcept {
  if (half_backlash_ > 0 && would_engage(candidate.shaft, candidate.tool) != side_) return false;
  if (!low_.is_settled(candidate.tool) || !high_.is_settled(candidate.tool)) return false;
  if (stuck_)
    return std::abs(drives_.torque_after(candidate.duration) + structure_force(candidate.shaft, candidate.tool)) <=
           mechanics_.coulomb_friction;
  return direction_ * candidate.shaft.velocity >= 0;
}

// After an event: what shaft and tool do from here on.
void compliant_plant::settle() noexcept {
  low_.touch(tool_);
  high_.touch(tool_);
  if (half_backlash_ > 0) side_ = would_engage(shaft_, tool_);
  if (!(mechanics_.coulomb_friction > 0)) return;
  if (direction_ * shaft_.velocity < 0) shaft_.velocity = 0;
  const double force = drives_.torque() + structure_force(shaft_, tool_);
  stuck_ = shaft_.velocity == 0 && std::abs(force) <= mechanics_.coulomb_friction;
  const double along = shaft_.velocity != 0 ? shaft_.velocity : force;
  direction_ = stuck_ ? 0 : along > 0 ? 1 : -1;
}

// On which side of the backlash the structure pushes; 0: on neither.
int compliant_plant::would_engage(const shaft_motion& shaft, const shaft_motion& tool) const noexcept {
  const double ahead = tool.position - shaft.position;
  if (std::abs(ahead) <= half_backlash_) return 0;
  const int side = ahead > 0 ? 1 : -1;
  const double push =
      stiffness_ * (ahead - side * half_backlash_) + structure_damping_ * (tool.velocity - shaft.velocity);
  return side * push > 0 ? side : 0;
}

// Along +q on the shaft.
double compliant_plant::structure_force(const shaft_motion& shaft, const shaft_motion& tool) const noexcept {
  return stiffness() * (tool.position - shaft.position - offset()) +
         structure_damping() * (tool.velocity - shaft.velocity);
}

double compliant_plant::kinetic() const noexcept {
  return (shaft_inertia_ * shaft_.velocity * shaft_.velocity + mechanics_.mode.mass * tool_.velocity * tool_.velocity) /
         2;
}

plant_view compliant_plant::view() const noexcept {
  plant_view seen = view_of_shaft();
  seen.tool_position = tool_.position;
  seen.tool_velocity = tool_.velocity;
  seen.stop_torque = stop_force(tool_.position, tool_.velocity);
  seen.stuck = stuck_;
  const double pull = structure_force(shaft_, tool_);
  seen.friction_torque = stuck_ ? seen.motor_torque + pull : direction_ * mechanics_.coulomb_friction;
  const double grip = force_of(user_, grip_, intended(shaft_.time), tool_.velocity);
  const double acceleration = (grip - seen.stop_torque - pull) / (mechanics_.mode.mass + user_.mass);
  seen.hand_torque = grip - user_.mass * acceleration;
  return seen;
}

}  // namespace dashpot::simulated
