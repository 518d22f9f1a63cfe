#include "source/nearest_name.hpp"

#include <algorithm>
#include <array>

namespace dashpot::compiler {
namespace {

constexpr std::size_t longest_name = 64;      // [bytes]; nobody misspells longer ones
constexpr std::size_t most_candidates = 200;  // keeps a long file full of mistakes cheap

using Row = std::array<std::size_t, longest_name + 1>;

char lower(char byte) { return byte >= 'A' && byte <= 'Z' ? static_cast<char>(byte - 'A' + 'a') : byte; }

// Costs are in half letters.
std::size_t replacement_cost(char x, char y) { return x == y ? 0 : lower(x) == lower(y) ? 1 : 2; }

// Optimal string alignment (Damerau 1964): cost[i mod 3][j] is the cost of turning x[0, i) into y[0, j).
std::size_t edit_distance(std::string_view x, std::string_view y) {
  std::array<Row, 3> cost;
  for (std::size_t j = 0; j <= y.size(); ++j) cost[0][j] = 2 * j;
  for (std::size_t i = 1; i <= x.size(); ++i) {
    Row& row = cost[i % 3];
    const Row& last = cost[(i + 2) % 3];
    row[0] = 2 * i;
    for (std::size_t j = 1; j <= y.size(); ++j) {
      row[j] = std::min({last[j] + 2, row[j - 1] + 2, last[j - 1] + replacement_cost(x[i - 1], y[j - 1])});
      const bool swapped = i > 1 && j > 1 && x[i - 1] == y[j - 2] && x[i - 2] == y[j - 1];
      if (swapped) row[j] = std::min(row[j], cost[(i + 1) % 3][j - 2] + 2);
    }
  }
  return cost[x.size() % 3][y.size()];
}

// What the difference in length costs at least.
std::size_t least_distance(std::string_view x, std::string_view y) {
  return 2 * (std::max(x.size(), y.size()) - std::min(x.size(), y.size()));
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  if (name.size() > longest_name) return std::nullopt;
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, 2 * name.size() / 3) + 1;
  for (std::size_t i = 0; i < std::min(candidates.size(), most_candidates); ++i) {
    const std::string& candidate = candidates[i];
    if (candidate.size() > longest_name || least_distance(name, candidate) >= least) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= std::min(least, 2 * std::max(name.size(), candidate.size()))) continue;
    least = distance;
    nearest = &candidate;
  }
  return nearest == nullptr ? std::nullopt : std::optional(*nearest);
}

}  // namespace dashpot::compiler
