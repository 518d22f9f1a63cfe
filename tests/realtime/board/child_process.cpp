#include "child_process.hpp"

#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dashpot::board {
namespace {

[[noreturn]] void become(const std::vector<char*>& arguments, int output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

}  // namespace

child_process::child_process(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int pipe_ends[2];
  if (::pipe2(pipe_ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  id_ = ::fork();
  if (id_ == 0) become(arguments, pipe_ends[1]);
  ::close(pipe_ends[1]);
  output_ = pipe_ends[0];
  if (id_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
}

child_process::~child_process() {
  ::close(output_);
  if (has_ended()) return;
  ::kill(id_, SIGKILL);
  ::waitpid(id_, nullptr, 0);
}

std::string child_process::read_line() {
  std::string line;
  for (char letter = 0; ::read(output_, &letter, 1) == 1 && letter != '\n';) line += letter;
  return line;
}

bool child_process::has_ended() {
  if (!ended_) ended_ = ::waitpid(id_, nullptr, WNOHANG) == id_;
  return ended_;
}

}  // namespace dashpot::board
