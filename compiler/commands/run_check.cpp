#include "commands/commands.hpp"
#include "commands/motion_csv.hpp"
#include "compile.hpp"
#include "insist.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {
namespace {

bool is_motion(const SourceFile& file) { return file.path().ends_with(".csv") || file.path().ends_with(".CSV"); }

// What is no JSON is told of as a network.
bool is_device(const SourceFile& file) {
  Diagnostics unheard;
  const std::optional<JsonValue> root = parse_json(file, unheard);
  return root && root->kind == JsonValue::Kind::object && find_member(*root, "dashpot_device") &&
         !find_member(*root, "dashpot");
}

void check(const SourceFile& file, const Options& options, const std::optional<Device>& device,
           Diagnostics& diagnostics) {
  if (is_motion(file)) {
    parse_motion(file, diagnostics);
  } else if (is_device(file)) {
    read_device(file, diagnostics);
  } else if (const auto compilation = compile(file, options.choices, device, diagnostics)) {
    warn_of_felt_error(*compilation, options.choices, diagnostics);
  }
}

}  // namespace

ExitStatus run_check(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  for (const std::string& path : options.networks)
    if (const SourceFile* file = files.open(path, diagnostics)) check(*file, options, device.device, diagnostics);
  return diagnostics.has_errors() ? ExitStatus::input_refused : ExitStatus::done;
}

}  // namespace dashpot::compiler
