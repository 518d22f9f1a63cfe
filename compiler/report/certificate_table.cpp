#include "report/certificate_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "report/page_parts.hpp"

namespace dashpot::compiler {
namespace {

std::string fact_row(const std::string& name, const std::string& value, const std::string& unit) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", name, value, unit);
}

std::string damping_facts(const Certificate& c, const PortUnits& units) {
  std::string html = fact_row("damping needed", number_text(c.bound.needed), units.damping);
  if (c.bound.frequency > 0) html += fact_row("most at", number_text(c.bound.frequency), "Hz");
  html += fact_row("damping guaranteed", number_text(c.assured), units.damping);
  if (c.added_damping > 0)
    html += fact_row("of which added for passivity", number_text(c.added_damping), units.damping);
  if (c.certified) return html;
  const double missing = c.minimum_damping - c.added_damping;
  const std::string lacking = std::isfinite(missing) ? number_text(missing) : "no command is enough";
  return html + fact_row("missing in the brake's command", lacking, units.damping);
}

std::string encoder_facts(const Certificate& c, const PortUnits& units) {
  if (c.loop.encoder_step == 0) return "";
  std::string html;
  if (c.quantisation_gain)
    html += fact_row("energy of the encoder's steps is that of a spring of", number_text(*c.quantisation_gain),
                     units.stiffness);
  html += fact_row("friction dissipates it up to 2<i>f</i><sub>c</sub>/Δ =", number_text(c.quantisation_stiffness),
                   units.stiffness);
  if (unpaid_force(c) > 0)
    html += fact_row("the rest can give the hand", number_text(unpaid_force(c)), "J/" + units.position);
  return html;
}

}  // namespace

std::string certificate_html(const Compilation& compilation) {
  const Certificate& c = compilation.certificate;
  const PortUnits units = dotted_units(compilation.network.port_motion);
  std::string html;
  for (const std::string& line : passivity_lines(c, units.damping)) html += sentence(line);
  const std::string facts = (c.bound.proof == Proof::none ? "" : damping_facts(c, units)) + encoder_facts(c, units);
  return facts.empty() ? html : html + "<table class=\"facts\"><tbody>\n" + facts + "</tbody></table>\n";
}

}  // namespace dashpot::compiler
