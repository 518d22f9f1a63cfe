#include <fmt/format.h>

#include "discretise/element_names.hpp"
#include "report/equations.hpp"
#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

constexpr std::size_t most_written_modes = 4;  // more stand in the table alone

std::string display(const std::string& inner) {
  return "<math display=\"block\"><mrow><mi>D</mi><mo stretchy=\"false\">(</mo><mi>s</mi><mo stretchy=\"false\">)</mo>"
         "<mo>=</mo>" +
         inner + "</mrow></math>\n";
}

std::string in_letters() {
  return display(
      "<msub><mi>k</mi><mn>0</mn></msub><mo>+</mo><msub><mi>b</mi><mo>∞</mo></msub><mi>s</mi><mo>+</mo>"
      "<munder><mo>∑</mo><mi>i</mi></munder><msub><mi>k</mi><mi>i</mi></msub>"
      "<mfrac><mi>s</mi><mrow><mi>s</mi><mo>+</mo><msub><mi>λ</mi><mi>i</mi></msub></mrow></mfrac>");
}

std::string term(const Mode& mode) {
  return number_mathml(to_double(mode.stiffness)) + "<mfrac><mi>s</mi><mrow><mi>s</mi><mo>+</mo>" +
         number_mathml(to_double(mode.relaxation_rate)) + "</mrow></mfrac>";
}

std::string in_numbers(const LinearForm& form) {
  std::string sum;
  const auto add = [&](const std::string& part) { sum += (sum.empty() ? "" : "<mo>+</mo>") + part; };
  if (form.static_stiffness > 0) add(number_mathml(to_double(form.static_stiffness)));
  if (form.feedthrough_damping > 0) add(number_mathml(to_double(form.feedthrough_damping)) + "<mi>s</mi>");
  if (form.modes.size() > most_written_modes)
    add("<munder><mo>∑</mo><mi>i</mi></munder><msub><mi>k</mi><mi>i</mi></msub><mfrac><mi>s</mi><mrow><mi>s</mi><mo>+</"
        "mo>"
        "<msub><mi>λ</mi><mi>i</mi></msub></mrow></mfrac>");
  else
    for (const Mode& mode : form.modes) add(term(mode));
  return display(sum.empty() ? "<mn>0</mn>" : sum);
}

std::string row(const std::string& name, const std::string& value, const std::string& unit) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", name, value, unit);
}

std::string modes_table(const Compilation& c, const PortUnits& units) {
  std::string table = fmt::format(
      "<div class=\"wide\"><table><thead><tr><th>mode of</th><th><i>k</i> [{}]</th><th><i>λ</i> "
      "[1/s]</th><th>1/<i>λ</i> [s]</th>"
      "<th><i>k</i>/<i>λ</i> [{}]</th></tr></thead><tbody>\n",
      units.stiffness, units.damping);
  for (const Mode& mode : c.form.linear.modes)
    table += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                         escaped(name_of(mode.elements, c.network)), number_text(to_double(mode.stiffness)),
                         number_text(to_double(mode.relaxation_rate)), number_text(to_double(1 / mode.relaxation_rate)),
                         number_text(to_double(mode.damping())));
  return table + "</tbody></table></div>\n";
}

}  // namespace

std::string canonical_form_html(const Compilation& c) {
  const LinearForm& form = c.form.linear;
  const PortUnits units = dotted_units(c.network.port_motion);
  std::string html = in_letters() + in_numbers(form) + "<table class=\"facts\"><tbody>\n";
  html += row("static stiffness <i>k</i><sub>0</sub>", number_text(to_double(form.static_stiffness)), units.stiffness);
  html +=
      row("feedthrough damping <i>b</i><sub>∞</sub>", number_text(to_double(form.feedthrough_damping)), units.damping);
  html += row("zero-frequency damping <i>b</i><sub>∞</sub> + ∑<i>k</i>/<i>λ</i>",
              number_text(to_double(zero_frequency_damping(form))), units.damping);
  html += "</tbody></table>\n";
  return form.modes.empty() ? html : html + modes_table(c, units);
}

}  // namespace dashpot::compiler
