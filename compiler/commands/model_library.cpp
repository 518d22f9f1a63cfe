#include "commands/model_library.hpp"

#include <dlfcn.h>

#include <memory>

#include "commands/system_compiler.hpp"

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
  const bool is_there = has_sources(folder, files.value_or(std::vector<OutputFile>{}), diagnostics);
  if (!files || !is_there) return std::nullopt;
  const std::string library = "model.so";
  if (!makes_library({environment_or("CXX", "c++"), "-std=c++17", "-O2", "-ffp-contract=off", "-shared", "-fPIC",
                      "-I" + runtime_headers()},
                     folder, compilation.network.name + "_library.cpp", library, diagnostics))
    return std::nullopt;
  const model_table* table = open_library(folder.path() / library, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
