// Which of n things, as nodes, belong together: each set is known by one of its members.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dashpot::compiler {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  // The member by which the set of x is known.
  std::size_t find(std::size_t x) const {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  // The set of both is known by the member by which that of y was.
  void unite(std::size_t x, std::size_t y) { parent_[find(x)] = find(y); }

  // The set of both is known by the lesser of the two members by which theirs were. False where they were one already.
  bool unite_by_least(std::size_t x, std::size_t y) {
    const std::size_t a = find(x), b = find(y);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  mutable std::vector<std::size_t> parent_;  // find() shortens the way to the member that a set is known by
};

}  // namespace dashpot::compiler
