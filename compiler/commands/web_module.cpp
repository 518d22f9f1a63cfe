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

}  // namespace

std::optional<std::string> web_module(const Compilation& compilation, Diagnostics& diagnostics) {
  EmissionOptions options;
  options.with_live = true;
  auto files = emit_cpp(compilation, options, diagnostics);
  if (files) files->push_back({"cstdint", cstdint});
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    diagnostics.report<DiagnosticCode::no_live_response>(
        {}, "no folder can be made in '" + folder.above() + "': " + folder.refusal());
    diagnostics.note<DiagnosticCode::temporary_folder_remedy>({});
    return std::nullopt;
  }
  if (!files || !write_files(folder.path().string(), *files, diagnostics)) return std::nullopt;
  std::string reasons;
  for (const std::string& compiler : compilers()) {
    const int status = compile_to_wasm(compiler, folder.path(), compilation.network.name);
    if (status == 0) return contents_of(folder.path() / "live.wasm");
    reasons +=
        (reasons.empty() ? "'" : "; '") + compiler + "' " +
        (status == program_not_found ? "cannot be started" : "says: " + contents_of(folder.path() / "compiler.log"));
  }
  diagnostics.report<DiagnosticCode::no_live_response>({}, reasons);
  diagnostics.note<DiagnosticCode::clang_remedy>({});
  return std::nullopt;
}

}  // namespace dashpot::compiler
