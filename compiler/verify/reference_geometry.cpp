#include "verify/reference_geometry.hpp"

#include <fmt/format.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "network/match.hpp"

namespace dashpot::compiler {
namespace {

using Row = std::vector<Reference>;

Reference pi() { return boost::math::constants::pi<Reference>(); }

// The coefficients, lowest power first, of the polynomial through (z_i, f_i): Vandermonde's equations by elimination.
Row coefficients_through(const Row& z, const Row& f) {
  const std::size_t n = z.size();
  std::vector<Row> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    Reference power = 1;
    for (std::size_t j = 0; j < n; ++j, power *= z[i]) rows[i].push_back(power);
    rows[i].push_back(f[i]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto largest = std::max_element(rows.begin() + std::ptrdiff_t(k), rows.end(),
                                          [&](const Row& a, const Row& b) { return abs(a[k]) < abs(b[k]); });
    std::swap(rows[k], *largest);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Reference share = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= share * rows[k][j];
    }
  }
  Row result;
  for (std::size_t k = 0; k < n; ++k) result.push_back(rows[k][n] / rows[k][k]);
  return result;
}

// At the Chebyshev nodes of 0 ≤ z ≤ π²/4: sin(√z)/√z and cos(√z).
Row circular_polynomial(std::size_t terms, bool is_sine) {
  Row nodes, values;
  for (std::size_t i = 0; i < terms; ++i) {
    nodes.push_back(pi() * pi() / 8 * (1 + cos(pi() * Reference(2 * i + 1) / Reference(2 * terms))));
    const Reference root = sqrt(nodes.back());
    values.push_back(is_sine ? Reference(sin(root) / root) : Reference(cos(root)));
  }
  return coefficients_through(nodes, values);
}

void add_circular(ScalarType scalar, std::map<std::string, Reference>& all) {
  const bool is_double = scalar == ScalarType::float64;
  const std::size_t terms = is_double ? 8 : 5;
  for (const bool is_sine : {true, false}) {
    const Row polynomial = circular_polynomial(is_sine ? terms : terms + 1, is_sine);
    for (std::size_t i = 0; i < polynomial.size(); ++i)
      all[fmt::format("{}_term_{}", is_sine ? "sine" : "cosine", i)] = abs(polynomial[i]);
  }
  const Reference first = ldexp(floor(ldexp(pi(), is_double ? 31 : 10)), is_double ? -31 : -10);
  for (int eighths = 1; eighths <= 33; ++eighths) {
    const std::string name = fmt::format("eighth_turns_{}", eighths);
    all[name] = first * eighths / 4;
    all[name + "_rest"] = (pi() - first) * eighths / 4;
  }
  all["root_of_half"] = sqrt(Reference(0.5));
  all["half_turns_per_radian"] = 1 / pi();
  all["half_turn"] = first;
  all["half_turn_rest"] = pi() - first;
  all["rounder"] = ldexp(Reference(3), is_double ? 51 : 22);
}

// As double precision has it, from which a law in float takes it.
Reference in_double(const Reference& value) { return value.convert_to<double>(); }

Reference squared(double value) { return in_double(Reference(value) * Reference(value)); }

void add_map(const Port& port, std::map<std::string, Reference>& all) {
  match(
      port.map, [&](const axes::Plane& plane) { all[port.name + "_offset"] = abs(Reference(plane.offset)); },
      [&](const axes::Circle& circle) {
        all[port.name + "_centre_x"] = abs(Reference(circle.centre[0]));
        all[port.name + "_centre_y"] = abs(Reference(circle.centre[1]));
        all[port.name + "_radius"] = circle.radius;
      },
      [&](const axes::Band& band) { all[port.name + "_radius"] = band.radius; },
      [&](const axes::Grid& grid) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          const char* const of = axis == 0 ? "x" : "y";
          all[fmt::format("{}_cells_per_length_{}", port.name, of)] = in_double(1 / Reference(grid.spacing[axis]));
          all[fmt::format("{}_grid_before_{}", port.name, of)] =
              abs(in_double(Reference(grid.start[axis]) - Reference(grid.spacing[axis])));
          all[fmt::format("{}_last_cell_{}", port.name, of)] = Reference(double(grid.knots[axis]));
        }
      });
}

}  // namespace

std::map<std::string, Reference> reference_geometry(const AxesCompilation& c) {
  const axes::Arm& arm = c.device.arm;
  std::map<std::string, Reference> all{{"one", 1},
                                       {"half", 0.5},
                                       {"quarter", 0.25},
                                       {"eight", 8},
                                       {"nothing", 0},
                                       {"proximal_link", arm.proximal},
                                       {"distal_link", arm.distal},
                                       {"distal_link_squared", squared(arm.distal)},
                                       {"base", arm.base},
                                       {"half_base", Reference(arm.base) / 2},
                                       {"blunting_squared", squared(axes::blunting)}};
  add_circular(c.law.scalar, all);
  for (std::size_t k = 0; k < c.device.brakes.size(); ++k) {
    const brake_description& brake = c.device.brakes[k].brake;
    const Reference added = c.certificate.added[k];
    all[fmt::format("added_damping_{}", k + 1)] = added;
    if (brake.kind != brake_kind::none)
      all[fmt::format("most_damping_{}", k + 1)] = in_double(Reference(brake.max_damping) - added);
  }
  for (const Port& port : c.network.ports) add_map(port, all);
  const axes::ViscousField& field = c.network.field;
  for (std::size_t axis = 0; axis < 2 && !field.is_uniform(); ++axis) {
    const char* const of = axis == 0 ? "x" : "y";
    all[fmt::format("field_start_{}", of)] = abs(Reference(field.start[axis]));
    all[fmt::format("field_length_{}", of)] =
        in_double(Reference(double(field.knots[axis] - 1)) * Reference(field.spacing[axis]));
    all[fmt::format("field_cells_per_length_{}", of)] = in_double(1 / Reference(field.spacing[axis]));
  }
  for (std::size_t i = 0; i < c.ports.size(); ++i)
    all[c.network.ports[i].name + "_damping"] = c.ports[i].decomposition.choice().damping;
  return all;
}

}  // namespace dashpot::compiler
