#include "emit/cpp_program.hpp"

#include <fmt/format.h>

#include "emit/cpp_lines.hpp"
#include "emit/cpp_slips.hpp"
#include "emit/cpp_statements.hpp"
#include "emit/cpp_tunable.hpp"

namespace dashpot::compiler {
namespace {

class CppPrinter {
 public:
  CppPrinter(const UpdateLaw& law, const Network& network) : law_(law), statements_(law, network) {}

  CppProgram print() {
    CppProgram program;
    program.headers = {"dashpot/command.hpp"};
    if (!law_.networks.empty()) program.headers.push_back("dashpot/slip_network.hpp");
    if (!law_.couplings.empty()) program.headers.push_back("dashpot/slip_tree.hpp");
    program.output = statements_.lines_of(law_.output);
    program.command = law_.brake_changes() ? fmt::format("{{{}, {}}}", CppStatements::scalar_name(law_.variables[law_.brake]),
                                                         CppStatements::scalar_name(law_.variables[law_.force]))
                                           : "{damping, force}";
    program.safe_command = law_.brake_changes() ? fmt::format("{{{}, 0}}", CppStatements::scalar_name(law_.variables[law_.last_brake])) : "{damping, 0}";
    program.keep = statements_.lines_of(law_.keep);
    program.update = statements_.lines_of(law_.update);
    program.energy = statements_.lines_of(law_.energy);
    program.parameters = {"struct parameters {};"};
    program.set = {"// No parameter of this network can be set while it runs.", "unsigned set(const parameters&) noexcept { return 0; }"};
    program.reset = reset();
    program.constants = constants();
    program.states = states();
    program.functions = functions();
    return program;
  }

 private:
  std::vector<std::string> constants() const {
    std::vector<std::string> lines;
    if (!law_.brake_changes())
      lines.push_back(fmt::format("static constexpr scalar damping = {};  // b, the brake's part", literal(law_.damping)));
    if (statements_.uses_flush())
      lines.push_back(fmt::format("static constexpr scalar threshold = {};  // below, a force is zero: no subnormal state",
                                  literal(law_.flush_threshold)));
    for (const Coefficient& coefficient : law_.coefficients)
      if (statements_.uses(coefficient)) append_constant(coefficient, lines);
    for (const Coupling& coupling : law_.couplings) append_table(law_, coupling, lines);
    for (const SlipNetwork& network : law_.networks) append_tables(law_, network, lines);
    return lines;
  }

  void append_constant(const Coefficient& coefficient, std::vector<std::string>& lines) const {
    const std::string note = fmt::format("  // {} [{}]", coefficient.meaning, coefficient.unit);
    if (coefficient.element_names.empty()) {
      lines.push_back(fmt::format("static constexpr scalar {} = {};{}", coefficient.name, literal(coefficient.values[0]), note));
    } else if (!statements_.is_rolled(coefficient)) {
      for (std::size_t place = 0; place < coefficient.values.size(); ++place)
        lines.push_back(fmt::format("static constexpr scalar {} = {};{}", coefficient.element_names[place],
                                    literal(coefficient.values[place]), note));
    } else {
      std::string table = fmt::format("static constexpr scalar {}[{}] = {{", coefficient.name, statements_.padded(coefficient.values.size()));
      for (std::size_t place = 0; place < coefficient.values.size(); ++place)
        table += (place == 0 ? "" : ", ") + literal(coefficient.values[place]);
      lines.push_back("//" + note.substr(4));
      append(lines, table + "};");
    }
  }

  std::vector<std::string> reset() {
    std::vector<std::string> lines;
    const bool rests = law_.rest_position != no_variable;
    if (!rests) lines.push_back("static_cast<void>(position);");
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state) continue;
      if (rests && &variable == &law_.variables[law_.rest_position])
        lines.push_back(fmt::format("{} = dashpot::all_finite(position, position, position) ? {} : 0;", CppStatements::scalar_name(variable), rest_position()));
      else if (variable.size == 1)
        lines.push_back(fmt::format("{} = {};", CppStatements::scalar_name(variable), rest_value(variable)));
      else if (statements_.is_rolled())
        lines.push_back(clearing(variable));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("{}_ = {};", name, rest_value(variable)));
    }
    return lines;
  }

  std::string rest_position() const {
    return law_.surface_at ? fmt::format("dashpot::pushed_in({}, position)", literal(*law_.surface_at)) : "position";
  }

  std::string clearing(const Variable& variable) {
    uses_clear_ = true;
    return fmt::format("clear({}_);", variable.name);
  }

  std::vector<std::string> states() const {
    std::vector<std::string> lines;
    for (const Variable& variable : law_.variables) {
      if (variable.role != Role::state) continue;
      const std::string note = fmt::format("  // {} [{}]", variable.meaning, variable.unit);
      if (variable.size == 1)
        lines.push_back(fmt::format("scalar {} = {};{}", CppStatements::scalar_name(variable), rest_value(variable), note));
      else if (statements_.is_rolled())
        lines.push_back(fmt::format("scalar {}_[{}] = {{}};{}", variable.name, statements_.padded(variable.size), note));
      else
        for (const std::string& name : variable.element_names)
          lines.push_back(fmt::format("scalar {}_ = {};{}", name, rest_value(variable), note));
    }
    return lines;
  }

  std::vector<std::string> functions() const {
    std::vector<std::string> lines;
    if (statements_.uses_total())
      lines = {fmt::format("static scalar total(const scalar (&lane)[{}]) noexcept {{", law_.lanes),
               "  scalar sum = lane[0];",
               fmt::format("  for (int j = 1; j < {}; ++j) sum += lane[j];", law_.lanes),
               "  return sum;",
               "}",
               ""};
    if (uses_clear_)
      for (const char* line : {"// Through volatile: compilers turn a plain loop into a call of memset, which may not be there.",
                               "template <int size>", "static void clear(volatile scalar (&states)[size]) noexcept {",
                               "  for (int i = 0; i < size; ++i) states[i] = 0;", "}", ""})
        lines.push_back(line);
    return lines;
  }

  std::string rest_value(const Variable& state) const { return state.rest_value == 0 ? "0" : literal(state.rest_value); }

  std::string literal(double value) const { return cpp_literal(value, law_.scalar); }

  const UpdateLaw& law_;
  CppStatements statements_;
  bool uses_clear_ = false;
};

}  // namespace

std::string cpp_literal(double value, ScalarType scalar) {
  return scalar == ScalarType::float64 ? fmt::format("{:#}", value) : fmt::format("{:#}f", static_cast<float>(value));
}

CppProgram cpp_program(const UpdateLaw& law, const Network& network) {
  return law.tunable ? tunable_program(law) : CppPrinter(law, network).print();
}

}  // namespace dashpot::compiler
