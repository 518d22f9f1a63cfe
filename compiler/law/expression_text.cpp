#include "law/expression_text.hpp"

#include <string_view>

namespace dashpot::compiler {
namespace {

class Printer {
 public:
  Printer(const UpdateLaw& law, const Spelling& spelling) : law_(law), spelling_(spelling) {}

  // Fills in a form: {name}, {f}, {law}, {0}, or {0:1} for an operand that needs parentheses if it binds less tightly
  // than 1.
  std::string text(ExpressionId id) const {
    const Expression& e = law_.expressions[id];
    std::string result;
    const std::string_view form = form_of(e.operation, spelling_.language).text;
    for (std::size_t at = 0; at < form.size(); ++at) {
      if (form[at] != '{') {
        result += form[at];
        continue;
      }
      const std::size_t end = form.find('}', at);
      const std::string_view what = form.substr(at + 1, end - at - 1);
      result += what == "name"  ? name(e)
                : what == "f"   ? spelling_.suffix
                : what == "law" ? spelling_.law
                                : operand(e, what);
      at = end;
    }
    return result;
  }

 private:
  std::string name(const Expression& e) const {
    if (facts_of(e.operation).refers_to == Referent::coefficient) return spelling_.coefficient(e.coefficient);
    return e.operation == Operation::sum ? spelling_.sum(e.variable) : spelling_.variable(e.variable);
  }

  std::string operand(const Expression& e, std::string_view what) const {
    const ExpressionId id = e.operands[static_cast<std::size_t>(what.front() - '0')];
    const int least = what.size() > 2 ? what.back() - '0' : 0;
    const std::string inner = text(id);
    return form_of(law_.expressions[id].operation, spelling_.language).tightness < least ? "(" + inner + ")" : inner;
  }

  const UpdateLaw& law_;
  const Spelling& spelling_;
};

}  // namespace

std::string expression_text(const UpdateLaw& law, ExpressionId expression, const Spelling& spelling) {
  return Printer(law, spelling).text(expression);
}

}  // namespace dashpot::compiler
