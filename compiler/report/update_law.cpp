#include <fmt/format.h>

#include <algorithm>

#include "law/walk.hpp"
#include "report/equations.hpp"
#include "report/law_mathml.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

std::string math(const std::string& inner) { return "<math>" + inner + "</math>"; }

std::string line(const std::string& left, const char* sign, const std::string& right, const std::string& purpose) {
  return "<li><div class=\"wide\">" + math("<mrow>" + left + "<mo>" + sign + "</mo>" + right + "</mrow>") +
         "</div> <span class=\"purpose\">" + escaped(purpose) + "</span></li>\n";
}

// Remembering a sample under another name is no equation.
bool only_copies(const UpdateLaw& law, const Statement& statement) {
  return law.expressions[statement.value].operation == Operation::read && statement.assigns();
}

template <class Solved>
std::string solved_together(const UpdateLaw& law, const Statement& statement, const Solved& slips) {
  return line(variable_mathml(law.variables[statement.target]), "=",
              "<mi>slips</mi><mo stretchy=\"false\">(</mo>" + expression_mathml(law, statement.value) +
                  "<mo stretchy=\"false\">)</mo>",
              fmt::format("{} slip{} at most {} operations", slips.slip_count(),
                          slips.slip_count() == 1 ? "," : "s together,", slips.operations()));
}

std::string program(const UpdateLaw& law, const std::vector<Statement>& statements) {
  std::string list = "<ul class=\"law\">\n";
  for (const Statement& s : statements) {
    const Variable& target = law.variables[s.target];
    if (visit_solved(law, s, [&](const auto& slips) { list += solved_together(law, s, slips); })) continue;
    if (target.role == Role::local || !only_copies(law, s))
      list += line(variable_mathml(target), target.role == Role::local ? "=" : "←", expression_mathml(law, s.value),
                   s.purpose);
    else if (target.name == "last_position")
      list += line(variable_mathml(target), "←", expression_mathml(law, s.value), s.purpose);
  }
  return list + "</ul>\n";
}

std::size_t shared_ending(const std::string& a, const std::string& b) {
  std::size_t same = 0;
  while (same < a.size() && same < b.size() && a[a.size() - 1 - same] == b[b.size() - 1 - same]) ++same;
  return same;
}

// The place's name without what the coefficient adds to it: "B1_K1" of "B1_K1_gain" in "mode_gain". A coefficient that
// is called after its first place has that place's whole name: there the others tell what is added.
std::string place_name(const Coefficient& c, std::size_t place) {
  const std::string& name = c.element_names[place];
  std::size_t added = shared_ending(name, c.name);
  if (name == c.name)
    for (const std::string& other : c.element_names)
      if (other != name) added = std::min(added, shared_ending(name, other));
  return name.substr(0, name.size() - added);
}

std::string coefficients_table(const UpdateLaw& law, std::size_t size) {
  std::vector<const Coefficient*> columns;
  for (const Coefficient& c : law.coefficients)
    if (c.values.size() == size && !c.is_table() && c.role != ConstantRole::energy_weight) columns.push_back(&c);
  if (columns.empty()) return "";
  std::string table = "<div class=\"wide\"><table><thead><tr><th>i</th>";
  for (const Coefficient* c : columns)
    table += fmt::format("<th>{} [{}]</th>", math(coefficient_mathml(*c)), escaped(c->unit));
  table += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < size; ++i) {
    table += "<tr><th scope=\"row\">" + escaped(place_name(*columns.front(), i)) + "</th>";
    for (const Coefficient* c : columns) table += "<td>" + number_text(c->values[i]) + "</td>";
    table += "</tr>\n";
  }
  return table + "</tbody></table></div>\n";
}

std::string all_tables(const UpdateLaw& law) {
  std::string html;
  std::vector<std::size_t> sizes;
  for (const Coefficient& c : law.coefficients)
    if (c.values.size() > 1 && std::find(sizes.begin(), sizes.end(), c.values.size()) == sizes.end()) {
      sizes.push_back(c.values.size());
      html += coefficients_table(law, c.values.size());
    }
  return html;
}

}  // namespace

std::string brake_text(const UpdateLaw& law) {
  const std::string least = number_text(law.damping);
  return law.largest_damping > law.damping ? least + " to " + number_text(law.largest_damping) : least;
}

std::string update_law_html(const Compilation& c) {
  const PortUnits units = dotted_units(c.network.port_motion);
  std::string html = fmt::format(
      "<p>At each sample, with the position <i>u</i> and an estimate <i>v̂</i> of the velocity: "
      "<b class=\"brake\">brake</b> <i>b</i>{} {}, <b class=\"motor\">motor</b> <i>m</i> [{}].</p>\n",
      (c.law.largest_damping > c.law.damping ? " from " : " = ") + brake_text(c.law), units.damping, units.force);
  if (c.law.tunable) html += tunable_law_html(c);
  html += "<h4>Before the command leaves</h4>\n" + program(c.law, c.law.output);
  const std::string after = program(c.law, c.law.update);
  if (after.find("<li>") != after.npos) html += "<h4>After it has left</h4>\n" + after;
  return html + all_tables(c.law);
}

}  // namespace dashpot::compiler
