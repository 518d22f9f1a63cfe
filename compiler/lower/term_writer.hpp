// Writes terms as statements of a law. What occurs twice becomes a local; products with 0 and 1 and sums with 0 vanish;
// signs move outward, to where a sum becomes a difference.
//
// Sine and cosine become polynomials: with k the whole number nearest to θ/π and r = θ − k π, |r| ≤ π/2,
//
//     sin θ = (−1)^k r P(r²),   cos θ = (−1)^k Q(r²),
//
// where P and Q meet sin(√z)/√z and cos(√z) at the Chebyshev nodes of 0 ≤ z ≤ π²/4. Without rounding they are off by
// less than sine_error() of 1. Angles beyond 2²⁰ half turns lose digits. Of an angle that is known to stay within a
// quarter turn of k π/4, k a whole number, r = θ − k π/4 takes less, since k is known beforehand.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "discretise/law_writer.hpp"
#include "lower/term.hpp"

namespace dashpot::compiler {

// The largest error of sine and cosine before rounding [1].
double sine_error(ScalarType scalar);

class TermWriter {
 public:
  explicit TermWriter(LawWriter& writer) : writer_(writer) {}
  // For another program of the same law: constants have the same names as in the first.
  TermWriter(LawWriter& writer, const TermWriter& first)
      : writer_(writer), labels_(first.labels_), numbers_(first.numbers_), ranges_(first.ranges_) {}

  // States the range in which an angle, a variable, always stays [rad].
  void bound(VariableId angle, double low, double high) { ranges_[angle] = {low, high}; }

  // The name of the local for this term, if one is made.
  void call(const Term& term, const std::string& name, const std::string& unit, const std::string& meaning);
  // The name of a constant with this magnitude.
  void call(double number, const std::string& name, const std::string& unit, const std::string& meaning);

  // Call this for all terms before any is written, so that terms used twice become locals.
  void count(const Term& term);
  // Writes a statement of `program`, after those that it needs.
  void assign(std::vector<Statement>& program, VariableId target, const Term& term, const std::string& purpose);

 private:
  using NodeId = std::size_t;
  // ± the value of a node.
  struct Signed {
    NodeId node;
    bool is_negative = false;
  };
  enum class Kind { number, variable, add, subtract, multiply, divide, square_root, where, pick };
  struct Node {
    Kind kind;
    double number = 0;  // or an index into tables_
    VariableId variable = {};
    std::vector<NodeId> operands = {};
    std::size_t uses = 0;
    std::string name = {}, unit = {}, meaning = {};
    VariableId local = no_variable;
  };
  struct Label {
    std::string name, unit, meaning;
    bool is_made = false;  // a constant of that name has been made
  };
  struct Circular {
    Signed sine, cosine;
  };

  Signed intern(const Term& term);
  Signed unseen(const Term& term);
  Signed number(double value);
  Signed node(Kind kind, std::vector<NodeId> operands);
  Signed add(Signed a, Signed b);
  Signed multiply(Signed a, Signed b);
  Signed divide(Signed a, Signed b);
  Signed where(Signed condition, Signed yes, Signed no);
  Signed pick(const std::shared_ptr<const TermTable>& table, NodeId place);
  NodeId positive(Signed value);  // a node with that value
  Circular circular(Signed angle);
  Circular about_half_turns(Signed angle, const std::string& which);
  Circular about_eighth_turns(Signed angle, int eighths, const std::string& which);
  std::optional<int> eighths_nearby(NodeId angle) const;
  std::optional<std::pair<double, double>> range_of(NodeId angle) const;
  Signed named(const Real& value, const std::string& name, const char* unit, const char* meaning);
  Signed polynomial(const std::vector<Real>& coefficients, const char* name, Signed z);
  void label(Signed value, const std::string& name, const std::string& unit, const std::string& meaning);
  void use(NodeId id);
  bool is_number(Signed value, double magnitude) const;

  ExpressionId expression(std::vector<Statement>& program, NodeId id);
  ExpressionId written(std::vector<Statement>& program, NodeId id);
  std::string name_of(NodeId id);

  LawWriter& writer_;
  std::vector<Node> nodes_;
  std::map<std::tuple<Kind, double, VariableId, std::vector<NodeId>>, NodeId> known_;
  std::map<const Term::Node*, Signed> interned_;
  std::vector<Term> kept_;  // keeps all terms alive, so that no address is reused
  std::map<NodeId, Circular> circular_;
  std::vector<std::shared_ptr<const TermTable>> tables_;  // one for each name
  std::map<double, Label> labels_;
  std::size_t parts_ = 0, numbers_ = 0;
  std::map<VariableId, std::pair<double, double>> ranges_;
};

}  // namespace dashpot::compiler
