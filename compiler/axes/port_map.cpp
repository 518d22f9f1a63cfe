#include "axes/port_map.hpp"

#include "network/match.hpp"

namespace dashpot::compiler::axes {
namespace {

Pair<double> unit(const Pair<double>& a) { return (1 / std::hypot(a[0], a[1])) * a; }

// Where the axis of a band crosses a side of the box.
std::optional<Pair<double>> crossing(const Band& band, const Box& box) {
  const Pair<double> corners[] = {
      {box[0].low, box[1].low}, {box[0].high, box[1].low}, {box[0].high, box[1].high}, {box[0].low, box[1].high}};
  for (int i = 0; i < 4; ++i) {
    const Pair<double>&a = corners[i], &b = corners[(i + 1) % 4];
    const double from = dot(band.normal, a - band.through), to = dot(band.normal, b - band.through);
    if ((from <= 0) != (to <= 0)) return a + (from / (from - to)) * (b - a);
  }
  return std::nullopt;
}

}  // namespace

Plane along(const Pair<double>& direction) { return {unit(direction), 0}; }

Plane wall(const Pair<double>& through, const Pair<double>& normal) {
  const Pair<double> out = unit(normal);
  return {-1.0 * out, dot(out, through)};
}

Circle ball(const Pair<double>& centre, double radius) { return {centre, radius, 1}; }
Circle cavity(const Pair<double>& centre, double radius) { return {centre, radius, -1}; }

std::optional<Pair<double>> peak_in(const PortMap& map, const Box& workspace) {
  using Place = std::optional<Pair<double>>;
  return match(
      map, [](const Plane&) -> Place { return std::nullopt; },
      [&](const Circle& circle) -> Place {
        const bool is_in = workspace[0].holds(circle.centre[0]) && workspace[1].holds(circle.centre[1]);
        return is_in ? Place(circle.centre) : std::nullopt;
      },
      [&](const Band& band) -> Place { return crossing(band, workspace); },
      [](const Grid&) -> Place { return std::nullopt; });
}

Band line(const Pair<double>& through, const Pair<double>& direction, double radius) {
  return {through, turned(unit(direction)), radius};
}

}  // namespace dashpot::compiler::axes
