#include "emit/unfinished_files.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <utility>

namespace dashpot::compiler {
namespace {

constexpr int ending_signals[] = {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM};

std::atomic<const UnfinishedFiles*> unfinished{nullptr};  // whole before it is published

extern "C" void remove_and_end(int signal) {
  if (const UnfinishedFiles* const all = unfinished.load()) all->remove();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // ends the process when this function returns
}

bool would_end_the_process(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

}  // namespace

UnfinishedFiles::UnfinishedFiles(std::vector<std::string> files, std::vector<std::string> folders)
    : files_(std::move(files)), folders_(std::move(folders)) {
  unfinished = this;
  for (const int signal : ending_signals) {
    if (!would_end_the_process(signal)) continue;
    watched_.push_back(signal);
    std::signal(signal, remove_and_end);
  }
}

UnfinishedFiles::~UnfinishedFiles() {
  remove();
  for (const int signal : watched_) std::signal(signal, SIG_DFL);
  unfinished = nullptr;
}

void UnfinishedFiles::remove() const noexcept {
  for (const std::string& file : files_) ::unlink(file.c_str());
  for (const std::string& folder : folders_) ::rmdir(folder.c_str());  // which leaves one that holds anything
}

}  // namespace dashpot::compiler
