#include "c_form.hpp"

#include <fmt/format.h>

#include "scalar_program.hpp"

namespace dashpot::testing {
namespace {

using compiler::Role;
using compiler::UpdateLaw;
using compiler::Variable;

class CForm {
 public:
  CForm(const compiler::Compilation& compilation, const ProvenBox& box)
      : law_(compilation.law), name_(compilation.network.name), scalar_(name_of(law_.scalar)), box_(box) {
    for (const Variable& v : law_.variables)
      for (std::size_t place = 0; v.role == Role::state && place < v.size; ++place)
        members_[scalar_name(v, place)] = member(v, place);
  }

  std::string text() {
    text_ = fmt::format(
        "#ifdef __FRAMAC__\n#include <__fc_builtin.h>\n#endif\n#include <stdio.h>\n\n#include \"{}.h\"\n\n", name_);
    text_ += fmt::format("static {} self;\n\n", name_);
    proof();
    run();
    return text_;
  }

 private:
  std::string member(const Variable& v, std::size_t place) const {
    if (v.is_rolled()) return fmt::format("self.{}[{}]", v.name, place);
    return "self." + (v.element_names.empty() ? v.name : v.element_names[place]);
  }

  void proof() {
    text_ += "#ifdef __FRAMAC__\n";
    for (const auto& [state, bound] : box_.states)
      text_ +=
          fmt::format("static const double {0}low = {1:#}, {0}high = {2:#};\n", state, low(state, bound), bound.high);
    text_ += fmt::format("int main(void) {{\n  {}_reset(&self, 0);\n", name_);
    for (const auto& [state, slices] : box_.slices)
      text_ += fmt::format("  //@ loop unroll {1};\n  for (int {0}at = 0; {0}at < {1}; ++{0}at) {{\n", state, slices);
    for (const auto& [state, bound] : box_.states) begin(state, bound);
    for (const compiler::GuardInTurn& guard : law_.guards)
      text_ += fmt::format("  self.{0} = Frama_C_interval(0, {2}) * {1};\n", guard.name, guard.places,
                           (law_.variables[guard.state].size - 1) / guard.places);
    text_ += fmt::format(
        "  const {0} position = Frama_C_{0}_interval({1:#}, {2:#}), velocity = Frama_C_{0}_interval({3:#}, {4:#});\n",
        scalar_, -box_.range.position, box_.range.position, -box_.range.velocity, box_.range.velocity);
    text_ += fmt::format(
        "  const dashpot_command command = {}_step(&self, position, velocity);\n"
        "  //@ assert finite: \\is_finite(command.force) && \\is_finite(command.damping);\n"
        "  //@ assert brakes: command.damping >= 0;\n",
        name_);
    for (const auto& [state, bound] : box_.states)
      text_ += fmt::format("  //@ assert stays: {0}low <= {1} <= {0}high;\n", state, members_.at(state));
    for (std::size_t i = 0; i < box_.slices.size(); ++i) text_ += "  }\n";
    text_ += "  return 0;\n}\n";
  }

  void begin(const std::string& state, const compiler::StateBounds& bound) {
    const std::string& there = members_.at(state);
    const auto sliced = box_.slices.find(state);
    if (sliced == box_.slices.end())
      text_ += fmt::format("  {0} = Frama_C_{1}_interval({2}low, {2}high);\n", there, scalar_, state);
    else
      text_ += fmt::format("  {0} = Frama_C_{3}_interval({1:#} + {4}at * {2:#}, {1:#} + ({4}at + 1) * {2:#});\n", there,
                           bound.low, (bound.high - bound.low) / sliced->second, scalar_, state);
  }

  // A damping is not negative.
  double low(const std::string& state, const compiler::StateBounds& bound) const {
    const bool is_brake = law_.brake_changes() && state == scalar_name(law_.variables[law_.last_brake], 0);
    return is_brake ? 0 : bound.low;
  }

  void run() {
    text_ += fmt::format(
        "#else\nint main(void) {{\n  double position, velocity;\n  {0}_reset(&self, 0);\n"
        "  while (scanf(\"%la %la\", &position, &velocity) == 2) {{\n"
        "    const dashpot_command command = {0}_step(&self, ({1})position, ({1})velocity);\n"
        "    printf(\"%a %a\\n\", command.damping, command.force);\n  }}\n  return 0;\n}}\n#endif\n",
        name_, scalar_);
  }

  const UpdateLaw& law_;
  const std::string& name_;
  std::string scalar_;
  const ProvenBox& box_;
  std::map<std::string, std::string> members_;
  std::string text_;
};

}  // namespace

std::string c_form(const compiler::Compilation& compilation, const ProvenBox& box) {
  return CForm(compilation, box).text();
}

}  // namespace dashpot::testing
