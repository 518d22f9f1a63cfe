#include "lower/term_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dashpot::compiler {
namespace {

// The number of coefficients of P; Q has one more. The smallest for which both are off by less than sine_error().
std::size_t sine_terms(ScalarType scalar) { return scalar == ScalarType::float64 ? 8 : 5; }

// The polynomial in z, lowest power first, that meets f at the Chebyshev nodes of [0, end]; by Newton's divided
// differences.
template <class Function>
std::vector<Real> interpolated(std::size_t terms, const Real& end, const Function& f) {
  const Real pi = boost::math::constants::pi<Real>();
  std::vector<Real> node, difference;
  for (std::size_t i = 0; i < terms; ++i) {
    node.push_back(end / 2 * (1 + cos(pi * (2 * i + 1) / (2 * terms))));
    difference.push_back(f(node.back()));
  }
  for (std::size_t order = 1; order < terms; ++order)
    for (std::size_t i = terms - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (node[i] - node[i - order]);
  std::vector<Real> power(terms, Real(0));
  for (std::size_t i = terms; i-- > 0;) {
    for (std::size_t j = terms - 1; j > 0; --j) power[j] = power[j - 1] - node[i] * power[j];
    power[0] = difference[i] - node[i] * power[0];
  }
  return power;
}

Real quarter_squared() { return boost::math::constants::pi<Real>() * boost::math::constants::pi<Real>() / 4; }

std::vector<Real> sine_polynomial(ScalarType scalar) {
  return interpolated(sine_terms(scalar), quarter_squared(),
                      [](const Real& z) -> Real { return sin(sqrt(z)) / sqrt(z); });
}

std::vector<Real> cosine_polynomial(ScalarType scalar) {
  return interpolated(sine_terms(scalar) + 1, quarter_squared(), [](const Real& z) -> Real { return cos(sqrt(z)); });
}

// π in two parts, of which the first has so few digits that its product with a whole number below 2²⁰ is exact.
std::pair<Real, Real> parts_of_pi(ScalarType scalar) {
  const Real pi = boost::math::constants::pi<Real>();
  const int digits = scalar == ScalarType::float64 ? 31 : 10;
  const Real high = ldexp(floor(ldexp(pi, digits)), -digits);
  return {high, pi - high};
}

// If this is added to a much smaller number and taken away again, the nearest whole number is left.
Real rounder(ScalarType scalar) { return ldexp(Real(3), scalar == ScalarType::float64 ? 51 : 22); }

// Largest k that is tried; no encoder's range goes further.
constexpr int most_eighths = 32;

}  // namespace

double sine_error(ScalarType scalar) { return scalar == ScalarType::float64 ? 2e-16 : 7e-9; }

void TermWriter::call(const Term& term, const std::string& name, const std::string& unit, const std::string& meaning) {
  label(intern(term), name, unit, meaning);
}

void TermWriter::call(double number, const std::string& name, const std::string& unit, const std::string& meaning) {
  labels_.emplace(std::abs(number), Label{name, unit, meaning});
}

void TermWriter::label(Signed value, const std::string& name, const std::string& unit, const std::string& meaning) {
  Node& node = nodes_[value.node];
  if (node.kind == Kind::number || node.kind == Kind::variable || !node.name.empty()) return;
  node.name = name, node.unit = unit, node.meaning = (value.is_negative ? "−" : "") + meaning;
}

void TermWriter::count(const Term& term) { use(intern(term).node); }

void TermWriter::use(NodeId id) {
  if (nodes_[id].uses++ > 0) return;
  const std::vector<NodeId> operands = nodes_[id].operands;
  for (const NodeId operand : operands) use(operand);
}

void TermWriter::assign(std::vector<Statement>& program, VariableId target, const Term& term,
                        const std::string& purpose) {
  const Signed value = intern(term);
  ExpressionId result = expression(program, value.node);
  if (value.is_negative) result = writer_.subtract(expression(program, number(0).node), result);
  writer_.assign(program, target, result, purpose);
}

TermWriter::Signed TermWriter::intern(const Term& term) {
  const auto found = interned_.find(&term.node());
  if (found != interned_.end()) return found->second;
  const Signed value = unseen(term);
  kept_.push_back(term);
  interned_.emplace(&term.node(), value);
  return value;
}

TermWriter::Signed TermWriter::unseen(const Term& term) {
  const Term::Node& n = term.node();
  std::vector<Signed> of;
  for (const Term& operand : n.operands) of.push_back(intern(operand));
  switch (n.kind) {
    case TermKind::number: return number(n.number);
    case TermKind::variable: {
      const auto [known, is_new] =
          known_.emplace(std::tuple(Kind::variable, 0.0, n.variable, std::vector<NodeId>()), nodes_.size());
      if (is_new) nodes_.push_back({Kind::variable, 0, n.variable});
      return {known->second};
    }
    case TermKind::add: return add(of[0], of[1]);
    case TermKind::multiply: return multiply(of[0], of[1]);
    case TermKind::divide: return divide(of[0], of[1]);
    case TermKind::negate: return {of[0].node, !of[0].is_negative};
    case TermKind::square_root: return node(Kind::square_root, {positive(of[0])});
    case TermKind::sine: return circular(of[0]).sine;
    case TermKind::cosine: return circular(of[0]).cosine;
    case TermKind::where: return where(of[0], of[1], of[2]);
    case TermKind::pick: return pick(n.table, positive(of[0]));
  }
  return {};
}

TermWriter::Signed TermWriter::number(double value) {
  const double magnitude = std::abs(value);
  const auto [known, is_new] =
      known_.emplace(std::tuple(Kind::number, magnitude, VariableId{}, std::vector<NodeId>()), nodes_.size());
  if (is_new) nodes_.push_back({Kind::number, magnitude});
  return {known->second, value < 0};
}

TermWriter::Signed TermWriter::node(Kind kind, std::vector<NodeId> operands) {
  const auto [known, is_new] = known_.emplace(std::tuple(kind, 0.0, VariableId{}, operands), nodes_.size());
  if (is_new) nodes_.push_back({kind, 0, {}, std::move(operands)});
  return {known->second};
}

bool TermWriter::is_number(Signed value, double magnitude) const {
  const Node& n = nodes_[value.node];
  return n.kind == Kind::number && n.number == magnitude;
}

TermWriter::Signed TermWriter::add(Signed a, Signed b) {
  if (is_number(a, 0)) return b;
  if (is_number(b, 0)) return a;
  if (a.node == b.node && a.is_negative != b.is_negative) return number(0);
  if (nodes_[a.node].kind == Kind::number && nodes_[b.node].kind == Kind::number) {
    const auto value = [&](Signed s) { return s.is_negative ? -nodes_[s.node].number : nodes_[s.node].number; };
    return number(value(a) + value(b));
  }
  if (!a.is_negative && b.is_negative) return node(Kind::subtract, {a.node, b.node});
  if (a.is_negative && !b.is_negative) return node(Kind::subtract, {b.node, a.node});
  Signed sum = node(Kind::add, {std::min(a.node, b.node), std::max(a.node, b.node)});
  sum.is_negative = a.is_negative;
  return sum;
}

TermWriter::Signed TermWriter::multiply(Signed a, Signed b) {
  const bool is_negative = a.is_negative != b.is_negative;
  if (is_number(a, 0) || is_number(b, 0)) return number(0);
  if (is_number(a, 1)) return {b.node, is_negative};
  if (is_number(b, 1)) return {a.node, is_negative};
  Signed product;
  if (nodes_[a.node].kind == Kind::number && nodes_[b.node].kind == Kind::number)
    product = number(nodes_[a.node].number * nodes_[b.node].number);
  else product = node(Kind::multiply, {std::min(a.node, b.node), std::max(a.node, b.node)});
  product.is_negative = is_negative;
  return product;
}

TermWriter::Signed TermWriter::divide(Signed a, Signed b) {
  const bool is_negative = a.is_negative != b.is_negative;
  if (is_number(a, 0)) return number(0);
  if (is_number(b, 1)) return {a.node, is_negative};
  Signed quotient = node(Kind::divide, {a.node, b.node});
  quotient.is_negative = is_negative;
  return quotient;
}

TermWriter::Signed TermWriter::where(Signed condition, Signed yes, Signed no) {
  if (yes.node == no.node && yes.is_negative == no.is_negative) return yes;
  if (nodes_[condition.node].kind == Kind::number)
    return nodes_[condition.node].number > 0 && !condition.is_negative ? yes : no;
  if (yes.is_negative && no.is_negative) {
    Signed chosen = node(Kind::where, {positive(condition), yes.node, no.node});
    chosen.is_negative = true;
    return chosen;
  }
  const NodeId asked = positive(condition), first = positive(yes), second = positive(no);
  return node(Kind::where, {asked, first, second});
}

TermWriter::Signed TermWriter::pick(const std::shared_ptr<const TermTable>& table, NodeId place) {
  const auto found =
      std::find_if(tables_.begin(), tables_.end(), [&](const auto& one) { return one->name == table->name; });
  const auto which = double(found - tables_.begin());
  if (found == tables_.end()) tables_.push_back(table);
  const auto [known, is_new] =
      known_.emplace(std::tuple(Kind::pick, which, VariableId{}, std::vector<NodeId>{place}), nodes_.size());
  if (is_new) nodes_.push_back({Kind::pick, which, {}, {place}});
  return {known->second};
}

TermWriter::NodeId TermWriter::positive(Signed value) {
  return value.is_negative ? node(Kind::subtract, {number(0).node, value.node}).node : value.node;
}

TermWriter::Signed TermWriter::named(const Real& value, const std::string& name, const char* unit,
                                     const char* meaning) {
  const double rounded_value = rounded(value, writer_.law().scalar);
  call(rounded_value, name, unit, meaning);
  return number(rounded_value);
}

TermWriter::Circular TermWriter::circular(Signed angle) {
  auto known = circular_.find(angle.node);
  if (known == circular_.end()) {
    const std::string which = std::to_string(circular_.size() + 1);
    const std::optional<int> eighths = eighths_nearby(angle.node);
    const Circular both =
        eighths ? about_eighth_turns({angle.node}, *eighths, which) : about_half_turns({angle.node}, which);
    label(both.sine, "sine_" + which, "1", "sin θ");
    label(both.cosine, "cosine_" + which, "1", "cos θ");
    known = circular_.emplace(angle.node, both).first;
  }
  Circular result = known->second;
  if (angle.is_negative) result.sine.is_negative = !result.sine.is_negative;
  return result;
}

TermWriter::Circular TermWriter::about_half_turns(Signed angle, const std::string& which) {
  const ScalarType scalar = writer_.law().scalar;
  const auto [high, low] = parts_of_pi(scalar);
  const Signed big = named(rounder(scalar), "rounder", "1", "added and taken away, it rounds to a whole number");
  const auto nearest = [&](Signed value) { return add(add(value, big), {big.node, true}); };
  const Signed per_turn = named(1 / boost::math::constants::pi<Real>(), "half_turns_per_radian", "1/rad", "1/π");
  const Signed turns = nearest(multiply(angle, per_turn));
  label(turns, "half_turns_" + which, "1", "k, nearest to θ/π");
  Signed rest = add(angle, {multiply(turns, named(high, "half_turn", "rad", "π, rounded")).node, true});
  rest = add(rest, {multiply(turns, named(low, "half_turn_rest", "rad", "what rounding took from π")).node, true});
  label(rest, "rest_" + which, "rad", "r = θ − k π");
  const Signed z = multiply(rest, rest);
  label(z, "rest_squared_" + which, "rad²", "r²");
  const Signed half = multiply(turns, named(0.5, "half", "1", "1/2"));
  const Signed odd = add(half, {nearest(half).node, true});  // 0, ½ or −½
  label(odd, "oddness_" + which, "1", "k/2 less the nearest whole number");
  const Signed sign =
      add(named(1, "one", "1", "1"), {multiply(named(8, "eight", "1", "8"), multiply(odd, odd)).node, true});
  label(sign, "side_" + which, "1", "(−1)^k");
  return {multiply(multiply(sign, rest), polynomial(sine_polynomial(scalar), "sine_term", z)),
          multiply(sign, polynomial(cosine_polynomial(scalar), "cosine_term", z))};
}

TermWriter::Circular TermWriter::about_eighth_turns(Signed angle, int eighths, const std::string& which) {
  const ScalarType scalar = writer_.law().scalar;
  Signed rest = angle;
  if (eighths != 0) {
    const auto [high, low] = parts_of_pi(scalar);
    const Real count = Real(eighths) / 4;
    const std::string name = fmt::format("eighth_turns_{}", std::abs(eighths));
    for (const Signed part :
         {named(count * high, name, "rad", "a multiple of π/4, rounded"),
          named(count * low, name + "_rest", "rad", "what rounding took from that multiple of π/4")})
      rest = add(rest, {part.node, !part.is_negative});
    label(rest, "rest_" + which, "rad", "r = θ − a multiple of π/4");
  }
  const Signed z = multiply(rest, rest);
  label(z, "rest_squared_" + which, "rad²", "r²");
  Signed sine = multiply(rest, polynomial(sine_polynomial(scalar), "sine_term", z)),
         cosine = polynomial(cosine_polynomial(scalar), "cosine_term", z);
  // sin (r + π/4) = √½ (sin r + cos r), cos (r + π/4) = √½ (cos r − sin r)
  if (eighths % 2 != 0) {
    const Signed root = named(sqrt(Real(0.5)), "root_of_half", "1", "√½");
    std::tie(sine, cosine) =
        std::pair(multiply(root, add(sine, cosine)), multiply(root, add(cosine, {sine.node, !sine.is_negative})));
  }
  // sin (r + π/2) = cos r, cos (r + π/2) = −sin r
  for (int turn = ((eighths >> 1) % 4 + 4) % 4; turn > 0; --turn)
    std::tie(sine, cosine) = std::pair(cosine, Signed{sine.node, !sine.is_negative});
  return {sine, cosine};
}

// k, if the angle stays within a quarter turn of k π/4; an even one if possible, which takes fewer operations.
std::optional<int> TermWriter::eighths_nearby(NodeId angle) const {
  const std::optional<std::pair<double, double>> range = range_of(angle);
  if (!range) return std::nullopt;
  const double eighth = std::numbers::pi / 4, middle = (range->first + range->second) / (2 * eighth);
  if (!(std::abs(middle) < most_eighths)) return std::nullopt;
  const int even = 2 * static_cast<int>(std::lround(middle / 2)), odd = even + (middle < even ? -1 : 1);
  for (const int eighths : {even, odd})
    if (std::max(range->second - eighths * eighth, eighths * eighth - range->first) <= 2 * eighth) return eighths;
  return std::nullopt;
}

std::optional<std::pair<double, double>> TermWriter::range_of(NodeId angle) const {
  const Node& node = nodes_[angle];
  if (node.kind == Kind::number) return std::pair(node.number, node.number);
  if (node.kind == Kind::variable) {
    const auto found = ranges_.find(node.variable);
    return found == ranges_.end() ? std::nullopt : std::optional(found->second);
  }
  if (node.kind != Kind::add && node.kind != Kind::subtract) return std::nullopt;
  const auto a = range_of(node.operands[0]), b = range_of(node.operands[1]);
  if (!a || !b) return std::nullopt;
  return node.kind == Kind::add ? std::pair(a->first + b->first, a->second + b->second)
                                : std::pair(a->first - b->second, a->second - b->first);
}

// Horner's scheme.
TermWriter::Signed TermWriter::polynomial(const std::vector<Real>& coefficients, const char* name, Signed z) {
  Signed sum{};
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    const double value = rounded(coefficients[i], writer_.law().scalar);
    call(value, fmt::format("{}_{}", name, i), i == 0 ? "1" : fmt::format("1/rad^{}", 2 * i),
         "coefficient of the polynomial in r²");
    sum = i + 1 == coefficients.size() ? number(value) : add(number(value), multiply(sum, z));
  }
  return sum;
}

// A local where it is used more than once, else in place.
ExpressionId TermWriter::expression(std::vector<Statement>& program, NodeId id) {
  if (nodes_[id].local != no_variable) return writer_.read(nodes_[id].local);
  const bool is_leaf = nodes_[id].kind == Kind::number || nodes_[id].kind == Kind::variable;
  if (is_leaf || (nodes_[id].uses < 2 && nodes_[id].name.empty())) return written(program, id);
  const ExpressionId value = written(program, id);
  const Node& n = nodes_[id];
  const VariableId local = writer_.scalar(name_of(id), n.unit.empty() ? "" : n.unit, n.meaning, Role::local);
  writer_.assign(program, local, value, n.meaning);
  nodes_[id].local = local;
  return writer_.read(local);
}

std::string TermWriter::name_of(NodeId id) {
  return writer_.unique(nodes_[id].name.empty() ? fmt::format("part_{}", ++parts_) : nodes_[id].name);
}

ExpressionId TermWriter::written(std::vector<Statement>& program, NodeId id) {
  const Kind kind = nodes_[id].kind;
  const std::vector<NodeId> operands = nodes_[id].operands;
  if (kind == Kind::variable) return writer_.read(nodes_[id].variable);
  if (kind == Kind::number) {
    auto found = labels_.find(nodes_[id].number);
    if (found == labels_.end())
      found =
          labels_.emplace(nodes_[id].number, Label{fmt::format("number_{}", ++numbers_), "", "number of the geometry"})
              .first;
    Label& label = found->second;
    if (!label.is_made) label.name = writer_.unique(label.name);
    label.is_made = true;
    return writer_.constant(label.name, label.unit, label.meaning, nodes_[id].number, ConstantRole::map);
  }
  std::vector<ExpressionId> of;
  for (const NodeId operand : operands) of.push_back(expression(program, operand));
  switch (kind) {
    case Kind::add: return writer_.add(of[0], of[1]);
    case Kind::subtract: return writer_.subtract(of[0], of[1]);
    case Kind::multiply: return writer_.multiply(of[0], of[1]);
    case Kind::divide: return writer_.divide(of[0], of[1]);
    case Kind::square_root: return writer_.square_root(of[0]);
    case Kind::where: return writer_.where(of[0], of[1], of[2]);
    case Kind::pick: {
      const TermTable& table = *tables_[std::size_t(nodes_[id].number)];
      const std::vector<Real> values(table.values.begin(), table.values.end());
      return writer_.pick(table.name, table.unit, table.meaning, values, of[0], ConstantRole::map);
    }
    case Kind::number:
    case Kind::variable: break;
  }
  return nothing;
}

}  // namespace dashpot::compiler
