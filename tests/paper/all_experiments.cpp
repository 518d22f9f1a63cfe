#include "all_experiments.hpp"

#include "ball.hpp"
#include "chosen.hpp"
#include "curl.hpp"
#include "fig11.hpp"
#include "fig12.hpp"
#include "fig13.hpp"
#include "fig3.hpp"
#include "fig5_section.hpp"
#include "fig6.hpp"
#include "fig7.hpp"
#include "fig8.hpp"
#include "fig9.hpp"
#include "hertz.hpp"
#include "isotropic.hpp"
#include "pareto.hpp"

namespace dashpot::paper {

std::vector<Section> all_experiments(bool thinned) {
  return {show(measured_fig3()),        show(measure_fig5()),    show(measure_fig6()),  show(measure_fig7()),
          show(measure_fig8()),         show(measure_fig9()),    show(measure_fig11()), show(measure_fig12()),
          show(measure_fig13(thinned)), show(measured_pareto()), show(measure_hertz()), show(measure_ball()),
          show(measure_isotropic()),    show(measure_curl())};
}

Table table_of_choices() {
  Table table{"Every number that is not printed, and why it is what it is", {"name", "value", "reason"}, {}};
  for (const Choice& choice : all_choices()) table.rows.push_back({choice.name, choice.value, choice.reason});
  return table;
}

}  // namespace dashpot::paper
