#include <fmt/format.h>

#include "law/cost.hpp"
#include "law/walk.hpp"
#include "report/equations.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"
#include "source/counted.hpp"

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

}  // namespace

std::string tunable_law_html(const Compilation& c) {
  const TunableTables& tables = *c.law.tunable;
  const std::size_t states = cost_of(c.law, c.law.output).states;
  std::string html =
      "<p><code>set()</code> changes the parameters and recomputes the constants from them. Called right after a "
      "sample, it injects no energy if the command is then taken from <code>output()</code> of that sample. "
      "Everything else on this page is for the parameters' defaults.</p>\n";
  html += parameters_table(tables, c.network);
  html += "<p>The brake's <i>b</i> after <code>set()</code>: " + escaped(tables.brake.text) + ".";
  if (!tables.mesh_elements.empty())
    html += " By backward Euler, because their relaxations depend on a parameter or on several slips: " +
            escaped(joined_names(tables.mesh_elements)) + ".";
  return html + fmt::format(
                    " Cost at most: {} operations before the command, {} after it, {} in <code>set()</code>; "
                    "{}.</p>\n",
                    operations_of(cost_of(c.law, c.law.output)), operations_of(cost_of(c.law, c.law.update)),
                    operations_of(cost_of(c.law, set_program(c.law))), counted(states, "state"));
}

}  // namespace dashpot::compiler
