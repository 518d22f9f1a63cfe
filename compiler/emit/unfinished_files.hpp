// Files under names of their own, which are renamed when all of them are whole.
#pragma once

#include <string>
#include <vector>

namespace dashpot::compiler {

// While it lives, a signal that would end the process removes the files first. Its own end removes those that have not
// been renamed. One at a time.
class UnfinishedFiles {
 public:
  explicit UnfinishedFiles(std::vector<std::string> paths);
  ~UnfinishedFiles();
  UnfinishedFiles(const UnfinishedFiles&) = delete;
  UnfinishedFiles& operator=(const UnfinishedFiles&) = delete;

 private:
  std::vector<std::string> paths_;
  std::vector<int> watched_;  // signals that would have ended the process
};

}  // namespace dashpot::compiler
