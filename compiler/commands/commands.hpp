// One function a command: architecture, section 4. Each reports into `diagnostics`, which main() renders.
#pragma once

#include <memory>

#include "commands/options.hpp"
#include "network/axes_device.hpp"
#include "source/diagnostic.hpp"

namespace dashpot::compiler {

// Files that the diagnostics point into must outlive them; they are kept here.
class SourceFiles {
 public:
  const SourceFile* open(const std::string& path, Diagnostics& diagnostics);
  const SourceFile& keep(std::string name, std::string text);  // what is no file, and lives as long as one
  const SourceFile& keep(SourceFile file);
  void keep(std::vector<std::unique_ptr<SourceFile>> more);  // words of the command line that diagnostics point into

 private:
  std::vector<std::unique_ptr<SourceFile>> files_;
};

ExitStatus run_check(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_explain(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_compile(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_fit(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_simulate(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_report(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_verify(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_import(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_export(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
ExitStatus run_run(const Options& options, SourceFiles& files, Diagnostics& diagnostics);

// Prints the diagnostics on standard error, and clears them.
void tell(const Options& options, Diagnostics& diagnostics);

// Refuses, with a diagnostic, where standard output cannot take the text: a full disk must not pass for success.
ExitStatus write_standard_output(const std::string& text, Diagnostics& diagnostics);

// To the file that --output names, else to standard output. Refuses, with a diagnostic, what cannot be written.
ExitStatus write_output(const Options& options, const std::string& text, Diagnostics& diagnostics);

// False, with a diagnostic, if an output would overwrite one of the input files.
bool spares_inputs(const Options& options, const std::vector<std::string>& outputs, Diagnostics& diagnostics);

// False, with a diagnostic, if two outputs are one file, by whatever names.
bool are_apart(const std::vector<std::string>& outputs, Diagnostics& diagnostics);

// Refuses: what is no device of two axes.
std::optional<AxesDevice> read_axes_device(const SourceFile& file, Diagnostics& diagnostics);

// Refuses: what is no device.
std::optional<Device> read_device(const SourceFile& file, Diagnostics& diagnostics);

// The device of --device. Refuses: what its file refuses, and a --rate that contradicts it (command line wrong).
struct DeviceChoice {
  std::optional<Device> device;          // empty where none was asked for
  std::optional<std::string> text = {};  // of its file
  ExitStatus status = ExitStatus::done;
  std::optional<AxesDevice> axes_device = {};  // in its place, of two axes
};
DeviceChoice open_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics);
// For commands that also take a device of two axes.
DeviceChoice open_any_device(const Options& options, SourceFiles& files, Diagnostics& diagnostics);

}  // namespace dashpot::compiler
