#include "emit/axes_response_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "axes/kinematics.hpp"
#include "axes/port_map.hpp"
#include "axes/workspace.hpp"
#include "discretise/rounding.hpp"
#include "emit/banner.hpp"
#include "source/wrapped_text.hpp"

namespace dashpot::compiler {
namespace axes {
namespace {

// A number and how far a computation that rounds after every operation may be off, in unit roundoffs and to first
// order. A sum counts the sizes of its terms, so that it holds in whatever order a law adds them.
struct Rounded {
  double value, error;

  explicit Rounded(double constant) : Rounded(constant, std::abs(constant)) {}
  Rounded(double of, double off) : value(of), error(off) {}
};

Rounded operator-(const Rounded& a) { return {-a.value, a.error}; }
Rounded operator+(const Rounded& a, const Rounded& b) {
  return {a.value + b.value, a.error + b.error + std::abs(a.value) + std::abs(b.value)};
}
Rounded operator-(const Rounded& a, const Rounded& b) { return a + -b; }
Rounded operator*(const Rounded& a, const Rounded& b) {
  return {a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + std::abs(a.value * b.value)};
}
Rounded operator/(const Rounded& a, const Rounded& b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.error + std::abs(quotient) * b.error) / std::abs(b.value) + std::abs(quotient)};
}
// Allows the root an error of a few units; a correctly rounded one has less.
Rounded sqrt(const Rounded& a) {
  const double root = std::sqrt(a.value);
  return {root, a.error / (2 * root) + 4 * root};
}
// The law's sine and cosine miss by less than 2 units (sine_error()) and round less than six times; reducing an angle
// by half turns makes an error of two units of the angle.
Rounded turned_by(double value, double slope, const Rounded& angle) {
  return {value, std::abs(slope) * (angle.error + 2 * std::abs(angle.value)) + 8};
}
Rounded sin(const Rounded& a) { return turned_by(std::sin(a.value), std::cos(a.value), a); }
Rounded cos(const Rounded& a) { return turned_by(std::cos(a.value), std::sin(a.value), a); }

// In the cell that a tip without errors is in: at its edges the next one's cubics have the same values and slopes.
Depth<Rounded> depth(const Grid& grid, const Pair<Rounded>& x) {
  const std::size_t column = place(grid, 0, x[0].value), row = place(grid, 1, x[1].value);
  std::array<Rounded, 16> c{Rounded(0), Rounded(0), Rounded(0), Rounded(0), Rounded(0), Rounded(0),
                            Rounded(0), Rounded(0), Rounded(0), Rounded(0), Rounded(0), Rounded(0),
                            Rounded(0), Rounded(0), Rounded(0), Rounded(0)};
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = Rounded(grid.cell[row * grid.columns() + column].coefficient[i]);
  return bicubic(c, x[0] - Rounded(corner(grid, 0, column)), x[1] - Rounded(corner(grid, 1, row)));
}

// Between knots the slopes are taken over a thousandth of their spacing, to either side.
Matrix<Rounded> field_at(const ViscousField& field, const Pair<Rounded>& x) {
  const Pair<double> tip{x[0].value, x[1].value};
  const Matrix<double> here = field_at(field, tip);
  const auto entry = [&](std::size_t i, std::size_t j) {
    Rounded a(here[i][j]);
    for (std::size_t axis = 0; axis < 2 && !field.is_uniform(); ++axis)
      for (const double way : {1e-3 * field.spacing[axis], -1e-3 * field.spacing[axis]}) {
        Pair<double> beside = tip;
        beside[axis] += way;
        a.error += std::abs((field_at(field, beside)[i][j] - here[i][j]) / way) * x[axis].error + 8 * std::abs(a.value);
      }
    return a;
  };
  return {{{entry(0, 0), entry(0, 1)}, {entry(1, 0), entry(1, 1)}}};
}

}  // namespace
}  // namespace axes

namespace {

using axes::Pair, axes::Rounded;

// What holds at one place: Σ g k0 w, Σ b∞ g gᵀ + JᵀAJ + Σ a (what is added) aᵀ by rows, Σ ½ k0 w².
struct Expected {
  Pair<Rounded> torque{Rounded(0), Rounded(0)};
  axes::Matrix<Rounded> damping{{{Rounded(0), Rounded(0)}, {Rounded(0), Rounded(0)}}};
  Rounded energy{0};
};

void add_damping(const Rounded& damping, const Pair<Rounded>& along, Expected& sum) {
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) sum.damping[i][j] = sum.damping[i][j] + damping * along[i] * along[j];
}

void add_port(const Compilation& port, const axes::Depth<Rounded>& depth, const Pair<Rounded>& gradient,
              Expected& sum) {
  const LinearForm& form = port.form.linear;
  const std::optional<Contact>& contact = port.network.contact;
  Rounded w = contact ? depth.value - Rounded(contact->at) : depth.value;
  if (contact && w.value < 0) w = Rounded(0, w.error);
  const Rounded stiffness(to_double(form.static_stiffness));
  Rounded force = stiffness * w;
  // reset() and output() may round w differently, and everything that relaxes answers the difference as a spring.
  for (const Mode& mode : form.modes) force.error += 2 * to_double(mode.stiffness) * w.error;
  for (std::size_t j = 0; j < 2; ++j) sum.torque[j] = sum.torque[j] + gradient[j] * force;
  sum.energy = sum.energy + Rounded(0.5) * stiffness * w * w;
  add_damping(Rounded(to_double(form.feedthrough_damping)), gradient, sum);
}

Expected expected_at(const AxesCompilation& c, const Pair<double>& joints) {
  const axes::Pose<Rounded> pose =
      axes::pose(c.device.arm, Pair<Rounded>{Rounded(joints[0], 0), Rounded(joints[1], 0)});
  Expected sum;
  for (std::size_t i = 0; i < c.ports.size(); ++i) {
    const axes::Depth<Rounded> depth = axes::depth(c.network.ports[i].map, pose.tip);
    add_port(c.ports[i], depth, axes::at_joints(pose, depth.gradient), sum);
  }
  const auto field = axes::at_joints(pose, field_at(c.network.field, pose.tip), c.network.field.is_symmetric());
  const axes::Matrix<Rounded> of_field{{{field.p, field.r + field.sigma}, {field.r - field.sigma, field.s}}};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) sum.damping[i][j] = sum.damping[i][j] + of_field[i][j];
  for (std::size_t k = 0; k < c.device.brakes.size(); ++k) {
    const Pair<double>& along = c.device.brakes[k].along;
    add_damping(Rounded(c.certificate.added[k]), {Rounded(along[0]), Rounded(along[1])}, sum);
  }
  return sum;
}

// The force felt at a velocity has a closed form only if nothing slides, touches or is gated.
std::string why_no_motion_is_played(const AxesCompilation& c) {
  if (c.certificate.gate) return "a torque limiter (gate)";
  for (const Compilation& port : c.ports) {
    if (port.network.contact) return "a contact";
    if (port.form.has_slips()) return "slips";
  }
  return "";
}

std::string number(double value) { return fmt::format("{:#}", value); }

}  // namespace

CodeModel axes_response_test_model(const AxesCompilation& c) {
  constexpr int places_a_side = 5;
  const double roundoff = unit_roundoff(c.law.scalar);
  // A law shares products and factors out what the formulas here compute apart: as many roundings again.
  const auto allowed = [&](const Rounded& number_there) { return number(2 * roundoff * number_there.error); };
  const axes::Interval far(-0.1, 0.1);  // where no device states its workspace [m]
  const std::string why_none = why_no_motion_is_played(c);
  CodeModel model;
  model.fields["name"] = c.network.name;
  const std::string about =
      fmt::format("Tests {} against the closed forms of its ports, at places of the workspace", c.network.name);
  model.lists["about"] = as_list(wrapped_text(
      why_none.empty()
          ? about
          : fmt::format("{}, at rest. Not in motion, since with {} what is felt of a velocity has no closed "
                        "form",
                        about, why_none),
      112, 0));
  model.lists["moves"];
  if (why_none.empty()) {
    std::vector<std::string> along;
    for (const AlongBrake& brake : c.device.brakes)
      along.push_back(fmt::format("{{{}, {}}}", number(brake.along[0]), number(brake.along[1])));
    model.lists["moves"].push_back({{"along", fmt::format("{}", fmt::join(along, ", "))}});
  }
  for (const axes::Place& there :
       axes::places_in(c.device.arm, c.has_device ? c.device.workspace : axes::Box{far, far}, places_a_side)) {
    const auto as_given = [&](double q) { return c.law.scalar == ScalarType::float32 ? double(float(q)) : q; };
    const Pair<double> joints{as_given(there.joints[0]), as_given(there.joints[1])};
    const Expected expected = expected_at(c, joints);
    Fields fields;
    for (std::size_t i = 0; i < 2; ++i) {
      fields[fmt::format("q{}", i)] = number(joints[i]);
      fields[fmt::format("t{}", i)] = number(expected.torque[i].value);
      fields[fmt::format("allowed_t{}", i)] = allowed(expected.torque[i]);
      for (std::size_t j = 0; j < 2; ++j) {
        fields[fmt::format("b{}{}", i, j)] = number(expected.damping[i][j].value);
        fields[fmt::format("allowed_b{}{}", i, j)] = allowed(expected.damping[i][j]);
      }
    }
    fields["energy"] = number(expected.energy.value);
    fields["allowed_energy"] = allowed(expected.energy);
    model.lists["places"].push_back(fields);
  }
  return model;
}

}  // namespace dashpot::compiler
