#include "commands/verify_texts.hpp"

namespace dashpot::compiler {

ExitStatus run_verify(const Options& options, SourceFiles& files, Diagnostics& diagnostics) {
  const SourceFile* certificate = files.open(options.certificate.value(), diagnostics);
  const SourceFile* header = files.open(options.header, diagnostics);
  if (certificate == nullptr || header == nullptr) return ExitStatus::input_refused;
  const std::optional<std::string> verified =
      verify_texts(*certificate, *header, options.allow_uncertified, files, diagnostics);
  return verified ? write_standard_output(*verified, diagnostics) : ExitStatus::input_refused;
}

}  // namespace dashpot::compiler
