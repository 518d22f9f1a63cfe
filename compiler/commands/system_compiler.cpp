#include "commands/system_compiler.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "emit/write_files.hpp"

extern char** environ;

namespace dashpot::compiler {

namespace fs = std::filesystem;

namespace {

// Options beside the name in CC or CXX are taken for a part of it.
std::string reason_not_to_start(const std::string& program) {
  const bool has_options = program.find(' ') != std::string::npos;
  return has_options ? "cannot be started; one program's name is expected, without options" : "cannot be started";
}

}  // namespace

std::string environment_or(const char* variable, const char* otherwise) {
  const char* chosen = std::getenv(variable);
  return chosen != nullptr && *chosen != '\0' ? chosen : otherwise;
}

TemporaryFolder::TemporaryFolder() : above_(environment_or("TMPDIR", "/tmp")) {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) sigaddset(&ending, signal);
  ::sigprocmask(SIG_BLOCK, &ending, &blocked_before_);
  std::string pattern = (fs::path(above_) / "dashpot-XXXXXX").string();
  if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  else refusal_ = std::strerror(errno);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  ::sigprocmask(SIG_SETMASK, &blocked_before_, nullptr);
}

std::string runtime_headers() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = self.parent_path().parent_path() / DASHPOT_INSTALL_INCLUDEDIR;
  return fs::exists(installed / "dashpot" / "command.hpp", error) ? installed.string() : DASHPOT_RUNTIME_HEADERS;
}

int run_program(std::vector<std::string> words, const std::string& log) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawnattr_t attributes;
  sigset_t none;
  sigemptyset(&none);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t child = 0;
  const int refused = ::posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  if (refused != 0) return program_not_found;
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

bool has_sources(const TemporaryFolder& folder, const std::vector<OutputFile>& sources, Diagnostics& diagnostics) {
  if (!folder.path().empty()) return write_files(folder.path().string(), sources, diagnostics);
  diagnostics.report<DiagnosticCode::cannot_make_folder>({}, folder.above(), folder.refusal());
  diagnostics.note<DiagnosticCode::temporary_folder_remedy>({});
  return false;
}

bool makes_library(std::vector<std::string> words, const TemporaryFolder& folder, const std::string& source,
                   const std::string& library, Diagnostics& diagnostics) {
  const fs::path here = folder.path(), log = here / "compiler.log";
  words.insert(words.end(), {(here / source).string(), "-o", (here / library).string()});
  const int status = run_program(words, log.string());
  std::error_code error;  // of a file that is not there
  const bool has_written = fs::file_size(here / library, error) > 0 && !error;
  if (status == 0 && has_written) return true;
  diagnostics.report<DiagnosticCode::system_compiler_failed>(
      {}, words.front(),
      status == program_not_found ? reason_not_to_start(words.front())
      : status == 0               ? "it ends without an error and without a library"
                                  : contents_of(log));
  if (fs::path(source).extension() == ".c")
    diagnostics.note<DiagnosticCode::compiler_remedy>({}, "C", "gcc or clang", "CC", "cc");
  else diagnostics.note<DiagnosticCode::compiler_remedy>({}, "C++", "g++ or clang++", "CXX", "c++");
  return false;
}

std::string contents_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace dashpot::compiler
