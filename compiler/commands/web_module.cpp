#include "commands/web_module.hpp"

#include <cstdlib>
#include <vector>

#include "commands/system_compiler.hpp"
#include "emit/write_files.hpp"

namespace dashpot::compiler {
namespace {

// All of the standard library that the runtime's estimators ask for; there is none for a page.
constexpr const char* cstdint =
    "#pragma once\n#include <stdint.h>\nnamespace std {\nusing ::int64_t;\nusing ::uint32_t;\nusing ::uint64_t;\n}\n";

std::vector<std::string> compilers() {
  const char* chosen = std::getenv("DASHPOT_CLANG");
  if (chosen != nullptr && *chosen != '\0') return {chosen};
  return {"clang++", "clang++-19"};
}

int compile_to_wasm(const std::string& compiler, const std::filesystem::path& folder, const std::string& name) {
  return run_program(
      {compiler, "--target=wasm32", "-std=c++17", "-O2", "-ffreestanding", "-nostdlib", "-fno-exceptions", "-fno-rtti",
       "-ffp-contract=off", "-mbulk-memory", "-I" + runtime_headers(), "-I" + folder.string(), "-Wl,--no-entry",
       "-Wl,--strip-all", (folder / (name + "_live.cpp")).string(), "-o", (folder / "live.wasm").string()},
      (folder / "compiler.log").string());
}

std::optional<std::vector<OutputFile>> live_files(const Compilation& c, const EmissionOptions& options,
                                                  Diagnostics& d) {
  return emit_cpp(c, options, d);
}
std::optional<std::vector<OutputFile>> live_files(const AxesCompilation& c, const EmissionOptions& options,
                                                  Diagnostics& d) {
  return emit_axes_cpp(c, options, d);
}

// Empty, with a diagnostic, where the templates do not fit; empty, with reasons, where nothing makes WebAssembly.
template <typename AnyCompilation>
std::optional<std::string> module_or_reasons(const AnyCompilation& compilation, const EmissionOptions& wanted,
                                             std::string& reasons, Diagnostics& diagnostics) {
  EmissionOptions options;
  options.with_live = true;
  options.templates = wanted.templates;
  auto files = live_files(compilation, options, diagnostics);
  if (files) files->push_back({"cstdint", cstdint});
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    reasons = "no folder can be made in '" + folder.above() + "': " + folder.refusal();
    return std::nullopt;
  }
  if (!files || !write_files(folder.path().string(), *files, diagnostics)) return std::nullopt;
  for (const std::string& compiler : compilers()) {
    const int status = compile_to_wasm(compiler, folder.path(), compilation.network.name);
    if (status == 0) return contents_of(folder.path() / "live.wasm");
    reasons +=
        (reasons.empty() ? "'" : "; '") + compiler + "' " +
        (status == program_not_found ? "cannot be started" : "says: " + contents_of(folder.path() / "compiler.log"));
  }
  return std::nullopt;
}

void note_remedy(const std::string& reasons, Diagnostics& diagnostics) {
  if (reasons.starts_with('\'')) diagnostics.note<DiagnosticCode::clang_remedy>({});
  else diagnostics.note<DiagnosticCode::temporary_folder_remedy>({});
}

template <typename AnyCompilation>
std::optional<std::string> module_or_warning(const AnyCompilation& compilation, Diagnostics& diagnostics) {
  std::string reasons;
  std::optional<std::string> module = module_or_reasons(compilation, {}, reasons, diagnostics);
  if (!reasons.empty() && !module) {
    diagnostics.report<DiagnosticCode::no_live_response>({}, reasons);
    note_remedy(reasons, diagnostics);
  }
  return module;
}

}  // namespace

std::optional<std::string> web_module(const Compilation& compilation, Diagnostics& diagnostics) {
  return module_or_warning(compilation, diagnostics);
}
std::optional<std::string> web_module(const AxesCompilation& compilation, Diagnostics& diagnostics) {
  return module_or_warning(compilation, diagnostics);
}

std::optional<std::string> web_module_for_target(const Compilation& compilation, const EmissionOptions& options,
                                                 Diagnostics& diagnostics) {
  std::string reasons;
  std::optional<std::string> module = module_or_reasons(compilation, options, reasons, diagnostics);
  if (!reasons.empty() && !module) {
    diagnostics.report<DiagnosticCode::no_web_module>({}, compilation.network.name, reasons);
    note_remedy(reasons, diagnostics);
  }
  return module;
}

}  // namespace dashpot::compiler
