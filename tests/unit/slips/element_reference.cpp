#include "element_reference.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace dashpot::testing {
namespace {

using Number = ElementReference::Number;
using Vector = std::vector<Number>;
using Matrix = std::vector<Vector>;

constexpr int at_ground = -1, at_tool = -2;

Matrix square(std::size_t size) { return Matrix(size, Vector(size, Number(0))); }

// Gauss elimination with row pivots; several right-hand sides as columns.
Matrix solved(Matrix a, Matrix b) {
  const std::size_t n = a.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (abs(a[r][c]) > abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c || a[r][c] == 0) continue;
      const Number factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
      for (std::size_t k = 0; k < b[r].size(); ++k) b[r][k] -= factor * b[c][k];
    }
  }
  for (std::size_t r = 0; r < n; ++r)
    for (Number& value : b[r]) value /= a[r][r];
  return b;
}

Matrix inverse(const Matrix& a) {
  Matrix one = square(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) one[i][i] = 1;
  return solved(a, one);
}

}  // namespace

ElementReference::ElementReference(const compiler::Network& network, double sample_period) {
  inner_ = static_cast<int>(network.nodes.size()) - 2;
  if (network.contact) add_contact(network.contact->at);
  for (const compiler::Element& element : network.elements) {
    Branch branch{row_of(element.a), row_of(element.b)};
    if (const auto* slip = std::get_if<compiler::Slip>(&element.law)) {
      slips_.push_back(branch);
      lowest_.push_back(-slip->yield_force);
      highest_.push_back(slip->yield_force);
      continue;
    }
    if (const auto* spring = std::get_if<compiler::Spring>(&element.law))
      branch.spring = branch.companion = spring->stiffness;
    if (const auto* damper = std::get_if<compiler::Damper>(&element.law))
      branch.companion = Number(damper->damping) / sample_period;
    linear_.push_back(branch);
  }
  signs_.assign(slips_.size(), 0);
  build();
}

int ElementReference::row_of(compiler::NodeIndex node) const {
  if (node == compiler::ground) return at_ground;
  if (node == compiler::tool) return surface_row_ >= 0 ? surface_row_ : at_tool;
  return static_cast<int>(node) - 2;
}

void ElementReference::add_contact(double at) {
  surface_row_ = inner_++;
  at_ = position_ = at;
  slips_.push_back({at_tool, surface_row_});
  lowest_.push_back(0);
  highest_.push_back(Number("1e300"));
}

void ElementReference::build() {
  Number scale = 0;
  for (const Branch& branch : linear_) scale = std::max(scale, branch.companion);
  Matrix stiffness = square(static_cast<std::size_t>(inner_));
  for (std::size_t i = 0; i < stiffness.size(); ++i) stiffness[i][i] = scale * Number("1e-30");
  for (const Branch& branch : linear_)
    for (const auto& [row, column, sign] : {std::tuple(branch.a, branch.a, 1), std::tuple(branch.b, branch.b, 1),
                                            std::tuple(branch.a, branch.b, -1), std::tuple(branch.b, branch.a, -1)})
      if (row >= 0 && column >= 0)
        stiffness[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] += sign * branch.companion;
  give_ = inverse(stiffness);
  slip_give_ = square(slips_.size());
  for (std::size_t j = 0; j < slips_.size(); ++j) {
    Vector load(static_cast<std::size_t>(inner_), Number(0)), moved = load;
    add_to(load, slips_[j], 1);
    for (std::size_t r = 0; r < moved.size(); ++r)
      for (std::size_t c = 0; c < load.size(); ++c) moved[r] += give_[r][c] * load[c];
    for (std::size_t i = 0; i < slips_.size(); ++i) slip_give_[i][j] = elongation(slips_[i], moved, 0);
    slip_give_[j][j] += Number("1e-30") / scale;
  }
}

Number ElementReference::elongation(const Branch& branch, const Vector& inner, const Number& tool) const {
  const auto at = [&](int row) {
    return row >= 0 ? inner[static_cast<std::size_t>(row)] : row == at_tool ? tool : Number(0);
  };
  return at(branch.a) - at(branch.b);
}

void ElementReference::add_to(Vector& rows, const Branch& branch, const Number& force) const {
  if (branch.a >= 0) rows[static_cast<std::size_t>(branch.a)] += force;
  if (branch.b >= 0) rows[static_cast<std::size_t>(branch.b)] -= force;
}

double ElementReference::step(double position) {
  const Number change = Number(position) - position_;  // without a contact; with it from where the surface is
  position_ = position;
  const auto inner = static_cast<std::size_t>(inner_);
  const Vector rest(inner, Number(0));
  Vector load(inner, Number(0)), moved(inner, Number(0)), gap;
  const auto move = [&] {
    for (std::size_t r = 0; r < inner; ++r) {
      moved[r] = 0;
      for (std::size_t c = 0; c < inner; ++c) moved[r] -= give_[r][c] * load[c];
    }
  };
  for (const Branch& branch : linear_)
    add_to(load, branch, branch.force + branch.companion * elongation(branch, rest, change));
  move();
  for (const Branch& slip : slips_) gap.push_back(elongation(slip, moved, change));
  const Vector slip_forces = solve_box(gap);
  for (std::size_t i = 0; i < slips_.size(); ++i) add_to(load, slips_[i], slip_forces[i]);
  move();
  Number force = 0;
  const auto pull = [&](const Branch& branch, const Number& own) {
    if (branch.a == at_tool) force += own;
    if (branch.b == at_tool) force -= own;
    largest_force_ = std::max(largest_force_, std::abs(own.convert_to<double>()));
  };
  for (Branch& branch : linear_) {
    const Number stretched = elongation(branch, moved, change);
    pull(branch, branch.force + branch.companion * stretched);
    branch.force += branch.spring * stretched;
  }
  for (std::size_t i = 0; i < slips_.size(); ++i) pull(slips_[i], slip_forces[i]);
  if (surface_row_ >= 0) {
    surface_ += moved[static_cast<std::size_t>(surface_row_)];
    position_ = at_ + surface_;
  }
  return force.convert_to<double>();
}

double ElementReference::stored_energy() const {
  Number energy = 0;
  for (const Branch& branch : linear_)
    if (branch.spring > 0) energy += branch.force * branch.force / (2 * branch.spring);
  return energy.convert_to<double>();
}

// Forces for which no slip within its yield moves, and none moves against its force.
Vector ElementReference::solve_box(const Vector& without_slips) {
  int most = 1000;
  Vector forces = forces_for(without_slips);
  while (!correct(without_slips, forces)) {
    if (--most == 0) throw std::runtime_error("the reference finds no pattern of slips");
    forces = forces_for(without_slips);
  }
  return forces;
}

Vector ElementReference::forces_for(const Vector& without_slips) const {
  Vector forces(slips_.size(), Number(0));
  std::vector<std::size_t> stuck;
  for (std::size_t i = 0; i < slips_.size(); ++i) {
    forces[i] = signs_[i] == 0 ? Number(0) : signs_[i] < 0 ? lowest_[i] : highest_[i];
    if (signs_[i] == 0) stuck.push_back(i);
  }
  Matrix give = square(stuck.size()), gap(stuck.size(), Vector(1, Number(0)));
  for (std::size_t r = 0; r < stuck.size(); ++r) {
    gap[r][0] = without_slips[stuck[r]];
    for (std::size_t j = 0; j < slips_.size(); ++j)
      if (signs_[j] != 0) gap[r][0] -= slip_give_[stuck[r]][j] * forces[j];
    for (std::size_t c = 0; c < stuck.size(); ++c) give[r][c] = slip_give_[stuck[r]][stuck[c]];
  }
  const Matrix held = solved(give, gap);
  for (std::size_t r = 0; r < stuck.size(); ++r) forces[stuck[r]] = held[r][0];
  return forces;
}

// False after changing the first slip that is wrong.
bool ElementReference::correct(const Vector& gap, const Vector& forces) {
  for (std::size_t i = 0; i < slips_.size(); ++i) {
    Number moves = gap[i];
    for (std::size_t j = 0; j < slips_.size(); ++j) moves -= slip_give_[i][j] * forces[j];
    const bool gives_up = signs_[i] == 0 && (forces[i] < lowest_[i] || forces[i] > highest_[i]);
    const bool turns_back = signs_[i] != 0 && signs_[i] * moves < 0;
    if (!gives_up && !turns_back) continue;
    signs_[i] = turns_back ? 0 : forces[i] > highest_[i] ? 1 : -1;
    return false;
  }
  return true;
}

}  // namespace dashpot::testing
