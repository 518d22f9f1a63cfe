#include "linear/motion_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "network/stuck_and_open_slips.hpp"

namespace dashpot::compiler {
namespace {

using boost::multiprecision::exp;
using boost::multiprecision::expm1;
using boost::multiprecision::pow;
using boost::multiprecision::sqrt;

// e^x − 1 − x; for a small x by its series, which does not cancel.
Real exponential_remainder(const Real& x) {
  if (abs(x) > Real("1e-6")) return expm1(x) - x;
  Real term = x * x / 2, sum = 0;
  for (int n = 3; n < 12; ++n) sum += term, term *= x / n;
  return sum;
}

// c of c u^p or of c (e^{a u} − 1)
Real factor_of(const StaticCurve& curve) {
  const Real force = curve.point.force, at = curve.point.displacement, shape = curve.shape;
  return curve.kind == StaticCurve::Kind::power ? Real(force / pow(at, shape)) : Real(force / expm1(shape * at));
}

// The last point of the table that is not beyond the displacement and has a point after it.
std::size_t row_of(const StaticCurve& curve, const Real& displacement) {
  const auto after =
      std::upper_bound(curve.points.begin(), curve.points.end(), displacement,
                       [](const Real& place, const CurvePoint& point) { return place < point.displacement; });
  const auto row = static_cast<std::size_t>(after - curve.points.begin());
  return std::clamp<std::size_t>(row, 1, curve.points.size() - 1) - 1;
}

Real slope_of(const StaticCurve& curve, std::size_t row) {
  return (Real(curve.points[row + 1].force) - Real(curve.points[row].force)) /
         (Real(curve.points[row + 1].displacement) - Real(curve.points[row].displacement));
}

// df/du at 0 for a curve that begins straight; 0 for a power above 1.
Real initial_stiffness(const StaticCurve& curve) {
  switch (curve.kind) {
    case StaticCurve::Kind::power: return curve.shape == 1 ? factor_of(curve) : Real(0);
    case StaticCurve::Kind::exponential: return factor_of(curve) * Real(curve.shape);
    case StaticCurve::Kind::table: return slope_of(curve, 0);
  }
  return 0;
}

struct Knot {
  Real value, tangent;
};

Knot knot_at(const StaticCurve& curve, const Real& stiffness, const Real& displacement, const Real& work) {
  if (displacement == 0) return {0, sqrt(initial_stiffness(curve) / stiffness)};
  const Real w = sqrt(2 * work / stiffness);
  return {w, force_at(curve, displacement) / (stiffness * w)};
}

MapCell cubic_between(const Knot& from, const Knot& to, const Real& width) {
  const Real rise = (to.value - from.value) / width;
  const auto coefficient = [&](const Real& difference, const Real& over) {
    return abs(difference) <= negligible_share * to.tangent ? 0.0 : to_double(difference / over);
  };
  return {to_double(from.value), to_double(from.tangent), coefficient(3 * rise - 2 * from.tangent - to.tangent, width),
          coefficient(from.tangent + to.tangent - 2 * rise, width * width)};
}

bool is_finite(const MotionMap& map) {
  const bool all = std::all_of(map.cell.begin(), map.cell.end(), [](const MapCell& cell) {
    return std::isfinite(cell.a) && std::isfinite(cell.b) && std::isfinite(cell.c) && std::isfinite(cell.e);
  });
  return all && std::isfinite(1 / map.width()) && map.steepest() > 0;
}

MotionMap with_cells(const StaticCurve& curve, const Real& stiffness, double reach, std::size_t cells) {
  MotionMap map;
  map.reach = reach;
  map.stiffness = to_double(stiffness);
  Knot knot = knot_at(curve, stiffness, 0, 0);
  Real work = 0;
  for (std::size_t i = 1; i <= cells; ++i) {
    const Real place = Real(reach) * i / cells;
    work += work_between(curve, Real(reach) * (i - 1) / cells, place);
    const Knot next = knot_at(curve, stiffness, place, work);
    map.cell.push_back(cubic_between(knot, next, Real(reach) / cells));
    knot = next;
  }
  map.cell.push_back({to_double(knot.value), to_double(knot.tangent), 0, 0});
  if (!is_finite(map)) {
    map.static_error = std::numeric_limits<double>::infinity();
    return map;
  }
  const std::size_t places =
      std::max<std::size_t>(16, 2048 / cells);  // points examined in each cell, besides those where tables bend
  const double largest = to_double(force_at(curve, reach));
  const auto look_at = [&](double u) {
    const double force = map.stiffness * map.value_at(u) * map.tangent_at(u);
    map.static_error = std::max(map.static_error, std::abs(force - to_double(force_at(curve, u))) / largest);
  };
  for (std::size_t i = 0; i <= cells * places; ++i) look_at(reach * double(i) / double(cells * places));
  for (const CurvePoint& point : curve.points)
    if (point.displacement < reach) look_at(point.displacement);
  return map;
}

// The largest error of w′, and up to which displacement it is large enough to be stated.
void measure_slope(const StaticCurve& curve, const Real& stiffness, MotionMap& map) {
  constexpr double unsure = 1e-2;  // of its largest
  const double steepest = map.steepest(), width = map.width();
  const auto look_at = [&](double u) {
    const Knot exact = knot_at(curve, stiffness, u, work_between(curve, 0, u));
    const double error = std::abs(map.tangent_at(u) - to_double(exact.tangent)) / steepest;
    map.slope_error = std::max(map.slope_error, error);
    if (error > unsure) map.unsure_until = std::max(map.unsure_until, u);
  };
  // A curve that begins flat bends mostly in the first cells.
  for (std::size_t i = 0; i < map.cubics(); ++i) look_at(map.reach * (double(i) + 0.5) / double(map.cubics()));
  for (std::size_t i = 1; i <= 64; ++i) look_at(2 * width * double(i) / 64);
  for (double u = width / 64; u > width * 1e-4; u /= 2) look_at(u);
}

// How far the tool goes beyond the place where the curve begins.
double reach_of(const Network& network) {
  const double start = network.surface();
  double reach = network.static_curve->point.displacement;
  if (const auto& valid = network.valid.displacement; valid) {
    const double forward = valid->high - start, backward = network.contact ? 0 : start - valid->low;
    if (std::max(forward, backward) > 0) reach = std::max(forward, backward);
  }
  return reach;
}

std::optional<Real> stiffness_of(const Network& network, const LinearForm& form, Diagnostics& diagnostics) {
  if (network.static_curve->is_instantaneous) {
    const Real stiffness = glass_stiffness(has_slips(network) ? linear_form(with_stuck_slips(network)) : form);
    if (stiffness > 0) return stiffness;
    diagnostics.report<DiagnosticCode::static_without_springs>(network.static_curve->span);
    return std::nullopt;
  }
  if (form.static_stiffness > 0) return form.static_stiffness;
  diagnostics.report<DiagnosticCode::static_without_rest>(network.static_curve->span);
  diagnostics.note<DiagnosticCode::static_rest_remedy>({});
  return std::nullopt;
}

}  // namespace

Real force_at(const StaticCurve& curve, const Real& displacement) {
  switch (curve.kind) {
    case StaticCurve::Kind::power: return factor_of(curve) * pow(displacement, Real(curve.shape));
    case StaticCurve::Kind::exponential: return factor_of(curve) * expm1(Real(curve.shape) * displacement);
    case StaticCurve::Kind::table: {
      const std::size_t row = row_of(curve, displacement);
      return Real(curve.points[row].force) +
             slope_of(curve, row) * (displacement - Real(curve.points[row].displacement));
    }
  }
  return 0;
}

Real work_between(const StaticCurve& curve, const Real& from, const Real& to) {
  const Real shape = curve.shape;
  const auto from_start = [&](const Real& place) {
    return curve.kind == StaticCurve::Kind::power
               ? Real(factor_of(curve) * pow(place, shape + 1) / (shape + 1))
               : Real(factor_of(curve) / shape * exponential_remainder(shape * place));
  };
  if (curve.kind != StaticCurve::Kind::table) return from_start(to) - from_start(from);
  Real work = 0, begin = from;
  for (std::size_t row = row_of(curve, from), last = row_of(curve, to); row <= last; ++row) {
    const Real end = row == last ? to : Real(curve.points[row + 1].displacement);
    work += (end - begin) * (force_at(curve, begin) + force_at(curve, end)) / 2;
    begin = end;
  }
  return work;
}

std::optional<MotionMap> motion_map(const Network& network, const LinearForm& form, Diagnostics& diagnostics,
                                    double error) {
  const std::optional<Real> stiffness = stiffness_of(network, form, diagnostics);
  if (!stiffness) return std::nullopt;
  const StaticCurve& curve = *network.static_curve;
  const double reach = reach_of(network);
  MotionMap map = with_cells(curve, *stiffness, reach, 32);
  for (std::size_t cubics = 64; cubics <= most_cubics && map.static_error > error; cubics *= 2)
    map = with_cells(curve, *stiffness, reach, cubics);
  if (map.static_error > largest_static_error) {
    diagnostics.report<DiagnosticCode::static_too_bent>(curve.span, most_cubics, 100 * map.static_error);
    return std::nullopt;
  }
  map.start = network.surface();
  measure_slope(curve, *stiffness, map);
  return map;
}

}  // namespace dashpot::compiler
