#include <fmt/format.h>

#include "report/equations.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// The elements whose values follow a parameter, the first few of them.
std::string followers(const std::string& parameter, const Network& network) {
  constexpr std::size_t most_named = 4;
  std::vector<std::string> names;
  for (const Element& element : network.elements)
    if (element.parameter && network.parameters[*element.parameter].name == parameter) names.push_back(element.name);
  const std::size_t more = names.size() > most_named ? names.size() - most_named : 0;
  names.resize(names.size() - more);
  return joined_names(names) + (more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string parameters_table(const TunableTables& tables, const Network& network) {
  std::string html =
      "<div class=\"wide\"><table><thead><tr><th>parameter</th><th>default</th><th>least</th><th>most</th>"
      "<th class=\"word\">unit</th><th class=\"word\">value of</th></tr></thead><tbody>\n";
  for (const Tunable& t : tables.tunables)
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td class=\"word\">{}</td>"
        "<td class=\"word\">{}</td></tr>\n",
        escaped(t.name), number_text(t.range.value), number_text(t.range.min), number_text(t.range.max),
        escaped(t.unit), escaped(followers(t.name, network)));
  return html + "</tbody></table></div>\n";
}

// The force of the emitted class's parts, which has no statements of its own to show.
std::string command(const Compilation& c) {
  const bool has_slips = !c.law.tunable->yields.empty();
  return fmt::format(
      "<ul class=\"law\">\n<li><math><mrow><mi>m</mi><mo>=</mo><mi>s</mi><mo>&#x2062;</mo><mrow><mi "
      "mathvariant=\"normal\">Δ</mi>"
      "<mi>u</mi></mrow><mo>+</mo><mi>S</mi>{}<mo>+</mo>"
      "<mrow><mo stretchy=\"false\">(</mo><msub><mi>b</mi><mo>∞</mo></msub><mo>−</mo><mi>b</mi><mo "
      "stretchy=\"false\">)</mo>"
      "</mrow><mover><mi>v</mi><mo>^</mo></mover></mrow></math> <span class=\"purpose\">{}</span></li>\n</ul>\n",
      has_slips ? "<mo>+</mo><mi>σ</mi>" : "",
      has_slips ? "s, S, σ: what springs answer in a sample, hold, and what is behind slips"
                : "s, S: what springs answer within a sample, and what they hold");
}

}  // namespace

std::string tunable_law_html(const Compilation& c) {
  const TunableTables& tables = *c.law.tunable;
  const TunableCost cost = cost_of(tables);
  std::string html =
      "<p>The constants follow the parameters: <code>set()</code> takes the law to others between two samples, "
      "and injects no energy. Everything else on this page holds for their defaults.</p>\n";
  html += parameters_table(tables, c.network) + command(c);
  html += "<p>The brake's <i>b</i> follows " + escaped(tables.brake) + ".";
  if (!tables.mesh_elements.empty())
    html += " By backward Euler, since their relaxations mix with a parameter or at several slips: " +
            escaped(joined_names(tables.mesh_elements)) + ".";
  return html + fmt::format(
                    " Cost at most: {} operations before the command, {} after it, {} in <code>set()</code>; "
                    "{} state{}.</p>\n",
                    cost.output, cost.update, cost.set, cost.states, cost.states == 1 ? "" : "s");
}

}  // namespace dashpot::compiler
