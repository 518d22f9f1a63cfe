// Headers as the compiler under test writes them, and other compilers run over them.
#pragma once

#include <string>
#include <vector>

#include "support/shell_command.hpp"

namespace dashpot::testing {

// Paths of every linear network file of the repository, of the corner cases of tests/responses, and of parallel
// branches up to a thousand that are written into `folder`.
std::vector<std::string> network_files(const std::filesystem::path& folder);

// A network file of `count` Maxwell branches in parallel with a spring, all of different relaxation rates.
std::string parallel_branches(const std::string& name, int count);

struct EmittedFolder {
  std::filesystem::path path;
  std::vector<std::string> classes;  // one <class>.hpp each
};

// Runs `dashpot compile` over the files. A failed assertion where it refuses.
EmittedFolder emit_headers(const std::filesystem::path& folder, const std::vector<std::string>& files,
                           const std::string& choices);

// Includes every header and calls everything that each class offers, on an object of static storage.
std::string caller_of(const EmittedFolder& emitted);

// "-I…" of what an emitted header includes.
std::string runtime_include();

}  // namespace dashpot::testing
