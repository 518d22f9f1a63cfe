#include "commands/model_library.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "emit/write_files.hpp"

extern char** environ;

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "dashpot-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Beside an installed compiler, else where this one was built from.
std::string runtime_headers() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = self.parent_path().parent_path() / DASHPOT_INSTALL_INCLUDEDIR;
  return fs::exists(installed / "dashpot" / "command.hpp", error) ? installed.string() : DASHPOT_RUNTIME_HEADERS;
}

// Standard error goes to `log`. Returns the exit status, or 127 where the program cannot be started.
int run_program(std::vector<std::string> words, const std::string& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int refused = ::posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (refused != 0) return 127;
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

std::string contents_of(const fs::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

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

std::optional<LoadedModel> load_model(const Compilation& compilation, EmissionOptions options, Diagnostics& diagnostics) {
  options.with_library = true;
  const auto files = emit_cpp(compilation, options, diagnostics);
  const TemporaryFolder folder;
  if (!files || !write_files(folder.path().string(), *files, diagnostics)) return std::nullopt;
  const char* chosen = std::getenv("CXX");
  const std::string compiler = chosen != nullptr && *chosen != '\0' ? chosen : "c++";
  const fs::path library = folder.path() / "model.so", log = folder.path() / "compiler.log";
  const int status = run_program({compiler, "-std=c++17", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I" + runtime_headers(),
                                  (folder.path() / (compilation.network.name + "_library.cpp")).string(), "-o", library.string()},
                                 log.string());
  if (status != 0) {
    diagnostics.report<DiagnosticCode::system_compiler_failed>({}, compiler, status == 127 ? "cannot be started" : contents_of(log));
    return std::nullopt;
  }
  const model_table* table = open_library(library, diagnostics);
  return table == nullptr ? std::nullopt : std::optional<LoadedModel>(std::in_place, *table);
}

}  // namespace dashpot::compiler
