#include "emit/cpp_tunable.hpp"

#include <fmt/format.h>

#include "emit/cpp_program.hpp"

namespace dashpot::compiler {
std::vector<std::string> parameters_of(const UpdateLaw& law) {
  if (!law.tunable) return {"struct parameters {};"};
  std::vector<std::string> lines = {"struct parameters {"};
  for (const Tunable& t : law.parameters())
    lines.push_back(fmt::format("  scalar {} = {};  // {} to {} [{}]", t.name, cpp_literal(t.range.value, law.scalar),
                                t.range.min, t.range.max, t.unit));
  lines.push_back("};");
  return lines;
}

std::vector<std::string> taken_values(const UpdateLaw& law) {
  std::vector<std::string> lines = {"unsigned clamped = 0;"};
  const std::vector<Tunable> parameters = law.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    lines.push_back(fmt::format("clamped |= dashpot::take_value(tunables[{0}], wanted.{1}, {2}) << {0};", i,
                                parameters[i].name, CppStatements::scalar_name(law.variables[parameters[i].value])));
  return lines;
}

// What waits for update() belongs to the parameters before.
std::vector<std::string> set_of(const UpdateLaw& law, const std::vector<std::string>& program) {
  if (!law.tunable)
    return {"// No parameter of this network can be set while it runs.",
            "unsigned set(const parameters&) noexcept { return 0; }"};
  std::vector<std::string> lines = {
      "// Right after step(), the command then being that of output() with the same sample and without update(): so "
      "the",
      "// force from before is held no longer, and the change injects no energy. Bit i of the result: parameter i was",
      "// beyond its range and is at its bound now, or it was NaN and is as it was.",
      "unsigned set(const parameters& wanted) noexcept {", "  update();"};
  for (const std::string& line : taken_values(law)) lines.push_back("  " + line);
  for (const std::string& line : program) lines.push_back("  " + line);
  for (const char* line : {"  return clamped;", "}"}) lines.push_back(line);
  return lines;
}

void append_ranges(const UpdateLaw& law, std::vector<std::string>& lines) {
  if (!law.tunable) return;
  const auto number = [&](double value) { return cpp_literal(value, law.scalar); };
  const std::vector<Tunable> parameters = law.parameters();
  lines.push_back(fmt::format("static constexpr dashpot::tunable_range<scalar> tunables[{}] = {{", parameters.size()));
  for (const Tunable& t : parameters)
    lines.push_back(fmt::format("    {{{}, {}, {}}},  // {} [{}]", number(t.range.value), number(t.range.min),
                                number(t.range.max), t.name, t.unit));
  lines.push_back("};");
}

}  // namespace dashpot::compiler
