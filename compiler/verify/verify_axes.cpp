#include "verify/verify_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "discretise/law_writer.hpp"
#include "law/walk.hpp"
#include "verify/law_constants.hpp"
#include "verify/port_constants.hpp"
#include "verify/recompiled.hpp"
#include "verify/reference_geometry.hpp"
#include "verify/reference_grid.hpp"
#include "verify/verify_gate.hpp"
#include "verify/verify_header.hpp"

namespace dashpot::compiler {
namespace {

class AxesVerification {
 public:
  AxesVerification(const AxesCertificateFile& certificate, const HeaderConstants& header,
                   const AxesCompilation& compiled, Diagnostics& diagnostics)
      : certificate_(certificate),
        header_(header),
        c_(compiled),
        diagnostics_(diagnostics),
        named_(reference_geometry(compiled)),
        grids_(compiled.ports.size()) {
    for (const auto& [name, values] : reference_constants({}, facts_of_port(compiled, 0)))
      if (name == "sample_period" || name == "threshold") named_[name] = values.front();
    for (std::size_t i = 0; i < compiled.ports.size(); ++i)
      ports_.push_back(
          {compiled.network.ports[i].name, &compiled.ports[i], &compiled.port_laws[i], compiled.choices_of_ports[i]});
  }

  std::size_t recompute_constants() {
    compare_constants(certificate_.constants, header_, diagnostics_);
    std::size_t count = 0;
    for (const HeaderConstant& constant : header_.all) look_at(constant), count += constant.values.size();
    for (const VerifiedPort& port : ports_) recompute_port(port, header_.scalar, diagnostics_);
    for (std::size_t i = 0; i < grids_.size(); ++i)
      if (const auto* grid = std::get_if<axes::Grid>(&c_.network.ports[i].map))
        recompute_grid(c_.network.ports[i].name, *grid, grids_[i]);
    if (c_.certificate.gate) look_at_gate();
    return count;
  }

 private:
  void look_at(const HeaderConstant& constant) {
    if (constant.name == literals_in_code) return look_at_literals(constant, c_.law, {}, diagnostics_);
    if (constant.name == "added_damping") return compare_additions(constant);
    const auto known = named_.find(constant.name);
    if (known != named_.end() && constant.values.size() == 1)
      return compare(constant, 0, known->second, header_.scalar, diagnostics_);
    if (c_.certificate.gate && is_of_gate(constant.name)) return gate_.push_back(constant);
    if (give_to_port(constant, c_.law, ports_)) return;
    if (const std::optional<std::size_t> port = port_of_map(constant.name)) grids_[*port].push_back(constant);
    else recompute_field_table(constant);
    compare_with_written(constant, c_.law, diagnostics_);
  }

  // What the names of the tables of a port's map begin with.
  static std::string map_of(const std::string& port) { return joined(port, "map") + "_"; }

  // The port over a grid that has this table; of two whose names both begin it, the longer.
  std::optional<std::size_t> port_of_map(const std::string& table) const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const bool is_its_own =
          std::holds_alternative<axes::Grid>(c_.network.ports[i].map) && table.starts_with(map_of(ports_[i].name));
      if (is_its_own && (!best || ports_[i].name.size() > ports_[*best].name.size())) best = i;
    }
    return best;
  }

  // A port may be called 'gate'.
  static bool is_of_gate(const std::string& name) {
    constexpr const char* names[] = {"gate_factor_1", "gate_factor_2", "gate_reserve",
                                     "gate_recovery", "gate_half",     "gate_share"};
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
  }

  void compare_additions(const HeaderConstant& constant) {
    const std::vector<double>& added = c_.certificate.added;
    bool alike = constant.values.size() == added.size();
    for (std::size_t k = 0; alike && k < added.size(); ++k)
      alike = is_correctly_rounded(constant.values[k], Reference(added[k]), header_.scalar);
    if (!alike)
      diagnostics_.report<DiagnosticCode::certificate_disagrees>({}, "header", "recomputed bound", constant.name);
  }

  // Reports numbers that let too much pass as such, and any other difference as another number.
  void look_at_gate() {
    const std::size_t errors_before = diagnostics_.error_count();
    verify_gate(*c_.certificate.gate, c_.device, header_, diagnostics_);
    if (diagnostics_.error_count() > errors_before) return;
    for (const HeaderConstant& constant : gate_) {
      if (const auto known = constant_called(constant.name, constant.values.size(), c_.law))
        compare_with_compiled(constant, *known, diagnostics_);
      else compare_with_written(constant, c_.law, diagnostics_);
    }
  }

  // Of a field over a grid: what finds a cell, and differences between its knots. Tables by which a cell is found have
  // their last number twice.
  void recompute_field_table(const HeaderConstant& table) {
    const axes::ViscousField& field = c_.network.field;
    if (field.is_uniform() || !table.name.starts_with("field_")) return;
    const std::array<std::size_t, 2> cells{field.knots[0] - 1, field.knots[1] - 1};
    const std::string name = table.name.substr(6);
    const double rounding = header_.scalar == ScalarType::float64 ? 1e-15 : 1e-6;
    const auto expect = [&](std::size_t place, const Reference& due, double within) {
      if (abs(Reference(table.values[place]) - due) > Reference(within))
        diagnostics_.report<DiagnosticCode::constant_wrong>({}, shown(table, place), table.values[place], due.str(20));
    };
    for (const std::size_t axis : {0u, 1u}) {
      if (name != (axis == 0 ? "column" : "row") && name != (axis == 0 ? "corner_x" : "corner_y")) continue;
      for (std::size_t k = 0; k < table.values.size(); ++k) {
        const std::size_t cell = std::min(k, cells[axis] - 1);
        const double length = double(cells[axis]) * field.spacing[axis];
        if (name.starts_with("corner"))
          expect(k, Reference(double(cell)) * Reference(field.spacing[axis]), rounding * length);
        else expect(k, Reference(double(axis == 0 ? cell : cell * cells[0])), 0);
      }
      return;
    }
    recompute_field_entry(table, name.substr(0, 2), name.substr(2), rounding, expect);
  }

  // `by`: "", "_by_x", "_by_y" or "_by_xy", of the entry "11" to "22".
  template <class Expect>
  void recompute_field_entry(const HeaderConstant& table, const std::string& entry, const std::string& by,
                             double rounding, const Expect& expect) {
    const axes::ViscousField& field = c_.network.field;
    const std::size_t across = field.knots[0] - 1, i = std::size_t(entry[0] - '1'), j = std::size_t(entry[1] - '1');
    const bool in_x = by == "_by_x" || by == "_by_xy", in_y = by == "_by_y" || by == "_by_xy";
    if (i > 1 || j > 1 || table.values.size() != across * (field.knots[1] - 1)) return;
    double largest = 0;
    for (const axes::Matrix<double>& a : field.at_knot) largest = std::max(largest, std::abs(a[i][j]));
    const Reference width = in_x ? Reference(field.spacing[0]) : 1, height = in_y ? Reference(field.spacing[1]) : 1;
    for (std::size_t k = 0; k < table.values.size(); ++k) {
      const std::size_t row = k / across, column = k % across;
      const auto at = [&](std::size_t right, std::size_t up) {
        return Reference(field.at_knot[(row + up) * field.knots[0] + column + right][i][j]);
      };
      const auto difference = [&](std::size_t up) -> Reference { return in_x ? at(1, up) - at(0, up) : at(0, up); };
      const Reference due = (in_y ? difference(1) - difference(0) : difference(0)) / (width * height);
      expect(k, due, 8 * rounding * largest / Reference(width * height).convert_to<double>());
    }
  }

  // Cells as a law reads them, at points of each, against what lies between the knots; and what it finds a cell by.
  void recompute_grid(const std::string& port, const axes::Grid& grid, const std::vector<HeaderConstant>& tables) {
    const auto values_of = [&](const std::string& name) {
      for (const HeaderConstant& table : tables)
        if (table.name == map_of(port) + name) return table.values;
      diagnostics_.report<DiagnosticCode::constant_missing>({}, map_of(port) + name);
      return std::vector<double>();
    };
    const auto expect = [&](const std::string& name, std::size_t place, double value, const Reference& due,
                            double within) {
      if (abs(Reference(value) - due) > Reference(within))
        diagnostics_.report<DiagnosticCode::constant_wrong>(
            {}, fmt::format("place {} of '{}{}'", place + 1, map_of(port), name), value, due.str(20));
    };
    // A port without springs does not need the depth, so tables for it alone are missing.
    const std::set<CoefficientId> read = constants_read(c_.law);
    const auto is_read = [&](const std::string& name) {
      return std::any_of(read.begin(), read.end(),
                         [&](CoefficientId id) { return c_.law.coefficients[id].name == map_of(port) + name; });
    };
    std::array<std::vector<double>, 16> cells;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::string name = fmt::format("s{}_t{}", k / 4, k % 4);
      if (is_read(name)) cells[k] = values_of(name);
      else
        for (const axes::BicubicCell& cell : grid.cell) cells[k].push_back(cell.coefficient[k]);
      if (cells[k].size() != grid.cell.size()) return;
    }
    const double rounding = header_.scalar == ScalarType::float64 ? 1e-15 : 1e-6;
    const std::size_t counts[] = {grid.knots[0] + 1, grid.knots[1] + 1};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const std::string corner = axis == 0 ? "corner_x" : "corner_y", number = axis == 0 ? "column" : "row";
      const std::vector<double> corners = values_of(corner), numbers = values_of(number);
      if (corners.size() != counts[axis] || numbers.size() != counts[axis]) return;
      for (std::size_t i = 0; i < counts[axis]; ++i) {
        const double knot = i == 0 ? 0 : double(i - 1);
        const double last = std::abs(grid.start[axis]) + double(counts[axis]) * grid.spacing[axis];
        expect(corner, i, corners[i], Reference(grid.start[axis]) + Reference(knot) * Reference(grid.spacing[axis]),
               rounding * last);
        expect(number, i, numbers[i], Reference(double(axis == 0 ? i : i * counts[0])), 0);
      }
    }
    recompute_cells(grid, cells, rounding, expect);
  }

  // At 16 points of a cell, which determine its 16 coefficients. Each is a difference of knots that rounds by some
  // parts of the largest of them.
  template <class Expect>
  static void recompute_cells(const axes::Grid& grid, const std::array<std::vector<double>, 16>& cells, double rounding,
                              const Expect& expect) {
    const ReferenceGrid reference(grid);
    double largest = 0;
    for (const axes::BicubicCell& cell : grid.cell) largest = std::max(largest, std::abs(cell.coefficient[0]));
    for (std::size_t i = 0; i < grid.cell.size(); ++i) {
      const std::size_t place[] = {i % grid.columns(), i / grid.columns()};
      for (std::size_t point = 0; point < 16; ++point) {
        std::array<double, 2> within{double(point / 4) / 3, double(point % 4) / 3};
        std::array<Reference, 2> at;
        for (std::size_t axis = 0; axis < 2; ++axis) {
          within[axis] *= place[axis] == 0 ? -grid.spacing[axis] : grid.spacing[axis];
          at[axis] = Reference(grid.start[axis]) + Reference(within[axis]) +
                     Reference(place[axis] == 0 ? 0 : double(place[axis] - 1)) * Reference(grid.spacing[axis]);
        }
        std::array<double, 16> coefficient;
        for (std::size_t k = 0; k < 16; ++k) coefficient[k] = cells[k][i];
        const double value = axes::bicubic(coefficient, within[0], within[1]).value;
        expect("s0_t0", i, value, reference.depth(at[0], at[1]), 100 * rounding * largest);
      }
    }
  }

  const AxesCertificateFile& certificate_;
  const HeaderConstants& header_;
  const AxesCompilation& c_;
  Diagnostics& diagnostics_;
  std::map<std::string, Reference> named_;
  std::vector<VerifiedPort> ports_;
  std::vector<HeaderConstant> gate_;
  std::vector<std::vector<HeaderConstant>> grids_;  // tables of the ports' maps
};

}  // namespace

std::size_t verify_axes_constants(const AxesCertificateFile& certificate, const HeaderConstants& header,
                                  const AxesCompilation& compiled, Diagnostics& diagnostics) {
  return AxesVerification(certificate, header, compiled, diagnostics).recompute_constants();
}

std::optional<NeedAtPlaces> verify_axes_bounds(const AxesCertificateFile& certificate, const AxesCompilation& compiled,
                                               Diagnostics& diagnostics) {
  const AxesCertificate& again = compiled.certificate;
  expect_bound("needed damping", certificate.needed_damping, again.needed, diagnostics);
  expect_bound("damping for estimates", certificate.for_estimates, again.for_estimates, diagnostics);
  expect_bound("damping for the amplifiers' lag", certificate.for_lag, again.for_lag, diagnostics);
  expect_bound("missing damping", certificate.missing_damping, again.missing, diagnostics);
  for (std::size_t k = 0; k < again.added.size(); ++k)
    expect_bound("added damping", k < certificate.added_damping.size() ? certificate.added_damping[k] : 0,
                 again.added[k], diagnostics);
  for (std::size_t i = 0; i < compiled.ports.size(); ++i)
    expect_bound("damping of a port", i < certificate.port_dampings.size() ? certificate.port_dampings[i] : 0,
                 compiled.ports[i].decomposition.choice().damping, diagnostics);
  if (certificate.is_proved != again.is_proved || certificate.certified != again.certified)
    diagnostics.report<DiagnosticCode::certificate_disagrees>({}, "certificate", "recomputed bound", "certified");
  if (!again.is_proved || !std::isfinite(again.needed)) return std::nullopt;
  const std::optional<NeedAtPlaces> there = need_at_places(compiled);
  // Sums in double precision round by less than this share of the whole.
  const Reference for_forces = Reference(certificate.needed_damping) - Reference(certificate.for_estimates) -
                               Reference(certificate.for_lag) +
                               Reference(certificate.needed_damping) * Reference(1e-15);
  if (there && there->most > for_forces)
    expect_bound("needed damping", certificate.needed_damping,
                 certificate.needed_damping + Reference(there->most - for_forces).convert_to<double>(), diagnostics);
  return there;
}

}  // namespace dashpot::compiler
