#include "emit/tunable_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/cpp_program.hpp"
#include "emit/cpp_statements.hpp"

namespace dashpot::compiler {
namespace {

// The name in C: "restrict", a keyword of C and not of C++, gets an underscore, or a number if another parameter has
// that name.
std::string member_in_c(const std::string& name, const std::vector<Tunable>& all) {
  if (name != "restrict") return name;
  std::string member = "restrict_";
  const auto has_name = [&](const Tunable& t) { return t.name == member; };
  for (int i = 2; std::any_of(all.begin(), all.end(), has_name); ++i) member = fmt::format("restrict_{}", i);
  return member;
}

}  // namespace

std::vector<Fields> tunable_fields(const UpdateLaw& law, ScalarType literals) {
  std::vector<Fields> all;
  const std::vector<Tunable> parameters = law.parameters();
  for (const Tunable& t : parameters) {
    const std::string value = cpp_literal(t.range.value, literals), min = cpp_literal(t.range.min, literals),
                      max = cpp_literal(t.range.max, literals);
    all.push_back({{"tunable", t.name},
                   {"member", member_in_c(t.name, parameters)},
                   {"unit", t.unit},
                   {"low", fmt::format("{}", t.range.min)},
                   {"high", fmt::format("{}", t.range.max)},
                   {"value", value},
                   {"min", min},
                   {"max", max},
                   {"bounds", fmt::format("{{{}, {}}}", min, max)},
                   {"range", fmt::format("{{{}, {}, {}}}", value, min, max)},
                   {"index", std::to_string(all.size())},
                   {"variable", law.variables[t.value].name},
                   {"scalar_variable", CppStatements::scalar_name(law.variables[t.value])}});
  }
  return all;
}

void add_tunables(const UpdateLaw& law, CodeModel& model) {
  std::vector<Fields>& tunables = model.lists["tunables"] = tunable_fields(law, law.scalar);
  for (const char* list : {"no_tunable", "any_tunable"}) model.lists[list];
  std::string first, wanted;
  for (const Fields& tunable : tunables) {
    first += (first.empty() ? "{" : ", ") + tunable.at("value");
    wanted += (wanted.empty() ? "{wanted->" : ", wanted->") + tunable.at("member");
  }
  if (tunables.empty()) model.lists["no_tunable"].push_back({});
  else
    model.lists["any_tunable"].push_back(
        {{"count", std::to_string(tunables.size())}, {"first", first + "}"}, {"wanted", wanted + "}"}});
}

}  // namespace dashpot::compiler
