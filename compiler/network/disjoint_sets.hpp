// A partition of n items, such as nodes, into sets; each set is represented by one of its members.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dashpot::compiler {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  // The representative of the set of x.
  std::size_t find(std::size_t x) const {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  // Joins both sets; the representative is that of y.
  void unite(std::size_t x, std::size_t y) { parent_[find(x)] = find(y); }

  // Joins both sets; the representative is the lesser of theirs. False if they were one set already.
  bool unite_by_least(std::size_t x, std::size_t y) {
    const std::size_t a = find(x), b = find(y);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

  // How many sets hold one of `members` and none of `others`.
  template <class Members, class Others>
  std::ptrdiff_t count_apart(const Members& members, const Others& others) const {
    std::vector<bool> counted(parent_.size(), false);
    for (std::size_t other : others) counted[find(other)] = true;
    std::ptrdiff_t count = 0;
    for (std::size_t member : members) {
      const std::size_t set = find(member);
      count += counted[set] ? 0 : 1;
      counted[set] = true;
    }
    return count;
  }

 private:
  mutable std::vector<std::size_t> parent_;  // find() shortens the paths to representatives
};

}  // namespace dashpot::compiler
