// Branch and bound over a box: parts are halved, the one with the largest bound first.
#pragma once

#include <queue>

#include "axes/workspace.hpp"

namespace dashpot::compiler::axes {

// In: a function that bounds the wanted value over a part, and whether a bound is close enough to what has been
// attained. Out: a bound over the whole box, close enough or after `most_parts`.
template <typename Measure, typename IsClose>
double best_first(const Box& whole, int most_parts, const Measure& measured, const IsClose& is_close) {
  struct Part {
    Box box;
    double bound;
    bool operator<(const Part& other) const { return bound < other.bound; }
  };
  std::priority_queue<Part> open;
  open.push({whole, measured(whole)});
  for (int parts = 1; parts < most_parts && !is_close(open.top().bound); parts += 2) {
    const Part worst = open.top();
    open.pop();
    for (const Box& half : halves(worst.box, whole)) open.push({half, measured(half)});
  }
  return open.top().bound;
}

}  // namespace dashpot::compiler::axes
