#include "commands/model_library.hpp"

#include <dlfcn.h>

#include "commands/system_compiler.hpp"

namespace dashpot::compiler {

void* function_of_library(const std::vector<OutputFile>& files, const std::string& source, const char* name,
                          Diagnostics& diagnostics) {
  const TemporaryFolder folder;
  const std::string library = "model.so";
  if (!has_sources(folder, files, diagnostics) ||
      !makes_library({environment_or("CXX", "c++"), "-std=c++17", "-O2", "-ffp-contract=off", "-shared", "-fPIC",
                      "-I" + runtime_headers()},
                     folder, source, library, diagnostics))
    return nullptr;
  void* handle = ::dlopen((folder.path() / library).c_str(), RTLD_NOW | RTLD_LOCAL);
  void* function = handle == nullptr ? nullptr : ::dlsym(handle, name);
  if (function != nullptr) return function;
  const char* reason = ::dlerror();
  diagnostics.report<DiagnosticCode::cannot_load_model>({}, std::string(reason ? reason : "it has no model"));
  return nullptr;
}

void refuse_table_of_another_version(Diagnostics& diagnostics) {
  diagnostics.report<DiagnosticCode::cannot_load_model>({}, std::string("made for another version"));
}

std::optional<LoadedModel> load_model(const Compilation& compilation, EmissionOptions options,
                                      Diagnostics& diagnostics) {
  options.with_library = true;
  const auto files = emit_cpp(compilation, options, diagnostics);
  if (!files) return std::nullopt;
  const auto* table = table_of_library<model_table>(*files, compilation.network.name + "_library.cpp", "dashpot_model",
                                                    model_table_version, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
