#include "report/regime_table.hpp"

#include <fmt/format.h>

#include <algorithm>

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

// Names break behind their underscores, where a page is narrow.
std::string breakable(const std::string& names) {
  std::string html;
  for (const char c : escaped(names)) html += c == '_' ? "_<wbr>" : std::string(1, c);
  return html;
}

std::string row(const ComponentSplit& split, std::size_t i, const Network& network) {
  const Regime& regime = split.regimes.regimes[i];
  const BrakeShare& share = split.shares[i];
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"word\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
      breakable(listed(slip_names(split.regimes, regime, true, network))),
      breakable(listed(slip_names(split.regimes, regime, false, network))), number_text(share.damping),
      number_text(to_double(regime.feedthrough())), number_text(share.compensation),
      number_text(to_double(regime.form.static_stiffness)));
}

// Parts that are decided alike: each keeps its rows of the table.
struct Group {
  std::vector<const ComponentSplit*> parts;
};

bool is_decided_alike(const ComponentSplit& a, const ComponentSplit& b) {
  const auto same = [](const SlipLawOffer& x, const SlipLawOffer& y) {
    return x.law == y.law && x.refusal == y.refusal;
  };
  return a.law == b.law && a.reason == b.reason &&
         std::equal(a.offers.begin(), a.offers.end(), b.offers.begin(), b.offers.end(), same);
}

std::vector<Group> groups_of(const SlipDecomposition& slips) {
  std::vector<Group> groups;
  for (const ComponentSplit* split : slips.all()) {
    const auto alike = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& group) { return is_decided_alike(*group.parts.front(), *split); });
    if (alike == groups.end()) groups.push_back({{split}});
    else alike->parts.push_back(split);
  }
  return groups;
}

std::string decided(const Group& group, const Network& network) {
  std::vector<std::string> names;
  for (const ComponentSplit* split : group.parts) names.push_back(name_of(*split, network));
  const ComponentSplit& first = *group.parts.front();
  return fmt::format("<h3>Behind {}</h3>\n<p><b>{}</b>: {}.</p>\n", escaped(listed(names)), name_of(first.law),
                     escaped(in_four_digits(first.reason)));
}

// All laws, the one taken first, and why others are not to be had.
std::string candidates(const ComponentSplit& split) {
  if (split.offers.empty()) return "";
  std::string html = "<ul class=\"laws\">\n";
  for (const SlipLawOffer& offer : split.offers) {
    const bool is_taken = offer.law == split.law;
    const std::string verdict = is_taken                ? "taken"
                                : offer.refusal.empty() ? "possible"
                                                        : "not available: " + offer.refusal;
    html += fmt::format("<li{}><b>{}</b> {}</li>\n", is_taken ? " class=\"chosen\"" : "", name_of(offer.law),
                        escaped(in_four_digits(verdict)));
  }
  return html + "</ul>\n";
}

// Of a part whose regimes are too many to list, how many there are and what holds in all of them.
std::string unlisted(const ComponentSplit& split, const Network& network) {
  const double damping = split.shares.empty() ? 0 : split.shares.front().damping;
  return fmt::format(
      "<tr><th scope=\"row\" colspan=\"2\">each of {} patterns of "
      "{}</th><td>{}</td><td>–</td><td>–</td><td>–</td></tr>\n",
      number_text(split.regimes.count), escaped(name_of(split, network)), number_text(damping));
}

std::string table(const Group& group, const Network& network) {
  const PortUnits units = dotted_units(network.port_motion);
  std::string html = fmt::format(
      "<div class=\"wide\"><table class=\"regimes\"><thead><tr><th>sliding</th><th class=\"word\">stuck</th>"
      "<th>brake <i>b</i> [{0}]</th><th>feedthrough <i>b</i><sub>∞</sub> [{0}]</th><th>compensated [{0}]</th>"
      "<th>static stiffness [{1}]</th></tr></thead>\n",
      units.damping, units.stiffness);
  for (const ComponentSplit* split : group.parts) {
    html += "<tbody>\n";
    for (std::size_t i = 0; i < split->regimes.regimes.size(); ++i) html += row(*split, i, network);
    if (split->regimes.regimes.empty()) html += unlisted(*split, network);
    html += "</tbody>\n";
  }
  return html + "</table></div>\n";
}

// In which runs the law that is taken errs most and least.
std::string worst_run(const SlipDecomposition& slips) {
  if (slips.runs.empty()) return "";
  const auto [least, most] = extreme_runs(slips.runs);
  return fmt::format(
      "<p>With the slip rule that is taken, the felt force deviates by up to {} % of the largest force, in {}; least "
      "in {}, by {} %.</p>\n",
      number_text(100 * most.error), escaped(most.motion), escaped(least.motion), number_text(100 * least.error));
}

// What each law does in runs of the whole network.
std::string merits_table(const SlipDecomposition& slips, const Network& network) {
  if (slips.merits.empty()) return "";
  const PortUnits units = dotted_units(network.port_motion);
  std::string html = fmt::format(
      "<h3>Slip rules in test motions of the whole network</h3>\n<p>Each slip rule for all parts that can have it, in "
      "motions that make the slips yield: sines at both ends of the band and a drag with reversals; of those within "
      "{} % the one with the largest damping of the brake is taken.</p>\n{}"
      "<div class=\"wide\"><table class=\"candidates\"><thead><tr>"
      "<th class=\"word\">slip rule</th><th>peak error [%]</th><th>rms error [%]</th><th>mean brake [{}]</th>"
      "<th>minimum damping [{}]</th><th>certified</th><th>motor noise [{}]</th></tr></thead><tbody>\n",
      number_text(100 * slips.limit), worst_run(slips), units.damping, units.damping, units.force);
  for (const SlipLawMerit& merit : slips.merits)
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        name_of(merit.law), number_text(100 * merit.peak_error), number_text(100 * merit.rms_error),
        number_text(merit.mean_damping), merit.minimum_damping ? number_text(*merit.minimum_damping) : "–",
        merit.certified ? "yes" : "no", merit.motor_noise ? number_text(*merit.motor_noise) : "not linear");
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::string regimes_html(const Compilation& c) {
  std::string html;
  if (c.law.tunable)
    html = fmt::format("<p>Chosen: <b>{}</b>; {}.</p>\n", escaped(c.decomposition.choice().name),
                       escaped(c.decomposition.choice().why()));
  for (const Group& group : groups_of(c.decomposition.slips)) {
    html += decided(group, c.network);
    html += candidates(*group.parts.front());
    html += table(group, c.network);
  }
  html += merits_table(c.decomposition.slips, c.network);
  return html;
}

}  // namespace dashpot::compiler
