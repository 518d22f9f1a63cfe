#include <dashpot/simulated/hand_step.hpp>

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

// Solves (I − h 𝒜⊗A) k = r for the slopes k of the hand's states at both stages, r being a drive at one stage. The
// number of states is known at compile time: where samples come with jitter, no two steps are equally long, and each is
// solved.
template <unsigned n_>
class hand_step::solver {
 public:
  solver(const hand& user, double duration) : user_(user), duration_(duration) {
    for (unsigned row = 0; row < 2 * n_; ++row) {
      for (unsigned column = 0; column < 2 * n_; ++column) {
        const double coefficient = gauss::a[row / n_][column / n_] * user.dynamics[row % n_][column % n_];
        inverse_[row][column] = row == column ? 1 : 0;
        left_[row][column] = inverse_[row][column] - duration * coefficient;
      }
    }
    for (unsigned k = 0; k < 2 * n_; ++k) eliminate(k);
  }

  // `drive` acts at stage `at` alone.
  void push(unsigned at, const double* drive) {
    for (unsigned row = 0; row < 2 * n_; ++row) {
      slope_[row] = 0;
      for (unsigned j = 0; j < n_; ++j) slope_[row] += inverse_[row][at * n_ + j] * drive[j];
    }
  }

  // What the slopes add to state i by the end of the step, and to the force at a stage.
  double end(unsigned i) const { return duration_ / 2 * (slope_[i] + slope_[n_ + i]); }
  double force(unsigned stage) const {
    double sum = 0;
    for (unsigned i = 0; i < n_; ++i) {
      sum += user_.output[i] * (gauss::a[stage][0] * slope_[i] + gauss::a[stage][1] * slope_[n_ + i]);
    }
    return duration_ * sum;
  }

 private:
  // Gauss and Jordan: in the end left_ is the identity, and inverse_ what was its inverse. Without pivoting: a passive
  // hand has A + Aᵀ ≤ 0, so I − hA/4 has a symmetric part of at least 1, and what is left of the second stage,
  // 4/3 (I − hA/4) − 2/3 I + 1/3 (I − hA/4)⁻¹, one of at least 2/3.
  void eliminate(unsigned k) {
    const double pivot = left_[k][k];
    for (unsigned column = 0; column < 2 * n_; ++column) {
      left_[k][column] /= pivot;
      inverse_[k][column] /= pivot;
    }
    for (unsigned row = 0; row < 2 * n_; ++row) {
      if (row != k) add_row(row, k, -left_[row][k]);
    }
  }

  void add_row(unsigned row, unsigned from, double factor) {
    for (unsigned column = 0; column < 2 * n_; ++column) {
      left_[row][column] += factor * left_[from][column];
      inverse_[row][column] += factor * inverse_[from][column];
    }
  }

  const hand& user_;
  double duration_;
  double left_[2 * n_][2 * n_];
  double inverse_[2 * n_][2 * n_];
  double slope_[2 * n_];
};

// ż = A (y + B x_d) − B u̇ and f = C (y + B x_d) + D (ẋ_d − u̇), for a unit of each x_d, u̇ and y in turn.
hand_step::hand_step(const hand& user, double duration)
    : states_(user.states), duration_(duration), damping_(user.damping) {
  static_assert(hand::max_states == 6);
  switch (states_) {
    case 1: solve<1>(user); break;
    case 2: solve<2>(user); break;
    case 3: solve<3>(user); break;
    case 4: solve<4>(user); break;
    case 5: solve<5>(user); break;
    case 6: solve<6>(user); break;
    default: solve_without_states();
  }
}

void hand_step::solve_without_states() {
  for (unsigned stage = 0; stage < 2; ++stage) {
    for (unsigned at = 0; at < 2; ++at) {
      force_per_position_[stage][at] = 0;
      coupling_[stage][at] = stage == at ? -damping_ : 0;
    }
  }
}

template <unsigned n>
void hand_step::solve(const hand& user) {
  solver<n> answer(user, duration_);
  for (unsigned at = 0; at < 2; ++at) {
    push_position(user, answer, at);
    push_velocity(user, answer, at);
  }
  for (unsigned j = 0; j < n; ++j) push_state(user, answer, j);
}

template <unsigned n>
void hand_step::push_position(const hand& user, solver<n>& answer, unsigned at) {
  double drive[n];    // A B
  double prompt = 0;  // C B
  for (unsigned i = 0; i < n; ++i) {
    drive[i] = 0;
    for (unsigned j = 0; j < n; ++j) drive[i] += user.dynamics[i][j] * user.input[j];
    prompt += user.output[i] * user.input[i];
  }
  answer.push(at, drive);
  for (unsigned i = 0; i < n; ++i) end_per_position_[i][at] = answer.end(i);
  for (unsigned stage = 0; stage < 2; ++stage) {
    force_per_position_[stage][at] = answer.force(stage) + (stage == at ? prompt : 0);
  }
}

template <unsigned n>
void hand_step::push_velocity(const hand& user, solver<n>& answer, unsigned at) {
  answer.push(at, user.input);
  for (unsigned i = 0; i < n; ++i) end_per_velocity_[i][at] = -answer.end(i);
  for (unsigned stage = 0; stage < 2; ++stage) {
    coupling_[stage][at] = -answer.force(stage) - (stage == at ? damping_ : 0);
  }
}

// A state drives the others at both stages alike.
template <unsigned n>
void hand_step::push_state(const hand& user, solver<n>& answer, unsigned j) {
  double drive[n];
  for (unsigned i = 0; i < n; ++i) {
    drive[i] = user.dynamics[i][j];
    end_per_state_[i][j] = i == j ? 1 : 0;
  }
  for (auto& per_state : force_per_state_) per_state[j] = user.output[j];
  for (unsigned at = 0; at < 2; ++at) {
    answer.push(at, drive);
    for (unsigned i = 0; i < n; ++i) end_per_state_[i][j] += answer.end(i);
    for (unsigned stage = 0; stage < 2; ++stage) force_per_state_[stage][j] += answer.force(stage);
  }
}

void hand_step::forces_at_rest(const hand_state& state, const motion_point (&intended)[2],
                               double (&at_rest)[2]) const noexcept {
  for (unsigned stage = 0; stage < 2; ++stage) {
    const double(&per_position)[2] = force_per_position_[stage];
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
