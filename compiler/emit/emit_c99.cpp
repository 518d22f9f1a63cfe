#include "emit/banner.hpp"
#include "emit/c99_program.hpp"
#include "emit/emission.hpp"
#include "emit/step_shape.hpp"
#include "emit/template_text.hpp"

namespace dashpot::compiler {
namespace {

CodeModel c_header_model(const Compilation& c) {
  const C99Program program = c99_program(c.law);
  CodeModel model;
  describe_file(c, model.fields);
  describe_device(c, model.fields);
  model.fields.erase("any_device");
  model.fields.erase("motion");
  model.fields["is_rotation"] = c.network.port_motion == motion::rotation ? "1" : "0";
  model.fields["energy_contract"] = "In the springs after the last update() [J].";
  model.lists["banner"] = as_list(banner(c, Timing::any));
  model.lists["states"] = as_list(program.states);
  model.lists["reset"] = as_list(program.reset);
  model.lists["output"] = as_list(program.output);
  model.lists["update"] = as_list(program.update);
  model.lists["energy"] = as_list(program.energy);
  return model;
}

}  // namespace

std::optional<std::vector<OutputFile>> emit_c99(const Compilation& compilation, const EmissionOptions& options,
                                                Diagnostics& diagnostics) {
  if (!can_be_c99(compilation, diagnostics)) return std::nullopt;
  const SourceFile* shape = find_template("network.h.in", options.templates, diagnostics);
  if (!shape) return std::nullopt;
  std::optional<std::string> text = fill(*shape, c_header_model(compilation), diagnostics);
  if (!text) return std::nullopt;
  return std::vector<OutputFile>{{compilation.network.name + ".h", std::move(*text)}};
}

}  // namespace dashpot::compiler
