// What each stage of the compiler took.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace dashpot::compiler {

class StageTimes {
 public:
  // Ends the stage before. A stage that is entered again, for another network, adds to what it took.
  void enter(const char* stage);
  void end();

  std::string to_text() const;  // a line a stage [ms] and their sum
  std::string to_json() const;  // {"timings": {stage: [s], …, "total": [s]}}

 private:
  using Clock = std::chrono::steady_clock;
  double total() const;  // [s]

  std::vector<std::pair<std::string, double>> stages_;  // in the order in which they were first entered [s]
  std::size_t current_ = none;
  Clock::time_point since_;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
};

}  // namespace dashpot::compiler
