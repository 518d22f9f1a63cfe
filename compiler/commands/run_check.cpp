#include <filesystem>
#include <string>
#include <vector>

#include "commands/axes_commands.hpp"
#include "commands/changed_network.hpp"
#include "commands/commands.hpp"
#include "commands/motion_csv.hpp"
#include "compile.hpp"
#include "fit/read_recording.hpp"
#include "insist.hpp"
#include "syntax/json.hpp"
#include "syntax/parse_axes.hpp"

namespace dashpot::compiler {
namespace {

bool is_table(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".csv" || ending == ".tsv" || ending == ".txt" || ending == ".dat";
}

// What is no JSON is told of as a network.
bool is_device(const SourceFile& file) {
  const std::optional<JsonValue> root = json_in(file);
  return root && root->kind == JsonValue::Kind::object && find_member(*root, "dashpot_device") &&
         !find_member(*root, "dashpot");
}

// What the command line says of recordings; nothing, reported, where it is malformed.
std::optional<fitting::ReadChoices> read_choices(const FitWords& words, Diagnostics& diagnostics) {
  fitting::ReadChoices choices;
  choices.has_header = !words.no_header;
  choices.awaits_geometry = true;
  if (words.columns) {
    const auto requests = fitting::parse_columns(*words.columns, diagnostics);
    if (!requests) return std::nullopt;
    choices.columns.requests = *requests;
  }
  if (words.geometry && !(choices.geometry = fitting::parse_geometry(*words.geometry, diagnostics)))
    return std::nullopt;
  return choices;
}

// As `dashpot fit` would read it.
void check_recording(const std::string& path, fitting::ReadChoices choices, const FitWords& words,
                     Diagnostics& diagnostics) {
  choices.columns.command = "dashpot check " + fitting::shell_word(path) + (words.no_header ? " --no-header" : "") +
                            (words.geometry ? " --geometry " + fitting::shell_word(*words.geometry) : "");
  fitting::LineReader lines(path, fitting::ReadProgress());
  if (lines.open(diagnostics)) read_recording(lines, choices, diagnostics);
}

// Its first lines; nothing, reported, where it cannot be read.
std::optional<SourceFile> head_of(const std::string& path, Diagnostics& diagnostics) {
  fitting::LineReader lines(path, fitting::ReadProgress());
  if (!lines.open(diagnostics)) return std::nullopt;
  std::string head;
  while (lines.number() < fitting::head_lines)
    if (const auto line = lines.next(diagnostics)) head.append(*line) += '\n';
    else break;
  return lines.has_failed() ? std::nullopt : std::optional(SourceFile(path, head));
}

// What --columns or --no-header is given for is a recording; else the header tells.
void check_table(const std::string& path, const FitWords& words, const fitting::ReadChoices& reading,
                 SourceFiles& files, Diagnostics& diagnostics) {
  std::optional<MotionOf> motion;
  if (!words.columns && !words.no_header) {
    const std::optional<SourceFile> head = head_of(path, diagnostics);
    if (!head) return;
    motion = motion_in(*head);
  }
  if (!motion) return check_recording(path, reading, words, diagnostics);
  if (const SourceFile* file = files.open(path, diagnostics))
    *motion == MotionOf::joints ? void(parse_joint_motion(*file, diagnostics)) : void(parse_motion(*file, diagnostics));
}

void check(const std::string& path, const Options& options, const fitting::ReadChoices& reading,
           const DeviceChoice& device, SourceFiles& files, Diagnostics& diagnostics) {
  if (is_table(path)) return check_table(path, options.fit, reading, files, diagnostics);
  const SourceFile* file = open_network(path, options, files, diagnostics);
  if (file == nullptr) return;
  if (is_device(*file)) {
    axes_of(*file) > 1 ? void(read_axes_device(*file, diagnostics)) : void(read_device(*file, diagnostics));
  } else if (has_two_axes(*file)) {
    if (const auto axes = compile_axes(*file, options, device, diagnostics))
      insist_on_certificate(*axes, options, diagnostics);
  } else if (as_many_axes(*file, device, diagnostics)) {
    const auto compilation = compile(*file, options.choices, device.device, diagnostics);
    if (!compilation) return;
    warn_of_felt_error(*compilation, options.choices, diagnostics);
    insist_on_certificate(*compilation, options.choices, diagnostics);  // as `compile` does
  }
}

}  // namespace

ExitStatus run_check(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const DeviceChoice device = open_any_device(options, files, diagnostics);
  if (device.status != ExitStatus::done) return device.status;
  const auto reading = read_choices(options.fit, diagnostics);
  if (!reading) return ExitStatus::command_line_wrong;
  for (const std::string& path : options.networks) check(path, options, *reading, device, files, diagnostics);
  return diagnostics.has_errors() ? ExitStatus::input_refused : ExitStatus::done;
}

}  // namespace dashpot::compiler
