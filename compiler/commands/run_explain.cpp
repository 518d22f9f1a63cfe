#include "commands/commands.hpp"
#include "commands/explain.hpp"

namespace dashpot::compiler {

ExitStatus run_explain(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* file = files.open(options.networks.front(), diagnostics);
  if (file == nullptr) return ExitStatus::input_refused;
  std::optional<Compilation> compilation = compile(*file, options.choices, device.device, diagnostics);
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  weigh_all_candidates(*compilation, options.choices);
  return write_standard_output(options.json ? explain_json(*compilation) : explain_text(*compilation), diagnostics);
}

}  // namespace dashpot::compiler
