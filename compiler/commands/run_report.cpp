#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/web_module.hpp"
#include "compile.hpp"
#include "insist.hpp"
#include "report/axes_report.hpp"
#include "report/report.hpp"

namespace dashpot::compiler {
namespace {

ExitStatus report_axes(const SourceFile& network, const DeviceChoice& device, const Options& options,
                       Diagnostics& diagnostics) {
  const std::optional<AxesCompilation> compilation = compile_axes(network, options, device, diagnostics);
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  // Without a device there is no workspace to lead the tool through.
  const std::optional<std::string> module =
      compilation->has_device ? web_module(*compilation, diagnostics) : std::nullopt;
  const std::optional<std::string> page = report(*compilation, module, diagnostics);
  if (!page || diagnostics.has_errors()) return ExitStatus::input_refused;
  return write_output(options, *page, diagnostics);
}

}  // namespace

ExitStatus run_report(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const SourceFile* file = open_network(options.networks.front(), options, files, diagnostics);
  if (file == nullptr) return ExitStatus::input_refused;
  if (has_two_axes(*file)) return report_axes(*file, device, options, diagnostics);
  if (!as_many_axes(*file, device, diagnostics)) return ExitStatus::input_refused;
  Choices choices = options.choices;
  choices.compared = Compared::variations;
  std::optional<Compilation> compilation = compile(*file, choices, device.device, diagnostics);
  if (!compilation || diagnostics.has_errors()) return ExitStatus::input_refused;
  warn_of_felt_error(*compilation, choices, diagnostics);
  weigh_all_candidates(*compilation, choices);
  const std::optional<std::string> page = report(*compilation, web_module(*compilation, diagnostics), diagnostics);
  if (!page || diagnostics.has_errors()) return ExitStatus::input_refused;
  return write_output(options, *page, diagnostics);
}

}  // namespace dashpot::compiler
