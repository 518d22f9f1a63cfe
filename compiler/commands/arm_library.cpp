#include "commands/arm_library.hpp"

#include "emit/template_text.hpp"

namespace dashpot::compiler {

std::optional<LoadedArmModel> load_arm_model(const AxesCompilation& compilation, const EmissionOptions& options,
                                             Diagnostics& diagnostics) {
  auto files = emit_axes_cpp(compilation, options, diagnostics);
  const SourceFile* shape = find_template("arm_library.cpp.in", options.templates, diagnostics);
  if (!files || !shape) return std::nullopt;
  const std::string& name = compilation.network.name;
  CodeModel model;
  model.fields["name"] = name;
  std::optional<std::string> entry = fill(*shape, model, diagnostics);
  if (!entry) return std::nullopt;
  files->push_back({name + "_library.cpp", std::move(*entry)});
  const auto* table = table_of_library<arm_model_table>(*files, files->back().name, "dashpot_arm_model",
                                                        arm_model_table_version, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedArmModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
