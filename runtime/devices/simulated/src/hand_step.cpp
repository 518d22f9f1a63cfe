#include <dashpot/simulated/hand_step.hpp>

#include <cmath>
#include <utility>

#include <dashpot/simulated/gauss.hpp>

namespace dashpot::simulated {

hand_state taking_hold_at(const hand& user, double position) {
  hand_state state;
  for (unsigned i = 0; i < user.states; ++i) state.shifted[i] = -user.input[i] * position;
  return state;
}

double force_of(const hand& user, const hand_state& state, const motion_point& intended, double velocity) {
  double force = user.damping * (intended.velocity - velocity);
  for (unsigned i = 0; i < user.states; ++i) {
    force += user.output[i] * (state.shifted[i] + user.input[i] * intended.position);
  }
  return force;
}

// The slopes k of the hand's states at both stages: (I − h 𝒜⊗A) k = A (y_0 + B x_d) − B u̇, stage by stage.
class hand_step::solver {
 public:
  solver(const hand& user, double duration) : user_(user), n_(user.states), duration_(duration) {
    for (unsigned row = 0; row < 2 * n_; ++row) {
      for (unsigned column = 0; column < 2 * n_; ++column) {
        const double coefficient = gauss::a[row / n_][column / n_] * user.dynamics[row % n_][column % n_];
        inverse_[row][column] = row == column ? 1 : 0;
        left_[row][column] = inverse_[row][column] - duration * coefficient;
      }
    }
    for (unsigned k = 0; k < 2 * n_; ++k) eliminate(k);
  }

  response respond(const hand_state& state, const motion_point (&intended)[2], const double (&velocity)[2]) const {
    double slope[2][hand::max_states];
    solve(state, intended, velocity, slope);
    response answer;
    answer.end = state;
    for (unsigned i = 0; i < n_; ++i) answer.end.shifted[i] += duration_ / 2 * (slope[0][i] + slope[1][i]);
    for (unsigned stage = 0; stage < 2; ++stage) {
      hand_state there = state;
      for (unsigned i = 0; i < n_; ++i) {
        there.shifted[i] += duration_ * (gauss::a[stage][0] * slope[0][i] + gauss::a[stage][1] * slope[1][i]);
      }
      answer.force[stage] = force_of(user_, there, intended[stage], velocity[stage]);
    }
    return answer;
  }

 private:
  static constexpr unsigned most = 2 * hand::max_states;

  void solve(const hand_state& state, const motion_point (&intended)[2], const double (&velocity)[2],
             double (&slope)[2][hand::max_states]) const {
    double right[most];
    for (unsigned row = 0; row < 2 * n_; ++row) {
      const unsigned stage = row / n_;
      right[row] = -user_.input[row % n_] * velocity[stage];
      for (unsigned j = 0; j < n_; ++j) {
        right[row] += user_.dynamics[row % n_][j] * (state.shifted[j] + user_.input[j] * intended[stage].position);
      }
    }
    for (unsigned row = 0; row < 2 * n_; ++row) {
      double sum = 0;
      for (unsigned column = 0; column < 2 * n_; ++column) sum += inverse_[row][column] * right[column];
      slope[row / n_][row % n_] = sum;
    }
  }

  // Gauss and Jordan, with pivoting: in the end left_ is the identity, and inverse_ what was its inverse.
  void eliminate(unsigned k) {
    unsigned pivot = k;
    for (unsigned row = k + 1; row < 2 * n_; ++row) {
      if (std::abs(left_[row][k]) > std::abs(left_[pivot][k])) pivot = row;
    }
    std::swap(left_[k], left_[pivot]);
    std::swap(inverse_[k], inverse_[pivot]);
    add_row(k, k, 1 / left_[k][k] - 1);
    for (unsigned row = 0; row < 2 * n_; ++row) {
      if (row != k && left_[row][k] != 0) add_row(row, k, -left_[row][k]);
    }
  }

  void add_row(unsigned row, unsigned from, double factor) {
    for (unsigned column = 0; column < 2 * n_; ++column) {
      left_[row][column] += factor * left_[from][column];
      inverse_[row][column] += factor * inverse_[from][column];
    }
  }

  const hand& user_;
  unsigned n_;
  double duration_;
  double left_[most][most];
  double inverse_[most][most];
};

hand_step::hand_step(const hand& user, double duration)
    : states_(user.states), duration_(duration), damping_(user.damping) {
  const solver solve(user, duration);
  const motion_point still[2] = {};
  for (unsigned j = 0; j < states_; ++j) {
    hand_state unit;
    unit.shifted[j] = 1;
    const response answer = solve.respond(unit, still, {0, 0});
    for (unsigned stage = 0; stage < 2; ++stage) force_per_state_[stage][j] = answer.force[stage];
    for (unsigned i = 0; i < states_; ++i) end_per_state_[i][j] = answer.end.shifted[i];
  }
  for (unsigned at = 0; at < 2; ++at) {
    const double share[2] = {at == 0 ? 1.0 : 0.0, at == 1 ? 1.0 : 0.0};
    const response moved = solve.respond({}, {{share[0], 0}, {share[1], 0}}, {0, 0});
    const response pushed = solve.respond({}, still, share);
    for (unsigned stage = 0; stage < 2; ++stage) {
      force_per_position_[stage][at] = moved.force[stage];
      coupling_[stage][at] = pushed.force[stage];
    }
    for (unsigned i = 0; i < states_; ++i) {
      end_per_position_[i][at] = moved.end.shifted[i];
      end_per_velocity_[i][at] = pushed.end.shifted[i];
    }
  }
}

void hand_step::forces_at_rest(const hand_state& state, const motion_point (&intended)[2],
                               double (&at_rest)[2]) const noexcept {
  for (unsigned stage = 0; stage < 2; ++stage) {
    const double (&per_position)[2] = force_per_position_[stage];
    at_rest[stage] = damping_ * intended[stage].velocity + per_position[0] * intended[0].position +
                     per_position[1] * intended[1].position;
    for (unsigned j = 0; j < states_; ++j) at_rest[stage] += force_per_state_[stage][j] * state.shifted[j];
  }
}

hand_state hand_step::advanced(const hand_state& state, const motion_point (&intended)[2],
                               const double (&velocity)[2]) const noexcept {
  hand_state end;
  for (unsigned i = 0; i < states_; ++i) {
    double sum = 0;
    for (unsigned j = 0; j < states_; ++j) sum += end_per_state_[i][j] * state.shifted[j];
    for (unsigned at = 0; at < 2; ++at) {
      sum += end_per_position_[i][at] * intended[at].position + end_per_velocity_[i][at] * velocity[at];
    }
    end.shifted[i] = sum;
  }
  return end;
}

}  // namespace dashpot::simulated
