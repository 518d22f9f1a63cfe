#include <fmt/format.h>

#include "certify/state_box.hpp"
#include "emit/banner.hpp"
#include "emit/c99_parts.hpp"
#include "emit/c99_program.hpp"
#include "emit/emission.hpp"
#include "emit/cpp_program.hpp"
#include "discretise/rounding.hpp"
#include "emit/response_test.hpp"
#include "emit/step_shape.hpp"
#include "emit/template_text.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using Lines = std::vector<std::string>;

// A function of the number of a parameter.
Lines by_number(const std::string& type, const std::string& name, const char* what, const Lines& values,
                const char* beyond) {
  Lines lines = {fmt::format("static inline {} {}_parameter_{}(int i) {{", type, name, what)};
  if (values.empty()) lines.push_back("  (void)i;");
  for (std::size_t i = 0; i < values.size(); ++i)
    lines.push_back(fmt::format("  if (i == {}) return {};", i, values[i]));
  lines.push_back(fmt::format("  return {};", beyond));
  lines.push_back("}");
  return lines;
}

Lines parameter_lines(const UpdateLaw& law, const std::string& name) {
  const std::string scalar(name_of(law.scalar));
  Lines names, units, values, least, most;
  for (const Tunable& t : law.parameters()) {
    names.push_back(fmt::format("\"{}\"", t.name));
    units.push_back(fmt::format("\"{}\"", t.unit));
    values.push_back(cpp_literal(t.range.value, law.scalar));
    least.push_back(cpp_literal(t.range.min, law.scalar));
    most.push_back(cpp_literal(t.range.max, law.scalar));
  }
  Lines lines = {fmt::format("static inline int {}_parameter_count(void) {{ return {}; }}", name, names.size())};
  for (const Lines& more :
       {by_number("const char *", name, "name", names, "\"\""), by_number("const char *", name, "unit", units, "\"\""),
        by_number(scalar, name, "value", values, "0"), by_number(scalar, name, "min", least, "0"),
        by_number(scalar, name, "max", most, "0")})
    lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

// The one word that C keeps and C++ does not.
std::string member_name(const Tunable& tunable) { return tunable.name == "restrict" ? "restrict_" : tunable.name; }

Lines parameter_struct(const UpdateLaw& law, const std::string& name) {
  if (!law.tunable) return {};
  Lines lines = {"// What may change while the law runs, to begin with as in the network's file.",
                 fmt::format("typedef struct {}_parameters {{", name)};
  for (const Tunable& t : law.tunable->tunables)
    lines.push_back(fmt::format("  {} {};  // {} to {} [{}]", name_of(law.scalar), member_name(t), t.range.min,
                                t.range.max, t.unit));
  lines.push_back(fmt::format("}} {}_parameters;", name));
  lines.push_back("");
  return lines;
}

// set() of the struct, beside that of numbers in turn.
Lines set_of_struct(const UpdateLaw& law, const std::string& name) {
  if (!law.tunable) return {};
  std::string first, wanted;
  for (const Tunable& t : law.tunable->tunables) {
    first += (first.empty() ? "" : ", ") + cpp_literal(t.range.value, law.scalar);
    wanted += (wanted.empty() ? "" : ", ") + ("wanted->" + member_name(t));
  }
  return {fmt::format("static inline {0}_parameters {0}_parameters_at_first(void) {{", name),
          fmt::format("  const {}_parameters first = {{{}}};", name, first),
          "  return first;",
          "}",
          "",
          fmt::format("static inline unsigned {0}_set({0} *self, const {0}_parameters *wanted) {{", name),
          fmt::format("  const {} values[{}] = {{{}}};", name_of(law.scalar), law.tunable->tunables.size(), wanted),
          fmt::format("  return {}_set_values(self, values);", name),
          "}",
          ""};
}

Lines value_lines(const UpdateLaw& law) {
  if (!law.tunable) return {"(void)self;", "(void)i;", "return 0;"};
  Lines lines;
  for (const Tunable& parameter : law.parameters())
    lines.push_back(fmt::format("if (i == {}) return self->{};", lines.size(), law.variables[parameter.value].name));
  lines.push_back("return 0;");
  return lines;
}

Lines set_lines(const UpdateLaw& law, const std::string& name, const Lines& set) {
  if (!law.tunable) return {"(void)self;", "(void)wanted;", "return 0u;"};
  Lines lines = {fmt::format("{}_update(self);", name), "unsigned clamped = 0u;"};
  const std::vector<Tunable> parameters = law.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    lines.push_back(fmt::format("clamped |= {0}_take_value(&{0}_ranges[{1}], wanted[{1}], &self->{2}) << {1};", name, i,
                                law.variables[parameters[i].value].name));
  lines.insert(lines.end(), set.begin(), set.end());
  lines.push_back("return clamped;");
  return lines;
}

// The box of states as a function of the law, where magnitudes show one.
Lines box_lines(const Compilation& c, const InputRange& range, const Lines& bounds) {
  if (bounds.empty()) return {};
  const PortUnits units = port_units(c.network.port_motion);
  Lines lines = {fmt::format("// While positions stay within ± {:.6g} {} and velocities within ± {:.6g} {}, a law that "
                             "starts at rest at 0",
                             range.position, units.position, range.velocity, units.velocity),
                 "// keeps to this box, and from it no operation overflows: 1 where its states are there.",
                 fmt::format("static inline int {0}_is_within(const {0} *self) {{", c.network.name), "  return"};
  for (const std::string& bound : bounds) lines.push_back("      " + bound);
  lines.back() += ";";
  lines.push_back("}");
  lines.push_back("");
  return lines;
}

CodeModel c_header_model(const Compilation& c) {
  const std::string& name = c.network.name;
  const InputRange range = input_range(c.port);
  const std::optional<StateBox> box = state_box(c.law, range);
  const C99Program program = c99_program(c.law, name, box.value_or(StateBox{}));
  CodeModel model;
  describe_file(c, model.fields);
  describe_device(c, model.fields);
  model.fields.erase("any_device");
  model.fields.erase("motion");
  model.fields["is_certified"] = c.certificate.certified ? "1" : "0";
  model.fields["is_rotation"] = c.network.port_motion == motion::rotation ? "1" : "0";
  model.lists["command"] = as_list(c99_command_header());
  add_program(program, model);
  model.lists["parameters"] = as_list(parameter_lines(c.law, name));
  model.lists["parameter_struct"] = as_list(parameter_struct(c.law, name));
  model.lists["value"] = as_list(value_lines(c.law));
  model.lists["box"] = as_list(box_lines(c, range, program.bounds));
  model.lists["set"] = as_list(set_lines(c.law, name, program.set));
  model.lists["set_of_struct"] = as_list(set_of_struct(c.law, name));
  model.lists["share"] = as_list(program.kept_share.empty() ? Lines{"(void)self;", "return 1;"}
                                                            : Lines{fmt::format("return {};", program.kept_share)});
  model.lists["banner"] = as_list(banner(c, c.law, Timing::any));
  return model;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_c99(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics) {
  if (!can_be_c99(compilation.network.name, compilation.network.name_span, diagnostics)) return std::nullopt;
  const std::string& name = compilation.network.name;
  std::vector<OutputFile> files;
  if (!append_filled("network.h.in", name + ".h", c_header_model(compilation), options, files, diagnostics))
    return std::nullopt;
  if (!options.with_test) return files;
  CodeModel model = response_test_model(compilation, "log1p");
  model.fields["scalar"] = name_of(compilation.law.scalar);
  model.fields["roundoff"] = fmt::format("{:#}", unit_roundoff(compilation.law.scalar));
  if (!append_filled("network_test.c.in", name + "_test.c", model, options, files, diagnostics)) return std::nullopt;
  return files;
}

}  // namespace dashpot::compiler
