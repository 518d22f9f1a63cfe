// A formula that is recorded instead of computed. Kinematics and port maps (axes/) are evaluated with this type in
// place of a number, so that their formulas become expressions of a law. Terms are values; equal terms are found when
// they are written (term_writer.hpp).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "axes/brakes.hpp"
#include "law/update_law.hpp"

namespace dashpot::compiler {

enum class TermKind { number, variable, add, multiply, divide, negate, square_root, sine, cosine, where, pick };

// A table from which a law reads the entry with a given number.
struct TermTable {
  std::string name, unit, meaning;
  std::vector<double> values;
};

class Term {
 public:
  struct Node {
    TermKind kind;
    double number = 0;         // if it is a number
    VariableId variable = {};  // if it is a variable
    std::vector<Term> operands = {};
    std::shared_ptr<const TermTable> table = {};  // if it is a pick
  };

  Term() : Term(0.0) {}
  explicit Term(double number) : node_(std::make_shared<Node>(Node{TermKind::number, number})) {}
  explicit Term(VariableId variable) : node_(std::make_shared<Node>(Node{TermKind::variable, 0, variable})) {}
  Term(TermKind kind, std::vector<Term> operands)
      : node_(std::make_shared<Node>(Node{kind, 0, {}, std::move(operands)})) {}

  Term(TermTable table, const Term& place)
      : node_(std::make_shared<Node>(
            Node{TermKind::pick, 0, {}, {place}, std::make_shared<const TermTable>(std::move(table))})) {}

  const Node& node() const { return *node_; }

 private:
  std::shared_ptr<const Node> node_;
};

inline Term operator-(const Term& a) { return {TermKind::negate, {a}}; }
inline Term operator+(const Term& a, const Term& b) { return {TermKind::add, {a, b}}; }
inline Term operator-(const Term& a, const Term& b) { return a + -b; }
inline Term operator*(const Term& a, const Term& b) { return {TermKind::multiply, {a, b}}; }
inline Term operator/(const Term& a, const Term& b) { return {TermKind::divide, {a, b}}; }
inline Term sqrt(const Term& a) { return {TermKind::square_root, {a}}; }
inline Term sin(const Term& a) { return {TermKind::sine, {a}}; }
inline Term cos(const Term& a) { return {TermKind::cosine, {a}}; }
// Whether a term stands for the limit of a brake without a limit.
inline bool is_unlimited(const Term& a) {
  return a.node().kind == TermKind::number && a.node().number >= axes::unlimited;
}
// `yes` where `condition` is above zero, else `no`.
inline Term where(const Term& condition, const Term& yes, const Term& no) {
  return {TermKind::where, {condition, yes, no}};
}
inline Term min(const Term& a, const Term& b) { return is_unlimited(b) ? a : where(b - a, a, b); }
// Whether the form of the term shows that it is 0, whatever its variables.
inline bool is_zero(const Term& a) {
  const std::vector<Term>& of = a.node().operands;
  switch (a.node().kind) {
    case TermKind::number: return a.node().number == 0;
    case TermKind::multiply: return is_zero(of[0]) || is_zero(of[1]);
    case TermKind::add: return is_zero(of[0]) && is_zero(of[1]);
    case TermKind::negate: return is_zero(of[0]);
    default: return false;
  }
}
// Whether the form of the term shows that it is 0 or more, whatever its variables, as with squares and roots.
inline bool is_never_negative(const Term& a) {
  const std::vector<Term>& of = a.node().operands;
  switch (a.node().kind) {
    case TermKind::number: return a.node().number >= 0;
    case TermKind::multiply:
      if (&of[0].node() == &of[1].node() || is_zero(a)) return true;
      return is_never_negative(of[0]) && is_never_negative(of[1]);
    case TermKind::add:
    case TermKind::divide: return is_never_negative(of[0]) && is_never_negative(of[1]);
    case TermKind::negate: return is_zero(of[0]);
    case TermKind::where: return is_never_negative(of[1]) && is_never_negative(of[2]);
    case TermKind::square_root: return true;
    default: return false;
  }
}
inline Term max(const Term& a, const Term& b) { return is_zero(b) && is_never_negative(a) ? a : where(a - b, a, b); }
// The table's entry whose index is the whole part of `place`, which must lie within the table.
inline Term pick(TermTable table, const Term& place) { return {std::move(table), place}; }
inline Term abs(const Term& a) { return where(a, a, -a); }

}  // namespace dashpot::compiler
