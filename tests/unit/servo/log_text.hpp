// A FILE* whose content a test reads back.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace dashpot::tests {

class log_text {
 public:
  log_text() : file_(open_memstream(&bytes_, &size_)) {}
  ~log_text() {
    std::fclose(file_);
    std::free(bytes_);
  }
  log_text(const log_text&) = delete;
  log_text& operator=(const log_text&) = delete;

  std::FILE* file() noexcept { return file_; }
  std::string text() const {
    std::fflush(file_);
    return {bytes_, size_};
  }

 private:
  char* bytes_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

}  // namespace dashpot::tests
