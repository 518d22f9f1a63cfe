#include "network/motion_map.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler {
namespace {

std::size_t cell_at(const MotionMap& map, double distance) {
  return static_cast<std::size_t>(std::min(distance / map.width(), double(map.cubics())));
}

struct Extremes {
  double least, most;
};

// The extremes of |w′| over the part of a stretch that lies in one cell. The slope is a parabola, which may dip below 0
// where a curve begins very flat.
Extremes tangents(const MotionMap& map, std::size_t cell, double from, double to) {
  const MapCell& m = map.cell[cell];
  const double start = double(cell) * map.width();
  const double low = std::max(from - start, 0.0), end = to - start;
  const double high = cell == map.cubics() ? std::max(low, end) : std::clamp(end, low, map.width());
  const auto slope = [&](double d) { return m.b + d * (2 * m.c + 3 * m.e * d); };
  double least = std::min(slope(low), slope(high)), most = std::max(slope(low), slope(high));
  if (m.e != 0) {
    const double vertex = slope(std::clamp(-m.c / (3 * m.e), low, high));
    least = std::min(least, vertex);
    most = std::max(most, vertex);
  }
  const bool changes_sign = least <= 0 && most >= 0;
  return {changes_sign ? 0 : std::min(std::abs(least), std::abs(most)), std::max(std::abs(least), std::abs(most))};
}

template <class Take>
void over_cells(const MotionMap& map, double from, double to, Take take) {
  for (std::size_t cell = cell_at(map, from); cell <= cell_at(map, to); ++cell) take(cell);
}

}  // namespace

double MotionMap::value_at(double distance) const {
  const std::size_t at = cell_at(*this, distance);
  const MapCell& m = cell[at];
  const double d = distance - double(at) * width();
  return m.a + d * (m.b + d * (m.c + d * m.e));
}

double MotionMap::tangent_at(double distance) const {
  const std::size_t at = cell_at(*this, distance);
  const MapCell& m = cell[at];
  const double d = distance - double(at) * width();
  return m.b + d * (2 * m.c + 3 * m.e * d);
}

double MotionMap::least_tangent(double from, double to) const {
  double least = std::abs(tangent_at(from));
  over_cells(*this, from, to, [&](std::size_t at) { least = std::min(least, tangents(*this, at, from, to).least); });
  return least;
}

double MotionMap::largest_tangent(double from, double to) const {
  double most = 0;
  over_cells(*this, from, to, [&](std::size_t at) { most = std::max(most, tangents(*this, at, from, to).most); });
  return most;
}

// w″ is linear in each cell, so that it is largest at an end.
double MotionMap::largest_curvature(double from, double to) const {
  double most = 0;
  over_cells(*this, from, to, [&](std::size_t at) {
    if (at == cubics()) return;
    const MapCell& m = cell[at];
    const double from_here = double(at) * width();
    for (const double d : {std::max(from - from_here, 0.0), std::min(to - from_here, width())})
      most = std::max(most, std::abs(2 * m.c + 6 * m.e * d));
  });
  return most;
}

}  // namespace dashpot::compiler
