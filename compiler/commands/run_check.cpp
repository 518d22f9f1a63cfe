#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/motion_csv.hpp"
#include "compile.hpp"
#include "fit/read_recording.hpp"
#include "insist.hpp"
#include "syntax/json.hpp"

namespace dashpot::compiler {
namespace {

bool is_table(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".csv" || ending == ".tsv" || ending == ".txt" || ending == ".dat";
}

// A motion has a column 'position', and none of what answered it: told from the first lines.
bool is_recording(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string beginning(4096, ' ');
  stream.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(stream.gcount()));
  std::transform(beginning.begin(), beginning.end(), beginning.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  for (const std::string_view answer :
       {"force", "torque", "moment", "load", "stress", "modul", "storage", "compliance"})
    if (beginning.find(answer) != std::string::npos) return true;
  return beginning.find("position") == std::string::npos;
}

// What is no JSON is told of as a network.
bool is_device(const SourceFile& file) {
  Diagnostics unheard;
  const std::optional<JsonValue> root = parse_json(file, unheard);
  return root && root->kind == JsonValue::Kind::object && find_member(*root, "dashpot_device") &&
         !find_member(*root, "dashpot");
}

// As `dashpot fit` would read it without further words; its questions are answered there.
void check_recording(const std::string& path, Diagnostics& diagnostics) {
  fitting::ReadChoices choices;
  choices.columns.command = "dashpot fit " + path;
  fitting::LineReader lines(path, fitting::ReadProgress());
  if (lines.open(diagnostics)) read_recording(lines, choices, diagnostics);
}

void check(const std::string& path, const Options& options, const std::optional<Device>& device, SourceFiles& files,
           Diagnostics& diagnostics) {
  if (is_table(path) && is_recording(path)) return check_recording(path, diagnostics);
  const SourceFile* file =
      is_table(path) ? files.open(path, diagnostics) : open_network(path, options, files, diagnostics);
  if (file == nullptr) return;
  if (is_table(path)) {
    parse_motion(*file, diagnostics);
  } else if (is_device(*file)) {
    read_device(*file, diagnostics);
  } else {
    Choices choices = options.choices;
    choices.varies_assumed = false;  // nothing is told of it
    const auto compilation = compile(*file, choices, device, diagnostics);
    if (compilation) warn_of_felt_error(*compilation, choices, diagnostics);
  }
}

}  // namespace

ExitStatus run_check(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  for (const std::string& path : options.networks) check(path, options, device.device, files, diagnostics);
  return diagnostics.has_errors() ? ExitStatus::input_refused : ExitStatus::done;
}

}  // namespace dashpot::compiler
