#include "axes/port_map.hpp"

namespace dashpot::compiler::axes {
namespace {

Pair<double> unit(const Pair<double>& a) { return (1 / std::hypot(a[0], a[1])) * a; }

}  // namespace

Plane along(const Pair<double>& direction) { return {unit(direction), 0}; }

Plane wall(const Pair<double>& through, const Pair<double>& normal) {
  const Pair<double> out = unit(normal);
  return {-1.0 * out, dot(out, through)};
}

Circle ball(const Pair<double>& centre, double radius) { return {centre, radius, 1}; }
Circle cavity(const Pair<double>& centre, double radius) { return {centre, radius, -1}; }

Band line(const Pair<double>& through, const Pair<double>& direction, double radius) {
  return {through, turned(unit(direction)), radius};
}

}  // namespace dashpot::compiler::axes
