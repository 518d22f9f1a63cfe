#include "lower/apart_from.hpp"

#include "law/walk.hpp"

namespace dashpot::compiler {
namespace {

template <class Visit>
void each_name(UpdateLaw& law, Visit visit) {
  const auto visit_all = [&](auto& named) {
    visit(named.name);
    for (std::string& name : named.element_names) visit(name);
  };
  for (Variable& variable : law.variables) visit_all(variable);
  for (Coefficient& coefficient : law.coefficients) visit_all(coefficient);
  each_solved(law, [&](SolvedSlips& solved) { visit(solved.name); });
}

}  // namespace

UpdateLaw apart_from(const std::set<std::string>& words, UpdateLaw law) {
  std::set<std::string> taken = words;
  each_name(law, [&](const std::string& name) { taken.insert(name); });
  each_name(law, [&](std::string& name) {
    if (words.count(name) == 0) return;
    const std::string wanted = name;
    for (int number = 2; taken.count(name) != 0; ++number) name = wanted + "_" + std::to_string(number);
    taken.insert(name);
  });
  return law;
}

}  // namespace dashpot::compiler
