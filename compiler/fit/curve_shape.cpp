#include "fit/curve_shape.hpp"

#include <algorithm>
#include <cmath>

namespace dashpot::compiler::fitting {
namespace {

// e^x − 1 − x, by its series where the difference would cancel: what is left out there is below x⁶/5040 of x²/2.
double exponential_remainder(double x) {
  if (x > 1e-2) return std::expm1(x) - x;
  return x * x / 2 * (1 + x / 3 * (1 + x / 4 * (1 + x / 5 * (1 + x / 6))));
}

double slope_after(const std::vector<CurvePoint>& points, std::size_t i) {
  return (points[i + 1].force - points[i].force) / (points[i + 1].displacement - points[i].displacement);
}

std::vector<double> log_slopes_of(const std::vector<CurvePoint>& points) {
  std::vector<double> log_slopes;
  const std::size_t last = points.size() - 2;
  for (std::size_t i = 0; i < last; ++i)
    log_slopes.push_back(std::log(slope_after(points, i) / slope_after(points, last)));
  return log_slopes;
}

}  // namespace

CurveShape::CurveShape(Kind kind, std::vector<double> parameters, double reach) : parameters_(std::move(parameters)) {
  curve_.kind = kind;
  curve_.point.displacement = reach;
  normalise();
}

CurveShape CurveShape::power(double exponent, double reach) { return {Kind::power, {exponent}, reach}; }

CurveShape CurveShape::exponential(double rate_times_reach, double reach) {
  return {Kind::exponential, {std::log(rate_times_reach)}, reach};
}

CurveShape CurveShape::table(std::vector<double> log_slopes, double reach) {
  return {Kind::table, std::move(log_slopes), reach};
}

CurveShape CurveShape::sampled(std::size_t stretches) const {
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i <= stretches; ++i) {
    const double place = reach() * double(i) / double(stretches);
    points.push_back({place, force_at(place)});
  }
  return table(log_slopes_of(points), reach());
}

CurveShape CurveShape::of(const StaticCurve& curve, double stiffness) {
  CurveShape shape = power(1, curve.point.displacement);
  shape.curve_ = curve;
  shape.curve_.point.force /= stiffness;
  for (CurvePoint& point : shape.curve_.points) point.force /= stiffness;
  if (curve.kind == Kind::power) shape.parameters_ = {curve.shape};
  if (curve.kind == Kind::exponential) shape.parameters_ = {std::log(curve.shape * curve.point.displacement)};
  if (curve.kind == Kind::table) shape.parameters_ = log_slopes_of(curve.points);
  shape.find_work();
  return shape;
}

void CurveShape::set_parameter(std::size_t index, double value) {
  parameters_[index] = value;
  normalise();
}

// The force that makes w(reach) the reach: ∫f du = reach²/2.
void CurveShape::normalise() {
  const double reach = curve_.point.displacement;
  curve_.point.force = 1;
  if (curve_.kind == Kind::power) curve_.shape = parameters_[0];
  if (curve_.kind == Kind::exponential) curve_.shape = std::exp(parameters_[0]) / reach;
  if (curve_.kind == Kind::table) {
    const std::size_t stretches = parameters_.size() + 1;
    curve_.points.assign(1, {0, 0});
    for (std::size_t i = 0; i < stretches; ++i)
      curve_.points.push_back({reach * double(i + 1) / double(stretches),
                               curve_.points.back().force + (i + 1 == stretches ? 1 : std::exp(parameters_[i]))});
    curve_.point.force = curve_.points.back().force;
  }
  find_work();
  const double scale = reach * reach / 2 / work_to(reach);
  curve_.point.force *= scale;
  for (CurvePoint& point : curve_.points) point.force *= scale;
  find_work();
}

void CurveShape::find_work() {
  const double force = curve_.point.force, at = curve_.point.displacement;
  if (curve_.kind == Kind::power) factor_ = force / std::pow(at, curve_.shape);
  if (curve_.kind == Kind::exponential) factor_ = force / std::expm1(curve_.shape * at);
  work_.assign(curve_.points.empty() ? 0 : 1, 0.0);
  for (std::size_t i = 1; i < curve_.points.size(); ++i) {
    const CurvePoint &from = curve_.points[i - 1], &to = curve_.points[i];
    work_.push_back(work_.back() + (to.displacement - from.displacement) * (from.force + to.force) / 2);
  }
}

// The last point that is not beyond, with a point after it.
std::size_t CurveShape::row_of(double distance) const {
  const auto after = std::upper_bound(curve_.points.begin(), curve_.points.end(), distance,
                                      [](double place, const CurvePoint& point) { return place < point.displacement; });
  return std::clamp<std::size_t>(static_cast<std::size_t>(after - curve_.points.begin()), 1, curve_.points.size() - 1) -
         1;
}

double CurveShape::force_at(double distance) const {
  if (curve_.kind == Kind::power) return factor_ * std::pow(distance, curve_.shape);
  if (curve_.kind == Kind::exponential) return factor_ * std::expm1(curve_.shape * distance);
  const std::size_t row = row_of(distance);
  const CurvePoint &from = curve_.points[row], &to = curve_.points[row + 1];
  return from.force + (to.force - from.force) * (distance - from.displacement) / (to.displacement - from.displacement);
}

double CurveShape::work_to(double distance) const {
  if (curve_.kind == Kind::power) return force_at(distance) * distance / (curve_.shape + 1);
  if (curve_.kind == Kind::exponential) return factor_ / curve_.shape * exponential_remainder(curve_.shape * distance);
  const std::size_t row = row_of(distance);
  return work_[row] +
         (distance - curve_.points[row].displacement) * (curve_.points[row].force + force_at(distance)) / 2;
}

CurveShape::Place CurveShape::at(double displacement) const {
  const double distance = std::abs(displacement), w = std::sqrt(2 * work_to(distance));
  if (w > 0) return {std::copysign(w, displacement), force_at(distance) / w};
  if (curve_.kind == Kind::power && curve_.shape > 1) return {0, 0};
  const double near = 1e-9 * reach();  // where the curve is still straight, to rounding
  return {0, std::sqrt(force_at(near) / near)};
}

ShapeRange range_of(CurveShape::Kind kind) {
  switch (kind) {
    case CurveShape::Kind::power: return {1, 20};
    case CurveShape::Kind::exponential: return {std::log(0.01), std::log(30.0)};
    case CurveShape::Kind::table: return {std::log(1e-5), std::log(1e3)};
  }
  return {0, 0};
}

std::vector<CurveShape> some_powers(double reach) {
  std::vector<CurveShape> curves;
  for (const double exponent : {1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 9.0})
    curves.push_back(CurveShape::power(exponent, reach));
  return curves;
}

std::vector<CurveShape> some_exponentials(double reach) {
  std::vector<CurveShape> curves;
  for (const double steepness : {0.5, 1.0, 2.0, 3.0, 4.5, 6.5, 9.0, 13.0})
    curves.push_back(CurveShape::exponential(steepness, reach));
  return curves;
}

const char* word_of(CurveShape::Kind kind) {
  switch (kind) {
    case CurveShape::Kind::power: return "power";
    case CurveShape::Kind::exponential: return "exponential";
    case CurveShape::Kind::table: return "table";
  }
  return "";
}

}  // namespace dashpot::compiler::fitting
