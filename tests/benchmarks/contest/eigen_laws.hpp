// The law in Eigen. Fixed sizes: arrays over the branches, as somebody writes it who knows that they do not mix.
// Dynamic sizes: the general state space x ← A x + B (u, v), m = C x + D (u, v), dense, as control toolboxes give it
// out.
#pragma once

#include <Eigen/Core>

#include "guards.hpp"
#include "maxwell_networks.hpp"
#include "small_networks.hpp"

namespace dashpot::contest {

template <class Network>
struct eigen_fixed {
  using branches = Eigen::Array<double, Network::size, 1>;
  branches decay = branches(constants_of<Network>.decay), drive = branches(constants_of<Network>.drive);
  branches force = branches::Zero();

  command<double> step(double position, double velocity) noexcept {
    const double sum =
        force.sum() + Network::static_stiffness * position + constants_of<Network>.velocity_gain * velocity;
    if (!is_finite(sum)) return {constants_of<Network>.brake, 0};
    force = (force.abs() > threshold).select(decay * force, 0) + drive * velocity;
    return {constants_of<Network>.brake, sum};
  }
};

// The matrices of a network.
struct state_space {
  Eigen::MatrixXd among, from;    // A, B
  Eigen::RowVectorXd to, across;  // C, D
  double brake = 0;               // [N·s/m]
};

template <class Network>
state_space state_space_of() {
  const auto& k = constants_of<Network>;
  constexpr int n = Network::size;
  state_space s{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, 2), Eigen::RowVectorXd::Ones(n),
                Eigen::RowVectorXd(2), k.brake};
  for (int i = 0; i < n; ++i) {
    s.among(i, i) = k.decay[i];
    s.from(i, 1) = k.drive[i];
  }
  s.across << Network::static_stiffness, k.velocity_gain;
  return s;
}

// x ← α u + β v + γ x, with the left-hand side of (10).
template <>
inline state_space state_space_of<two_kelvins>() {
  const double stiffness = two_kelvins::stiffness[0], damping = two_kelvins::damping[0];
  const double rate = (damping + two_kelvins::damping[1]) / period,
               whole = stiffness + two_kelvins::stiffness[1] + rate;
  state_space s{Eigen::MatrixXd(1, 1), Eigen::MatrixXd(1, 2), Eigen::RowVectorXd(1), Eigen::RowVectorXd(2), damping};
  s.among << rate / whole;
  s.from << stiffness / whole, damping / whole;
  const double of_state = stiffness + damping / period;
  s.to << damping / period - of_state * s.among(0, 0);
  s.across << stiffness - of_state * s.from(0, 0), -of_state * s.from(0, 1);
  return s;
}

template <class Network>
struct eigen_dynamic {
  state_space matrices = state_space_of<Network>();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(matrices.among.rows()), next = state;

  command<double> step(double position, double velocity) noexcept {
    const Eigen::Vector2d input(position, velocity);
    const double force = matrices.to.dot(state) + matrices.across.dot(input);
    if (!is_finite(force)) return {matrices.brake, 0};
    next.noalias() = matrices.among * state;
    next.noalias() += matrices.from * input;
    state = (next.array().abs() > threshold).select(next, 0);
    return {matrices.brake, force};
  }
};

// Two Kelvins in fixed sizes: the state space again, its sizes known.
struct eigen_fixed_kelvin {
  Eigen::Matrix<double, 1, 1> among, to, state = Eigen::Matrix<double, 1, 1>::Zero();
  Eigen::RowVector2d from, across;
  eigen_fixed_kelvin() {
    const state_space s = state_space_of<two_kelvins>();
    among = s.among;
    to = s.to;
    from = s.from;
    across = s.across;
  }

  command<double> step(double position, double velocity) noexcept {
    const Eigen::Vector2d input(position, velocity);
    const double force = to.dot(state) + across.dot(input);
    if (!is_finite(force)) return {two_kelvins::damping[0], 0};
    state = (state.array().abs() > threshold).select(among * state, 0) + from * input;
    return {two_kelvins::damping[0], force};
  }
};

}  // namespace dashpot::contest
