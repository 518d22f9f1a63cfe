#include <dashpot/simulated/hand.hpp>

#include <algorithm>
#include <cmath>

namespace dashpot::simulated {
namespace {

constexpr unsigned most = hand::max_states + 1;

// [−(A + Aᵀ), Cᵀ − B; C − Bᵀ, 2D], the power that the hand dissipates, twice, as a quadratic form in (z, w).
void fill_dissipation(const hand& user, double (&form)[most][most]) {
  const unsigned n = user.states;
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = 0; j < n; ++j) form[i][j] = -user.dynamics[i][j] - user.dynamics[j][i];
    form[i][n] = form[n][i] = user.output[i] - user.input[i];
  }
  form[n][n] = 2 * user.damping;
}

// By elimination: a semidefinite form has no negative pivot, and nothing beside a pivot of zero.
bool is_semidefinite(double (&form)[most][most], unsigned size, double rounding) {
  for (unsigned k = 0; k < size; ++k) {
    const double pivot = form[k][k];
    if (!(pivot >= -rounding)) return false;
    for (unsigned i = k + 1; i < size; ++i) {
      if (pivot <= rounding) {
        if (!(std::abs(form[i][k]) <= rounding)) return false;
        continue;
      }
      for (unsigned j = k + 1; j < size; ++j) form[i][j] -= form[i][k] * form[k][j] / pivot;
    }
  }
  return true;
}

}  // namespace

hand no_hand() { return {}; }

hand mass_spring_damper(double mass, double damping, double stiffness) {
  hand user;
  user.mass = mass;
  user.damping = damping;
  user.states = stiffness > 0 ? 1 : 0;
  user.input[0] = user.output[0] = std::sqrt(stiffness);
  return user;
}

hand relaxed_hand() { return mass_spring_damper(0.8, 5.5, 30); }
hand firm_hand() { return mass_spring_damper(0.55, 6.5, 135); }
hand stiff_grasp() { return mass_spring_damper(0, 8, 400); }

bool is_passive(const hand& user) {
  double form[most][most] = {};
  fill_dissipation(user, form);
  double largest = 0;
  for (const auto& row : form) {
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  }
  // Elimination of at most seven rows loses at most a few dozen units in the last place of the largest entry.
  return user.mass >= 0 && is_semidefinite(form, user.states + 1, 1e-14 * largest);
}

hand at_joint(const hand& user, double arm_radius) {
  hand scaled = user;
  scaled.mass *= arm_radius * arm_radius;
  scaled.damping *= arm_radius * arm_radius;
  for (double& gain : scaled.input) gain *= arm_radius;
  for (double& gain : scaled.output) gain *= arm_radius;
  return scaled;
}

}  // namespace dashpot::simulated
