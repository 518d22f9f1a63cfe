// Files under names of their own, which are renamed when all of them are whole, and the folders made for them.
#pragma once

#include <string>
#include <vector>

namespace dashpot::compiler {

// While it lives, a signal that would end the process removes the files first, and then those of the folders, innermost
// first, that hold nothing. Its own end removes what has not been renamed. One at a time.
class UnfinishedFiles {
 public:
  UnfinishedFiles(std::vector<std::string> files, std::vector<std::string> folders);
  ~UnfinishedFiles();
  UnfinishedFiles(const UnfinishedFiles&) = delete;
  UnfinishedFiles& operator=(const UnfinishedFiles&) = delete;

  // Calls nothing that a signal's handler may not.
  void remove() const noexcept;

 private:
  const std::vector<std::string> files_, folders_;
  std::vector<int> watched_;  // signals that would have ended the process
};

}  // namespace dashpot::compiler
