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
#include "emit/tunable_fields.hpp"
#include "network/port_units.hpp"

namespace dashpot::compiler {
namespace {

using Lines = std::vector<std::string>;

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
  add_tunables(c.law, model);
  model.fields["parameter_count"] = std::to_string(model.lists["tunables"].size());
  model.lists["box"] = as_list(box_lines(c, range, program.bounds));
  model.lists["set"] = as_list(program.set);
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
