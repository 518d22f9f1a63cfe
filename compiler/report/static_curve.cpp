#include "report/static_curve.hpp"

#include <fmt/format.h>

#include "linear/motion_map.hpp"
#include "report/number_text.hpp"
#include "report/plot.hpp"

namespace dashpot::compiler {

std::string static_curve_html(const Compilation& c, const std::string& of) {
  if (!c.network.map) return "";
  const MotionMap& map = *c.network.map;
  const PortUnits units = dotted_units(c.network.port_motion);
  constexpr int points = 160, dots = 24;
  Curve wanted{"wanted", Channel::closed_form, {}, {}}, made{"emitted map", Channel::total, {}, {}};
  for (int i = 0; i <= points; ++i) {
    const double u = map.reach * i / points;
    wanted.x.push_back(map.start + u);
    wanted.y.push_back(to_double(force_at(*c.network.static_curve, u)));
  }
  for (int i = 0; i <= dots; ++i) {
    const double u = map.reach * i / dots;
    made.x.push_back(map.start + u);
    made.y.push_back(map.stiffness * map.value_at(u) * map.tangent_at(u));
  }
  made.dots = true;
  const char* title = c.network.static_curve->is_instantaneous ? "Force at once" : "Force at rest";
  Plot plot{title + of,
            {"displacement", units.position},
            {"force", units.force},
            AxisScale::linear,
            AxisScale::linear,
            {wanted, made},
            true};
  const double least = map.least_tangent(0, map.reach), most = map.steepest();
  plot.note = fmt::format("Off by at most {} % of the largest force.", number_text(100 * map.static_error, 2));
  return plot_figure(plot) + fmt::format(
                                 "<p class=\"note\">The network lies behind this curve: relaxation, creep and moduli "
                                 "below are its own. Felt at "
                                 "the tool they, and b, are {} to {} times as large, by how steep the curve is.</p>",
                                 number_text(least * least), number_text(most * most));
}

}  // namespace dashpot::compiler
