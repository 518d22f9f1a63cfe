#include "commands/commands.hpp"
#include "compile.hpp"
#include "insist.hpp"

namespace dashpot::compiler {

ExitStatus run_check(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  for (const std::string& path : options.networks)
    if (const SourceFile* file = files.open(path, diagnostics))
      if (const auto compilation = compile(*file, options.choices, device.device, diagnostics))
        warn_of_felt_error(*compilation, options.choices, diagnostics);
  return diagnostics.has_errors() ? ExitStatus::input_refused : ExitStatus::done;
}

}  // namespace dashpot::compiler
