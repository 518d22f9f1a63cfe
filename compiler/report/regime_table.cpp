#include "report/regime_table.hpp"

#include <fmt/format.h>

#include "decompose/slip_laws.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "–" : text;
}

std::string row(const ComponentSplit& split, std::size_t i, const Network& network) {
  const Regime& regime = split.regimes.regimes[i];
  const BrakeShare& share = split.shares[i];
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"word\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      escaped(listed(slip_names(split.regimes, regime, true, network))),
      escaped(listed(slip_names(split.regimes, regime, false, network))), number_text(share.damping),
      number_text(to_double(regime.feedthrough())), number_text(share.compensation),
      number_text(to_double(regime.form.static_stiffness)));
}

std::string table(const ComponentSplit& split, const Network& network) {
  const PortUnits units = page_units(network.port_motion);
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"candidates\"><thead><tr><th>sliding</th><th class=\"word\">stuck</th>"
      "<th>brake <i>b</i> [{0}]</th><th>feedthrough <i>b</i><sub>∞</sub> [{0}]</th><th>compensated [{0}]</th>"
      "<th>static stiffness [{1}]</th></tr></thead><tbody>\n",
      units.damping, units.stiffness);
  for (std::size_t i = 0; i < split.regimes.regimes.size(); ++i) html += row(split, i, network);
  return html + "</tbody></table></div>\n";
}

// What each law does in runs of the whole network.
std::string merits_table(const SlipDecomposition& slips, const Network& network) {
  if (slips.merits.empty()) return "";
  const PortUnits units = page_units(network.port_motion);
  std::string html = fmt::format(
      "<p>Laws behind slips in runs around yield, sines at both ends of the band and a drag with reversals; within "
      "{} % the largest brake is taken.</p>\n<div class=\"wide\"><table class=\"candidates\"><thead><tr>"
      "<th class=\"word\">law</th><th>peak error [%]</th><th>rms error [%]</th><th>mean brake [{}]</th>"
      "<th>minimum damping [{}]</th><th>motor noise [{}]</th></tr></thead><tbody>\n",
      number_text(100 * slips.limit), units.damping, units.damping, units.force);
  for (const SlipLawMerit& merit : slips.merits)
    html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        name_of(merit.law), number_text(100 * merit.peak_error), number_text(100 * merit.rms_error),
                        number_text(merit.mean_damping), number_text(merit.minimum_damping),
                        merit.motor_noise ? number_text(*merit.motor_noise) : "not linear");
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string regimes_html(const Compilation& c) {
  std::string html;
  if (c.law.tunable)
    html = fmt::format("<p>Chosen: <b>{}</b>; {}.</p>\n", escaped(c.decomposition.choice().name),
                       escaped(c.decomposition.choice().reason));
  for (const SlipLikes& likes : likes_of(c.decomposition.slips, c.network)) {
    html += "<p>" + escaped(to_text(likes)) + "</p>\n";
    if (!likes.first->regimes.regimes.empty()) html += table(*likes.first, c.network);
  }
  html += merits_table(c.decomposition.slips, c.network);
  return html;
}

}  // namespace dashpot::compiler
