#include <cmath>
#include <filesystem>
#include <set>

#include "commands/commands.hpp"
#include "syntax/parse_axes.hpp"
#include "syntax/parse_device.hpp"

namespace dashpot::compiler {

const SourceFile* SourceFiles::open(const std::string& path, Diagnostics& diagnostics) {
  std::optional<SourceFile> file = read_source(path, diagnostics);
  if (!file) return nullptr;
  files_.push_back(std::make_unique<SourceFile>(std::move(*file)));
  return files_.back().get();
}

const SourceFile& SourceFiles::keep(std::string name, std::string text) {
  return keep(SourceFile(std::move(name), std::move(text)));
}

const SourceFile& SourceFiles::keep(SourceFile file) {
  files_.push_back(std::make_unique<SourceFile>(std::move(file)));
  return *files_.back();
}

void SourceFiles::keep(std::vector<std::unique_ptr<SourceFile>> more) {
  for (std::unique_ptr<SourceFile>& file : more) files_.push_back(std::move(file));
}

std::optional<Device> read_device(const SourceFile& file, Diagnostics& diagnostics) {
  const std::optional<DeviceDecl> decl = parse_device(file, diagnostics);
  return decl ? build_device(*decl, diagnostics) : std::nullopt;
}

std::optional<AxesDevice> read_axes_device(const SourceFile& file, Diagnostics& diagnostics) {
  const std::optional<AxesDeviceDecl> decl = parse_axes_device(file, diagnostics);
  return decl ? build_axes_device(*decl, diagnostics) : std::nullopt;
}

namespace {

DeviceChoice opened(const Options& options, bool takes_axes, SourceFiles& files, Diagnostics& diagnostics) {
  if (!options.device) return {};
  const SourceFile* file = files.open(*options.device, diagnostics);
  if (file == nullptr) return {std::nullopt, std::nullopt, ExitStatus::input_refused};
  const bool has_axes = takes_axes && axes_of(*file) > 1;
  DeviceChoice choice{std::nullopt, file->text(), ExitStatus::done};
  if (has_axes) choice.axes_device = read_axes_device(*file, diagnostics);
  else choice.device = read_device(*file, diagnostics);
  if (!choice.device && !choice.axes_device) return {std::nullopt, std::nullopt, ExitStatus::input_refused};
  const double period =
      has_axes ? choice.axes_device->loop().sample_period : choice.device->description.loop.sample_period;
  if (options.choices.rate && std::abs(*options.choices.rate * period - 1) > 1e-9) {
    diagnostics.report<DiagnosticCode::device_rate_contradicts>(
        {}, *options.choices.rate, has_axes ? choice.axes_device->name : choice.device->name, 1 / period);
    return {std::nullopt, std::nullopt, ExitStatus::command_line_wrong};
  }
  return choice;
}

}  // namespace

DeviceChoice open_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  return opened(options, false, files, diagnostics);
}

DeviceChoice open_any_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  return opened(options, true, files, diagnostics);
}

namespace {

// As a folder is reached by many names, so is a file in it.
std::string place_of(const std::string& name) {
  std::error_code unreachable;
  const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(name), unreachable);
  return (unreachable ? std::filesystem::path(name).lexically_normal() : place).string();
}

}  // namespace

bool are_apart(const std::vector<std::string>& outputs, Diagnostics& diagnostics) {
  std::set<std::string> places;
  bool apart = true;
  for (const std::string& output : outputs) {
    if (places.insert(place_of(output)).second) continue;
    diagnostics.report<DiagnosticCode::same_output>({}, output);
    apart = false;
  }
  return apart;
}

bool spares_inputs(const Options& options, const std::vector<std::string>& outputs, Diagnostics& diagnostics) {
  std::vector<std::string> inputs = options.networks;
  if (options.device) inputs.push_back(*options.device);
  if (!options.input.empty()) inputs.push_back(options.input);
  for (const std::vector<std::string>* recordings : {&options.fit.recordings, &options.fit.hold_out})
    inputs.insert(inputs.end(), recordings->begin(), recordings->end());
  if (options.motion) inputs.push_back(*options.motion);
  bool spares = true;
  for (const std::string& output : outputs)
    for (const std::string& input : inputs) {
      std::error_code not_there;
      if (!std::filesystem::equivalent(output, input, not_there)) continue;
      diagnostics.report<DiagnosticCode::would_overwrite_input>({}, output);
      spares = false;
    }
  return spares;
}

}  // namespace dashpot::compiler
