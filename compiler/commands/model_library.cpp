#include "commands/model_library.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <memory>

#include "commands/system_compiler.hpp"
#include "emit/write_files.hpp"

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

const model_table* open_library(const fs::path& library, Diagnostics& diagnostics) {
  void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  using Entry = const model_table* (*)();
  const auto entry = handle == nullptr ? nullptr : reinterpret_cast<Entry>(::dlsym(handle, "dashpot_model"));
  const model_table* table = entry == nullptr ? nullptr : entry();
  if (table != nullptr && table->version == model_table_version) return table;
  const char* reason = ::dlerror();
  diagnostics.report<DiagnosticCode::cannot_load_model>({}, std::string(reason ? reason : "made for another version"));
  return nullptr;
}

}  // namespace

LoadedModel::LoadedModel(const model_table& table)
    : table_(&table), storage_(new unsigned char[table.size + table.alignment]), object_(storage_.get()) {
  std::size_t space = table.size + table.alignment;
  std::align(table.alignment, table.size, object_, space);
  table_->construct(object_);
}

std::optional<LoadedModel> load_model(const Compilation& compilation, EmissionOptions options,
                                      Diagnostics& diagnostics) {
  options.with_library = true;
  const auto files = emit_cpp(compilation, options, diagnostics);
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    diagnostics.report<DiagnosticCode::cannot_make_folder>({}, folder.above(), folder.refusal());
    diagnostics.note<DiagnosticCode::temporary_folder_remedy>({});
    return std::nullopt;
  }
  if (!files || !write_files(folder.path().string(), *files, diagnostics)) return std::nullopt;
  const char* chosen = std::getenv("CXX");
  const std::string compiler = chosen != nullptr && *chosen != '\0' ? chosen : "c++";
  const fs::path library = folder.path() / "model.so", log = folder.path() / "compiler.log";
  const int status =
      run_program({compiler, "-std=c++17", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I" + runtime_headers(),
                   (folder.path() / (compilation.network.name + "_library.cpp")).string(), "-o", library.string()},
                  log.string());
  if (status != 0) {
    diagnostics.report<DiagnosticCode::system_compiler_failed>(
        {}, compiler, status == program_not_found ? "cannot be started" : contents_of(log));
    return std::nullopt;
  }
  const model_table* table = open_library(library, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
