#include "stage_times.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dashpot::compiler {

void StageTimes::enter(const char* stage) {
  end();
  const auto known =
      std::find_if(stages_.begin(), stages_.end(), [&](const auto& entry) { return entry.first == stage; });
  current_ = static_cast<std::size_t>(known - stages_.begin());
  if (known == stages_.end()) stages_.emplace_back(stage, 0);
  since_ = Clock::now();
}

void StageTimes::end() {
  if (current_ != none) stages_[current_].second += std::chrono::duration<double>(Clock::now() - since_).count();
  current_ = none;
}

std::string StageTimes::to_text() const {
  std::string text;
  for (const auto& [stage, seconds] : stages_) text += fmt::format("{:<16}{:10.3f} ms\n", stage, 1000 * seconds);
  return text + fmt::format("{:<16}{:10.3f} ms\n", "total", 1000 * total());
}

std::string StageTimes::to_json() const {
  std::string text = "{\"timings\": {";
  for (const auto& [stage, seconds] : stages_) text += fmt::format("\"{}\": {}, ", stage, seconds);
  return text + fmt::format("\"total\": {}}}}}\n", total());
}

double StageTimes::total() const {
  double sum = 0;
  for (const auto& [stage, seconds] : stages_) sum += seconds;
  return sum;
}

}  // namespace dashpot::compiler
