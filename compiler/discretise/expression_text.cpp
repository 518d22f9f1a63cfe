#include "discretise/expression_text.hpp"

namespace dashpot::compiler {

int precedence(Operation operation) {
  switch (operation) {
    case Operation::add:
    case Operation::subtract: return 1;
    case Operation::multiply: return 2;
    case Operation::where: return 0;
    default: return 3;
  }
}

namespace {

class Printer {
 public:
  Printer(const UpdateLaw& law, const Spelling& spelling) : law_(law), spelling_(spelling) {}

  std::string text(ExpressionId id) const {
    const Expression& e = law_.expressions[id];
    switch (e.operation) {
      case Operation::read: return spelling_.variable(law_.variables[e.left]);
      case Operation::constant: return spelling_.coefficient(law_.coefficients[e.left]);
      case Operation::add: return spelling_.relax && is_relaxation(e) ? relaxation(e) : binary(e, " + ");
      case Operation::subtract: return binary(e, " - ");
      case Operation::multiply: return binary(e, " * ");
      case Operation::flush: return spelling_.flush(text(e.left));
      case Operation::clamp: return spelling_.clamp(text(e.left), text(e.right));
      case Operation::where:
        if (spelling_.where) return spelling_.where(text(e.condition), text(e.left), text(e.right));
        return grouped(e.condition, 1) + " > 0 ? " + grouped(e.left, 1) + " : " + grouped(e.right, 1);
      case Operation::pick: return spelling_.pick(law_.coefficients[e.left], text(e.right));
      case Operation::sum: return spelling_.sum(law_.variables[law_.expressions[e.left].left]);
    }
    return "";
  }

 private:
  bool is_relaxation(const Expression& sum) const {
    const Expression& product = law_.expressions[sum.right];
    return product.operation == Operation::multiply && law_.expressions[product.right].operation == Operation::flush;
  }

  std::string relaxation(const Expression& sum) const {
    const Expression& product = law_.expressions[sum.right];
    return spelling_.relax(text(product.left), text(law_.expressions[product.right].left), text(sum.left));
  }

  // Operators associate to the left: a right operand of equal precedence needs its parentheses.
  std::string binary(const Expression& e, const char* sign) const {
    const int own = own_precedence(e.operation);
    return grouped(e.left, own) + sign + grouped(e.right, own + 1);
  }

  std::string grouped(ExpressionId id, int least_precedence) const {
    const std::string inner = text(id);
    return own_precedence(law_.expressions[id].operation) < least_precedence ? "(" + inner + ")" : inner;
  }

  // A call needs no parentheses.
  int own_precedence(Operation operation) const {
    return operation == Operation::where && spelling_.where ? precedence(Operation::read) : precedence(operation);
  }

  const UpdateLaw& law_;
  const Spelling& spelling_;
};

}  // namespace

std::string expression_text(const UpdateLaw& law, ExpressionId expression, const Spelling& spelling) {
  return Printer(law, spelling).text(expression);
}

}  // namespace dashpot::compiler
