#include "verify/reference_map.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

namespace dashpot::compiler {
namespace {

class Curve {
 public:
  explicit Curve(const StaticCurve& curve) : curve_(curve) {}

  Reference force(const Reference& u) const {
    const Reference at = curve_.point.displacement, force_there = curve_.point.force, shape = curve_.shape;
    if (curve_.kind == StaticCurve::Kind::power)
      return u == 0 ? Reference(0) : Reference(force_there * exp(shape * log(u / at)));
    if (curve_.kind == StaticCurve::Kind::exponential) return force_there * expm1(shape * u) / expm1(shape * at);
    const std::vector<CurvePoint>& points = curve_.points;
    std::size_t next = 1;
    while (next + 1 < points.size() && points[next].displacement < u) ++next;
    const Reference x0 = points[next - 1].displacement, x1 = points[next].displacement;
    const Reference f0 = points[next - 1].force, f1 = points[next].force;
    return f0 + (f1 - f0) * ((u - x0) / (x1 - x0));
  }

  // ∫ f du, in pieces that end where a table bends.
  Reference work(const Reference& from, const Reference& to) {
    Reference sum = 0, begin = from;
    for (const CurvePoint& point : curve_.points)
      if (point.displacement > begin && point.displacement < to) {
        sum += smooth_work(begin, point.displacement);
        begin = point.displacement;
      }
    return sum + smooth_work(begin, to);
  }

  // df/du at 0, from the definition of each kind.
  Reference first_slope() const {
    const Reference at = curve_.point.displacement, force_there = curve_.point.force, shape = curve_.shape;
    if (curve_.kind == StaticCurve::Kind::power) return shape == 1 ? Reference(force_there / at) : Reference(0);
    if (curve_.kind == StaticCurve::Kind::exponential) return shape * force_there / expm1(shape * at);
    return Reference(curve_.points[1].force) / Reference(curve_.points[1].displacement);
  }

 private:
  // A power has no derivatives at 0. Every other piece is no longer than its distance from 0, and there 30 points are
  // exact to 1e-40.
  Reference smooth_work(const Reference& from, const Reference& to) {
    const auto f = [this](const Reference& u) { return force(u); };
    if (from == 0) return at_zero_.integrate(f, from, to, Reference("1e-40"));
    return boost::math::quadrature::gauss<Reference, 30>::integrate(f, from, to);
  }

  const StaticCurve& curve_;
  boost::math::quadrature::tanh_sinh<Reference> at_zero_;
};

Reference reach_of(const Network& network) {
  const Reference start = network.surface();
  Reference reach = network.static_curve->point.displacement;
  if (!network.valid.displacement) return reach;
  const double forward = network.valid.displacement->high - start.convert_to<double>();
  const double backward = network.contact ? 0 : start.convert_to<double>() - network.valid.displacement->low;
  return std::max(forward, backward) > 0 ? Reference(std::max(forward, backward)) : reach;
}

}  // namespace

ReferenceMap reference_map(const Network& network, const ReferenceForm& form, std::size_t cubics) {
  Reference stiffness = form.static_stiffness;
  if (network.static_curve->is_instantaneous)
    for (const ReferenceMode& mode : form.modes) stiffness += mode.stiffness;
  Curve curve(*network.static_curve);
  const Reference reach = reach_of(network), width = reach / cubics;
  ReferenceMap map;
  Reference work = 0;
  for (std::size_t i = 0; i <= cubics; ++i) {
    const Reference u = width * i;
    if (i > 0) work += curve.work(u - width, u);
    map.begins.push_back(u);
    map.a.push_back(sqrt(2 * work / stiffness));
    map.b.push_back(i == 0 ? Reference(sqrt(curve.first_slope() / stiffness))
                           : Reference(curve.force(u) / (stiffness * map.a.back())));
  }
  // Through both ends with both slopes: divided differences with each end taken twice.
  for (std::size_t i = 0; i < cubics; ++i) {
    const Reference between = (map.a[i + 1] - map.a[i]) / width;
    const Reference left = (between - map.b[i]) / width, right = (map.b[i + 1] - between) / width;
    const Reference third = (right - left) / width;
    const auto unless_left_over = [&](const Reference& value, const Reference& over) {
      return abs(value * over) <= Reference("1e-30") * map.b[i + 1] ? Reference(0) : value;
    };
    map.c.push_back(unless_left_over(left - third * width, width));
    map.e.push_back(unless_left_over(third, width * width));
  }
  map.c.push_back(0);
  map.e.push_back(0);
  return map;
}

}  // namespace dashpot::compiler
