#include "commands/arm_library.hpp"

#include <dlfcn.h>

#include "commands/system_compiler.hpp"
#include "emit/template_text.hpp"

namespace dashpot::compiler {
namespace {

const arm_model_table* open_arm_library(const std::filesystem::path& library, Diagnostics& diagnostics) {
  void* handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  using Entry = const arm_model_table* (*)();
  const auto entry = handle == nullptr ? nullptr : reinterpret_cast<Entry>(::dlsym(handle, "dashpot_arm_model"));
  const arm_model_table* table = entry == nullptr ? nullptr : entry();
  if (table != nullptr && table->version == arm_model_table_version) return table;
  const char* reason = ::dlerror();
  diagnostics.report<DiagnosticCode::cannot_load_model>({}, std::string(reason ? reason : "made for another version"));
  return nullptr;
}

}  // namespace

LoadedArmModel::LoadedArmModel(const arm_model_table& table)
    : table_(&table), storage_(new unsigned char[table.size + table.alignment]), object_(storage_.get()) {
  std::size_t space = table.size + table.alignment;
  std::align(table.alignment, table.size, object_, space);
  table_->construct(object_);
}

std::optional<LoadedArmModel> load_arm_model(const AxesCompilation& compilation, const EmissionOptions& options,
                                             Diagnostics& diagnostics) {
  auto files = emit_axes_cpp(compilation, options, diagnostics);
  const SourceFile* shape = find_template("arm_library.cpp.in", options.templates, diagnostics);
  if (!files || !shape) return std::nullopt;
  const std::string& name = compilation.network.name;
  CodeModel model;
  model.fields["name"] = name;
  std::optional<std::string> entry = fill(*shape, model, diagnostics);
  if (!entry) return std::nullopt;
  files->push_back({name + "_library.cpp", std::move(*entry)});
  const TemporaryFolder folder;
  const std::string library = "model.so";
  if (!has_sources(folder, *files, diagnostics) ||
      !makes_library({environment_or("CXX", "c++"), "-std=c++17", "-O2", "-ffp-contract=off", "-shared", "-fPIC",
                      "-I" + runtime_headers()},
                     folder, name + "_library.cpp", library, diagnostics))
    return std::nullopt;
  const arm_model_table* table = open_arm_library(folder.path() / library, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedArmModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
