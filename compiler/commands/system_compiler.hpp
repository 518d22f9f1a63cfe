// The system's compiler, for those commands that run what they emit.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "emit/emission.hpp"

namespace dashpot::compiler {

// A folder of its own below $TMPDIR, or /tmp, removed with all that is in it. A signal that ends the process, Ctrl-C
// for one, waits until then.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }  // empty where none could be made
  const std::string& above() const { return above_; }          // in which it is, or should have been
  const std::string& refusal() const { return refusal_; }      // the system's reason why there is none

 private:
  std::string above_;
  std::filesystem::path path_;
  std::string refusal_;
  sigset_t blocked_before_;
};

// Where <dashpot/command.hpp> is: beside an installed compiler, else where this one was built from.
std::string runtime_headers();

inline constexpr int program_not_found = 127;

// Standard error goes to `log`. No signal waits there. Returns the exit status, or program_not_found where it cannot be
// started.
int run_program(std::vector<std::string> words, const std::string& log);

// What the environment says, CC or CXX for one; `otherwise` where it says nothing.
std::string environment_or(const char* variable, const char* otherwise);

// True where the sources are in the folder. Refuses, with a diagnostic: a folder that could not be made, or takes no
// files.
bool has_sources(const TemporaryFolder& folder, const std::vector<OutputFile>& sources, Diagnostics& diagnostics);

// Whether the words, a compiler and its options, make the folder's `library` of its `source`; says why not.
bool makes_library(std::vector<std::string> words, const TemporaryFolder& folder, const std::string& source,
                   const std::string& library, Diagnostics& diagnostics);

std::string contents_of(const std::filesystem::path& path);

}  // namespace dashpot::compiler
