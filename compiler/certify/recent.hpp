// What a long search found for the last few questions that it was asked: a choice, what it is compared with and its
// certificate ask the same ones.
#pragma once

#include <deque>
#include <utility>

namespace dashpot::compiler {

template <class Question, class Answer>
class Recent {
 public:
  // The answer as it was found, or as `find()` finds it now; valid until the next call.
  template <class Find>
  const Answer& at(Question question, const Find& find) {
    for (const auto& [known, answer] : kept_)
      if (known == question) return answer;
    if (kept_.size() == most_kept) kept_.pop_front();
    return kept_.emplace_back(std::move(question), find()).second;
  }

 private:
  static constexpr std::size_t most_kept = 8;
  std::deque<std::pair<Question, Answer>> kept_;
};

}  // namespace dashpot::compiler
