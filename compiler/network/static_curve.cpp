#include "network/static_curve.hpp"

#include <fmt/format.h>

#include "network/port_units.hpp"
#include "source/excerpt.hpp"

namespace dashpot::compiler {
namespace {

class CurveReader {
 public:
  CurveReader(const StaticDecl& decl, ParameterTable& values, motion port_motion, Diagnostics& diagnostics)
      : decl_(decl), values_(values), motion_(port_motion), diagnostics_(diagnostics) {}

  std::optional<StaticCurve> read() {
    const std::size_t errors_before = diagnostics_.error_count();
    StaticCurve curve;
    curve.span = decl_.span;
    curve.is_instantaneous = is_instantaneous();
    if (decl_.kind == "table") read_table(curve);
    else read_formula(curve);
    return diagnostics_.error_count() == errors_before ? std::optional(curve) : std::nullopt;
  }

 private:
  bool is_instantaneous() {
    if (!decl_.is || decl_.is->text == "equilibrium") return false;
    if (decl_.is->text != "instantaneous")
      diagnostics_.report<DiagnosticCode::unknown_static_is>(decl_.is->span, excerpt(decl_.is->text));
    return true;
  }

  void read_formula(StaticCurve& curve) {
    const bool is_power = decl_.kind == "power";
    curve.kind = is_power ? StaticCurve::Kind::power : StaticCurve::Kind::exponential;
    curve.shape = is_power ? read(decl_.shape, "the power of a static curve", dimensions::number)
                           : read_positive(decl_.shape, "the rate of an exponential curve", power(length(), -1));
    if (is_power && curve.shape < 1)
      diagnostics_.report<DiagnosticCode::power_below_one>(decl_.shape ? decl_.shape->span : decl_.kind_span,
                                                           curve.shape);
    curve.point.force = read_positive(decl_.force, "the force of a static curve", force());
    curve.point.displacement = read_positive(decl_.at, "the displacement of a static curve", length());
  }

  void read_table(StaticCurve& curve) {
    curve.kind = StaticCurve::Kind::table;
    for (const auto& [displacement, force_there] : decl_.table)
      curve.points.push_back(
          {read(displacement, "the first of a pair", length()), read(force_there, "the second of a pair", force())});
    if (curve.points.size() < 2) return diagnostics_.report<DiagnosticCode::static_table_too_short>(decl_.kind_span);
    if (curve.points.front().displacement != 0 || curve.points.front().force != 0)
      diagnostics_.report<DiagnosticCode::static_table_start>(decl_.table.front().first.span);
    for (std::size_t i = 1; i < curve.points.size(); ++i) check_rise(curve.points, i);
    curve.point = curve.points.back();
  }

  void check_rise(const std::vector<CurvePoint>& points, std::size_t i) {
    const ValueDecl& displacement = decl_.table[i].first;
    const ValueDecl& force_there = decl_.table[i].second;
    if (points[i].displacement <= points[i - 1].displacement)
      return diagnostics_.report<DiagnosticCode::static_table_order>(displacement.span, excerpt(displacement.text));
    if (points[i].force > points[i - 1].force) return;
    diagnostics_.report<DiagnosticCode::static_table_falls>(force_there.span, excerpt(force_there.text),
                                                            excerpt(decl_.table[i - 1].second.text));
    diagnostics_.note<DiagnosticCode::static_table_remedy>({});
  }

  // What cannot be read counts as 1, so that it causes no further complaints.
  double read(const std::optional<ValueDecl>& decl, const char* taker, const Dimension& due) {
    if (!decl) return 1;
    return values_.read_constant(*decl, {taker, due, motion_}).value_or(1);
  }
  double read(const ValueDecl& decl, const char* taker, const Dimension& due) {
    return read(std::optional(decl), taker, due);
  }

  double read_positive(const std::optional<ValueDecl>& decl, const char* taker, const Dimension& due) {
    const double value = read(decl, taker, due);
    if (value > 0) return value;
    diagnostics_.report<DiagnosticCode::not_positive>(decl->span, taker, decl->text);
    return 1;
  }

  Dimension length() const { return motion_ == motion::rotation ? dimensions::angle : dimensions::length; }
  Dimension force() const { return motion_ == motion::rotation ? dimensions::torque : dimensions::force; }

  const StaticDecl& decl_;
  ParameterTable& values_;
  motion motion_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<StaticCurve> read_static_curve(const StaticDecl& decl, ParameterTable& values, motion port_motion,
                                             Diagnostics& diagnostics) {
  return CurveReader(decl, values, port_motion, diagnostics).read();
}

std::string to_text(const StaticCurve& curve, motion port_motion) {
  const PortUnits units = port_units(port_motion);
  const std::string through =
      fmt::format("{:g} {} at {:g} {}", curve.point.force, units.force, curve.point.displacement, units.position);
  const char* is = curve.is_instantaneous ? "at once" : "at rest";
  switch (curve.kind) {
    case StaticCurve::Kind::power: return fmt::format("power {:g}, {}, {}", curve.shape, through, is);
    case StaticCurve::Kind::exponential:
      return fmt::format("exponential, {:g} 1/{}, {}, {}", curve.shape, units.position, through, is);
    case StaticCurve::Kind::table:
      return fmt::format("table of {} points up to {}, {}", curve.points.size(), through, is);
  }
  return "";
}

}  // namespace dashpot::compiler
