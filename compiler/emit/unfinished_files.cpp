#include "emit/unfinished_files.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <utility>

namespace dashpot::compiler {
namespace {

constexpr int ending_signals[] = {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM, SIGXFSZ};

std::atomic<const std::vector<std::string>*> unfinished{nullptr};

// Calls nothing that a signal's handler may not: the list is complete before it is published.
void remove_unfinished() {
  if (const std::vector<std::string>* paths = unfinished.load())
    for (const std::string& path : *paths) ::unlink(path.c_str());
}

extern "C" void remove_and_end(int signal) {
  remove_unfinished();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // ends the process when this function returns
}

bool would_end_the_process(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_DFL;
}

}  // namespace

UnfinishedFiles::UnfinishedFiles(std::vector<std::string> paths) : paths_(std::move(paths)) {
  unfinished = &paths_;
  for (const int signal : ending_signals) {
    if (!would_end_the_process(signal)) continue;
    watched_.push_back(signal);
    std::signal(signal, remove_and_end);
  }
}

UnfinishedFiles::~UnfinishedFiles() {
  remove_unfinished();
  for (const int signal : watched_) std::signal(signal, SIG_DFL);
  unfinished = nullptr;
}

}  // namespace dashpot::compiler
