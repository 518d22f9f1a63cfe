#include "c_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scalar_program.hpp"

namespace dashpot::testing {
namespace {

using compiler::Role;
using compiler::UpdateLaw;
using compiler::Variable;

const char* const opening = R"(#ifdef __FRAMAC__
#include <__fc_builtin.h>
#endif
#include <stdio.h>

typedef {scalar} scalar;

static scalar flush_below(scalar threshold, scalar value) {{ return value > threshold || value < -threshold ? value : 0; }}
static scalar clamp_to(scalar limit, scalar value) {{
  const scalar below = value < limit ? value : limit;
  return below > -limit ? below : -limit;
}}
static int all_finite(scalar a, scalar b, scalar c) {{ return (a - a) + (b - b) + (c - c) == 0; }}

)";

class CForm {
 public:
  CForm(const UpdateLaw& law, const ProvenBox& box) : law_(law), box_(box) {}

  std::string text() {
    text_ = fmt::format(fmt::runtime(opening), fmt::arg("scalar", name_of(law_.scalar)));
    constants();
    states();
    function("static int output(scalar position, scalar velocity)", law_.output);
    text_ += fmt::format(
        "  command_damping = {};\n  command_force = 0;\n  if (!all_finite(position, velocity, {})) return 0;\n",
        law_.brake_changes() ? name(law_.last_brake) : "damping", name(law_.force));
    text_ += fmt::format("  command_damping = {};\n  command_force = {};\n",
                         law_.brake_changes() ? name(law_.brake) : "damping", name(law_.force));
    assignments(law_.keep);
    text_ += "  return 1;\n}\n\n";
    text_ += "static void update(void) {\n";
    for (const compiler::GuardInTurn& guard : law_.guards) take_turn(guard);
    assignments(law_.update);
    text_ += "}\n\n";
    proof();
    run();
    return text_;
  }

 private:
  std::string name(compiler::VariableId id) const { return scalar_name(law_.variables[id], 0); }

  std::string literal(double value) const {
    return fmt::format("{:#}{}", value, law_.scalar == compiler::ScalarType::float32 ? "f" : "");
  }

  void constants() {
    if (!law_.brake_changes()) text_ += fmt::format("static const scalar damping = {};\n", literal(law_.damping));
    text_ += fmt::format("static const scalar threshold = {};\n", literal(law_.flush_threshold));
    for (const compiler::Coefficient& c : law_.coefficients) {
      if (is_table(c)) {
        text_ += fmt::format("static const scalar {}[{}] = {{", c.name, c.values.size());
        for (const double value : c.values) text_ += literal(value) + ", ";
        text_ += "};\n";
        continue;
      }
      for (std::size_t place = 0; place < c.values.size(); ++place)
        text_ += fmt::format("static const scalar {} = {};\n", scalar_name(c, place), literal(c.values[place]));
    }
  }

  void states() {
    for (const Variable& v : law_.variables)
      for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
        text_ += fmt::format("static scalar {} = {};\n", scalar_name(v, place), literal(v.rest_value));
    for (const compiler::GuardInTurn& guard : law_.guards) text_ += fmt::format("static int {} = 0;\n", guard.name);
    text_ += "static scalar command_damping, command_force;\n\n";
  }

  void function(const std::string& declaration, const std::vector<compiler::Statement>& program) {
    text_ += declaration + " {\n";
    assignments(program);
  }

  void take_turn(const compiler::GuardInTurn& guard) {
    const Variable& forces = law_.variables[guard.state];
    for (std::size_t first = 0; first < forces.size; first += guard.places) {
      text_ += fmt::format("  if ({} == {}) {{\n", guard.name, first);
      for (std::size_t place = first; place < std::min(first + guard.places, forces.size); ++place)
        text_ += fmt::format("    {0} = flush_below(threshold, {0});\n", scalar_name(forces, place));
      text_ += "  }\n";
    }
    text_ +=
        fmt::format("  {0} = {0} + {1} < {2} ? {0} + {1} : 0;\n", guard.name, guard.places, law_.padded(forces.size));
  }

  void assignments(const std::vector<compiler::Statement>& program) {
    const ScalarSpelling spelling = {
        [](const std::string& value) { return fmt::format("flush_below(threshold, {})", value); },
        [](const std::string& value, const std::string& limit) {
          return fmt::format("clamp_to({}, {})", limit, value);
        }};
    for (const ScalarAssignment& a : scalar_program(law_, program, spelling))
      text_ += fmt::format("  {}{} = {};\n", a.is_local ? "const scalar " : "", a.target, a.value);
  }

  void proof() {
    text_ += "#ifdef __FRAMAC__\n";
    for (const auto& [state, bound] : box_.states)
      text_ += fmt::format("static const double {}bound = {:#};\n", state, bound);
    text_ += "int main(void) {\n";
    for (const auto& [state, slices] : box_.slices)
      text_ += fmt::format("  //@ loop unroll {1};\n  for (int {0}at = 0; {0}at < {1}; ++{0}at) {{\n", state, slices);
    for (const auto& [state, bound] : box_.states) {
      const auto sliced = box_.slices.find(state);
      if (sliced == box_.slices.end()) {
        text_ += fmt::format("  {0} = Frama_C_{1}_interval({2}, {0}bound);\n", state, name_of(law_.scalar), low(state));
      } else {
        text_ += fmt::format("  {0} = Frama_C_{3}_interval({1:#} + {0}at * {2:#}, {1:#} + ({0}at + 1) * {2:#});\n",
                             state, -bound, 2 * bound / sliced->second, name_of(law_.scalar));
      }
    }
    for (const compiler::GuardInTurn& guard : law_.guards)
      text_ += fmt::format("  {0} = Frama_C_interval(0, {2}) * {1};\n", guard.name, guard.places,
                           (law_.variables[guard.state].size - 1) / guard.places);
    text_ += fmt::format(
        "  const scalar position = Frama_C_{0}_interval({1:#}, {2:#}), velocity = Frama_C_{0}_interval({3:#}, "
        "{4:#});\n",
        name_of(law_.scalar), -box_.range.position, box_.range.position, -box_.range.velocity, box_.range.velocity);
    text_ +=
        "  if (output(position, velocity)) update();\n"
        "  //@ assert finite: \\is_finite(command_force) && \\is_finite(command_damping);\n"
        "  //@ assert brakes: command_damping >= 0;\n";
    for (const auto& [state, bound] : box_.states) {
      static_cast<void>(bound);
      text_ += fmt::format("  //@ assert stays: {1} <= {0} <= {0}bound;\n", state, low(state));
    }
    for (std::size_t i = 0; i < box_.slices.size(); ++i) text_ += "  }\n";
    text_ += "  return 0;\n}\n";
  }

  // A damping is not negative; all else is within ± its bound.
  std::string low(const std::string& state) const {
    return law_.brake_changes() && state == name(law_.last_brake) ? "0" : "-" + state + "bound";
  }

  void run() {
    text_ +=
        "#else\nint main(void) {\n  double position, velocity;\n  while (scanf(\"%la %la\", &position, &velocity) == "
        "2) {\n"
        "    if (output((scalar)position, (scalar)velocity)) update();\n"
        "    printf(\"%a %a\\n\", (double)command_damping, (double)command_force);\n  }\n  return 0;\n}\n#endif\n";
  }

  const UpdateLaw& law_;
  const ProvenBox& box_;
  std::string text_;
};

}  // namespace

std::string c_form(const UpdateLaw& law, const ProvenBox& box) { return CForm(law, box).text(); }

}  // namespace dashpot::testing
