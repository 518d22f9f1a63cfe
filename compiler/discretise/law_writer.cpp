#include "discretise/law_writer.hpp"

#include <algorithm>
#include <cmath>

#include "discretise/rounding.hpp"
#include "network/name_rules.hpp"

namespace dashpot::compiler {
namespace {

std::string without_end(std::string name) {
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

Names suffixed(const Names& names, const std::string& suffix) {
  Names result;
  for (const std::string& name : names) result.push_back(joined(name, suffix));
  return result;
}

}  // namespace

std::string joined(const std::string& first, const std::string& second) {
  return first.empty() ? second : without_end(first) + "_" + second;
}

double rounded(const Real& value, ScalarType scalar) {
  const double nearest = scalar == ScalarType::float64 ? to_double(value) : double(value.convert_to<float>());
  return std::abs(nearest) < smallest_constant(scalar) ? 0 : nearest;
}

LawWriter::LawWriter(UpdateLaw& law, motion port_motion)
    : law_(law),
      length_(port_motion == motion::rotation ? "rad" : "m"),
      force_(port_motion == motion::rotation ? "N·m" : "N") {}

std::string LawWriter::unique(const std::string& name) {
  std::string candidate = without_end(name);                 // joined() adds one underscore itself
  if (candidate != name) candidate = legal_name(candidate);  // "NULL_" and "long_" would leave reserved words
  for (int i = 2; !taken_.insert(folded(candidate)).second; ++i) candidate = joined(name, std::to_string(i));
  return candidate;
}

VariableId LawWriter::scalar(const std::string& name, const std::string& unit, const std::string& meaning, Role role) {
  return law_.variables.add({name, unit, meaning, role, 1, {}});
}

VariableId LawWriter::vector(const VectorName& name, const std::string& unit, const std::string& meaning, Role role,
                             const Names& names) {
  return law_.variables.add(
      {joined(name.whose, name.what), unit, meaning, role, names.size(), suffixed(names, name.what)});
}

ExpressionId LawWriter::constant(const std::string& name, const std::string& unit, const std::string& meaning,
                                 const Real& value, Derivation from) {
  const auto known = std::find_if(law_.coefficients.begin(), law_.coefficients.end(),
                                  [&](const Coefficient& coefficient) { return coefficient.name == name; });
  const CoefficientId id = known != law_.coefficients.end()
                               ? law_.coefficients.id_of(*known)
                               : add_constants({name, unit, meaning, {}, {}}, {value}, std::move(from));
  return law_.expressions.add({Operation::constant, {}, {}, id});
}

ExpressionId LawWriter::constants(const VectorName& name, const std::string& unit, const std::string& meaning,
                                  const std::vector<Real>& values, const Names& names, Derivation from) {
  const CoefficientId id = add_constants({joined(name.whose, name.what), unit, meaning, {}, suffixed(names, name.what)},
                                         values, std::move(from));
  return law_.expressions.add({Operation::constant, {}, {}, id});
}

ExpressionId LawWriter::pick(const std::string& name, const std::string& unit, const std::string& meaning,
                             const std::vector<Real>& values, ExpressionId place, Derivation from) {
  const auto known = std::find_if(law_.coefficients.begin(), law_.coefficients.end(),
                                  [&](const Coefficient& coefficient) { return coefficient.name == name; });
  const CoefficientId table = known != law_.coefficients.end()
                                  ? law_.coefficients.id_of(*known)
                                  : add_constants({name, unit, meaning, {}, {}}, values, std::move(from));
  return law_.expressions.add({Operation::pick, {place}, {}, table});
}

CoefficientId LawWriter::add_constants(Coefficient coefficient, const std::vector<Real>& values, Derivation from) {
  coefficient.role = from.role;
  coefficient.bank = from.bank;
  coefficient.of = std::move(from.of);
  for (const Real& value : values) coefficient.values.push_back(rounded(value, law_.scalar));
  return law_.coefficients.add(std::move(coefficient));
}

VariableId LawWriter::reads(ExpressionId expression) const {
  const Expression& e = law_.expressions[expression];
  return e.operation == Operation::read ? e.variable : nothing;
}

VariableId LawWriter::kept(VariableId local) {
  for (const Statement& known : law_.keep)
    if (reads(known.value) == local &&
        law_.variables[known.target].name == joined("sampled", law_.variables[local].name))
      return known.target;
  Variable state = law_.variables[local];
  state.name = joined("sampled", state.name);
  for (std::string& name : state.element_names) name = joined("sampled", name);
  state.meaning += (state.meaning.empty() ? "" : ", ") + std::string("at this sample");
  state.role = Role::state;
  const VariableId id = law_.variables.add(std::move(state));
  assign(law_.keep, id, read(local), "");
  return id;
}

ExpressionId LawWriter::plus(ExpressionId sum, ExpressionId value) {
  if (sum == nothing) return value;
  return value == nothing ? sum : add(sum, value);
}

void LawWriter::assign(std::vector<Statement>& program, VariableId target, ExpressionId value, std::string purpose,
                       std::vector<std::vector<std::size_t>> origins) {
  program.push_back({target, value, std::move(purpose), std::move(origins)});
}

}  // namespace dashpot::compiler
