#include "commands/arm_library.hpp"

#include "emit/template_text.hpp"

namespace dashpot::compiler {

std::optional<LoadedArmModel> load_arm_model(const AxesCompilation& compilation, const EmissionOptions& options,
                                             Diagnostics& diagnostics) {
  auto files = emit_axes_cpp(compilation, options, diagnostics);
  const std::string& name = compilation.network.name;
  if (!files ||
      !append_filled("arm_library.cpp.in", name + "_library.cpp", {{{"name", name}}, {}}, options, *files, diagnostics))
    return std::nullopt;
  const auto* table = table_of_library<arm_model_table>(*files, files->back().name, "dashpot_arm_model",
                                                        arm_model_table_version, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedArmModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
