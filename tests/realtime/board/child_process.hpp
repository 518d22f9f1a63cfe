// Another program beside the test: ended with it, however the test ends.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace dashpot::board {

class child_process {
 public:
  // Standard input is empty; standard output can be read by read_line(). Throws where it cannot be started.
  explicit child_process(const std::vector<std::string>& command);
  ~child_process();
  child_process(const child_process&) = delete;
  child_process& operator=(const child_process&) = delete;

  // The next line that the program prints, without its end; shorter when the program ends.
  std::string read_line();
  bool has_ended();

 private:
  pid_t id_ = -1;
  int output_ = -1;
  bool ended_ = false;
};

}  // namespace dashpot::board
