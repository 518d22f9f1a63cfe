#include "fig5_section.hpp"

#include <fmt/format.h>

#include <laws.hpp>

#include "claims.hpp"
#include "fig5_figure.hpp"

namespace dashpot::paper {

Fig5 measure_fig5() {
  return {respond<laws::fig5_exact>(fig5::solid, fig5::insertion, fig5::end),
          respond<laws::fig5_euler>(fig5::solid, fig5::insertion, fig5::end)};
}

Section show(const Fig5& measured) {
  const double damping = laws::fig5_exact{}.output(0, 0).damping;
  return {
      "fig5",
      "Fig. 5: realisation and closed form of a 2nd-order Maxwell solid",
      {fmt::format("In steps of 200 ms, chosen by the paper to exaggerate the error, its scheme departs from the "
                   "closed form (6) by {:.3f} % "
                   "of the peak, at {} s. The scheme `exact` departs by {:.0e}: rounding, since the motion is linear "
                   "between samples.",
                   100 * relative_error(measured.euler), worst(measured.euler).time, relative_error(measured.exact)),
       fmt::format(
           "“The error, which still remains small” {}: it is {} than a twentieth of the peak in steps of 200 ms.",
           outcome(relative_error(measured.euler) < 0.05), more_or_less(relative_error(measured.euler), 0.05))},
      {fig5::figure(measured.exact, measured.euler, damping)},
      {}};
}

}  // namespace dashpot::paper
