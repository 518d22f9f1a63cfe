#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "commands/commands.hpp"
#include "emit/write_files.hpp"
#include "source/render.hpp"

namespace dashpot::compiler {

ExitStatus write_standard_output(const std::string& text, Diagnostics& diagnostics) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written) return ExitStatus::done;
  diagnostics.report<DiagnosticCode::cannot_write_file>({}, "standard output", std::string(std::strerror(errno)));
  return ExitStatus::input_refused;
}

ExitStatus write_output(const Options& options, const std::string& text, Diagnostics& diagnostics) {
  if (!options.output) return write_standard_output(text, diagnostics);
  return write_files("", {{*options.output, text}}, diagnostics) ? ExitStatus::done : ExitStatus::input_refused;
}

void tell(const Options& options, Diagnostics& diagnostics) {
  std::cerr << (options.json_diagnostics ? render_json(diagnostics) : render_text(diagnostics));
  diagnostics.forget();
}

}  // namespace dashpot::compiler
