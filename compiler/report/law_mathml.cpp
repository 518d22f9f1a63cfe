#include "report/law_mathml.hpp"

#include <fmt/format.h>

#include <map>

#include "report/markup.hpp"
#include "report/number_text.hpp"

namespace dashpot::compiler {
namespace {

// The letters of theory, sections 3 and 4, for the names of the law.
const std::map<std::string, std::string>& letters() {
  static const std::string change = "<mrow><mi mathvariant=\"normal\">Δ</mi><mi>u</mi></mrow>";
  static const std::map<std::string, std::string> all = {{"position", "<mi>u</mi>"},
                                                         {"velocity", "<mover><mi>v</mi><mo>^</mo></mover>"},
                                                         {"position_change", change},
                                                         {"last_position", "<msub><mi>u</mi><mo>−</mo></msub>"},
                                                         {"sampled_position", "<mi>u</mi>"},
                                                         {"sampled_position_change", change},
                                                         {"sampled_velocity", "<mover><mi>v</mi><mo>^</mo></mover>"},
                                                         {"damping", "<mi>b</mi>"},
                                                         {"force", "<mi>m</mi>"},
                                                         {"relaxed_force", "<mi>S</mi>"},
                                                         {"mode_force", "<mi>F</mi>"},
                                                         {"mode_error", "<mi>e</mi>"},
                                                         {"mode_increment", "<mi>y</mi>"},
                                                         {"mode_next", "<mi>t</mi>"},
                                                         {"mode_decay", "<mi>a</mi>"},
                                                         {"mode_gain", "<mi>g</mi>"},
                                                         {"mode_velocity_drive", "<mi>w</mi>"},
                                                         {"mode_loss", "<mi>α</mi>"}};
  return all;
}

std::string symbol(const std::string& name, bool indexed) {
  const auto known = letters().find(name);
  const std::string letter = known == letters().end() ? "<mtext>" + escaped(name) + "</mtext>" : known->second;
  return indexed ? "<msub>" + letter + "<mi>i</mi></msub>" : letter;
}

std::string bracketed(const std::string& inner) {
  return "<mo stretchy=\"false\">(</mo>" + inner + "<mo stretchy=\"false\">)</mo>";
}

class Writer {
 public:
  explicit Writer(const UpdateLaw& law) : law_(law) {}

  std::string written(ExpressionId id) const {
    const Expression& e = law_.expressions[id];
    switch (e.operation) {
      case Operation::read: return variable_mathml(law_.variables[e.variable]);
      case Operation::constant: return constant(law_.coefficients[e.coefficient]);
      case Operation::add: return sum(e.operands[0], grouped(e.operands[1], 2));
      case Operation::subtract: return grouped(e.operands[0], 1) + "<mo>−</mo>" + grouped(e.operands[1], 2);
      case Operation::multiply: return product(grouped(e.operands[0], 2), grouped(e.operands[1], 3));
      case Operation::divide:
        return "<mfrac><mrow>" + written(e.operands[0]) + "</mrow><mrow>" + written(e.operands[1]) + "</mrow></mfrac>";
      case Operation::square_root: return "<msqrt>" + written(e.operands[0]) + "</msqrt>";
      case Operation::mean_decay:
        return "<mi>φ</mi><mo stretchy=\"false\">(</mo>" + written(e.operands[0]) + "<mo stretchy=\"false\">)</mo>";
      case Operation::flush: return written(e.operands[0]);
      case Operation::clamp:
        return "<mi>clamp</mi>" +
               bracketed(written(e.operands[0]) + "<mo>,</mo><mo>±</mo>" + grouped(e.operands[1], 3));
      case Operation::where: return choice(e);
      case Operation::relax: return sum(e.operands[2], product(grouped(e.operands[0], 2), grouped(e.operands[1], 3)));
      case Operation::pick:
        return "<msub>" + coefficient_mathml(law_.coefficients[e.coefficient]) + written(e.operands[0]) + "</msub>";
      case Operation::sum: return summed(law_.variables[e.variable]);
    }
    return "";
  }

 private:
  static std::string constant(const Coefficient& c) {
    return c.values.size() == 1 ? number_mathml(c.values.front()) : coefficient_mathml(c);
  }

  // Letters stand side by side; names, and numbers behind anything, need a dot between them.
  static std::string product(const std::string& left, const std::string& right) {
    const auto needs_dot = [](const std::string& factor) { return factor.find("<mtext>") != factor.npos; };
    const bool dotted = needs_dot(left) || needs_dot(right) || right.compare(0, 4, "<mn>") == 0;
    return left + (dotted ? "<mo>·</mo>" : "<mo>&#x2062;</mo>") + right;
  }

  // A negative number behind a plus is a minus: the value is the same to the last bit.
  std::string sum(ExpressionId left, std::string right) const {
    static const std::string minus = "<mn>−";
    const std::size_t number = right.find("<mn>");
    const bool comes_first = number != right.npos && right.substr(0, number).find_first_not_of("<mrow>") == right.npos;
    if (!comes_first || right.compare(number, minus.size(), minus) != 0) return grouped(left, 1) + "<mo>+</mo>" + right;
    right.replace(number, minus.size(), "<mn>");
    return grouped(left, 1) + "<mo>−</mo>" + right;
  }

  static std::string summed(const Variable& vector) {
    return "<munder><mo>∑</mo><mi>i</mi></munder>" + variable_mathml(vector);
  }

  std::string choice(const Expression& e) const {
    const std::string condition = grouped(e.operands[0], 1) + "<mo>&gt;</mo><mn>0</mn>";
    return "<mrow><mo>{</mo><mtable columnalign=\"left left\"><mtr><mtd>" + written(e.operands[1]) +
           "</mtd><mtd><mspace width=\"1em\"/><mtext>if</mtext><mspace width=\"0.4em\"/>" + condition +
           "</mtd></mtr><mtr><mtd>" + written(e.operands[2]) +
           "</mtd><mtd><mspace width=\"1em\"/><mtext>else</mtext></mtd></mtr></mtable></mrow>";
  }

  std::string grouped(ExpressionId id, int least_precedence) const {
    const Expression& e = law_.expressions[id];
    // The guard is not shown: what it guards decides.
    if (e.operation == Operation::flush) return grouped(e.operands[0], least_precedence);
    const std::string inner = "<mrow>" + written(id) + "</mrow>";
    if (form_of(e.operation, Language::text).tightness < least_precedence)
      return "<mrow>" + bracketed(inner) + "</mrow>";
    return e.operation == Operation::read || e.operation == Operation::constant ? written(id) : inner;
  }

  const UpdateLaw& law_;
};

}  // namespace

std::string expression_mathml(const UpdateLaw& law, ExpressionId expression) { return Writer(law).written(expression); }

std::string variable_mathml(const Variable& variable) { return symbol(variable.name, variable.size > 1); }
std::string coefficient_mathml(const Coefficient& coefficient) {
  return symbol(coefficient.name, coefficient.values.size() > 1);
}

}  // namespace dashpot::compiler
