#include "certify/slip_answer.hpp"

#include <Eigen/LU>

#include <algorithm>

#include "linear/real_traits.hpp"

namespace dashpot::compiler {
namespace {

using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

// Blocks as springs between ends: inner ones by their number, then the tool, then the ground.
class JoinedEnds {
 public:
  static constexpr int tool = -1, ground = -2;

  struct Pair {
    int from, to;
  };

  int add_end() { return count_++; }
  void tie(Pair ends, double stiffness) {
    if (stiffness != 0) ties_.push_back({ends, stiffness});
  }
  // Adds a force that pulls both ends together. The order is that of the columns of row().
  void pull(Pair ends) { pulls_.push_back(ends); }

  // x of every inner end: L x = g Δu − the pulls. Where no tie leads from an end to tool or ground its pulls are in
  // balance, and one end of those that are tied to it stays where it is.
  void solve() {
    RealMatrix laplacian = RealMatrix::Zero(count_, count_), right = RealMatrix::Zero(count_, columns());
    for (const auto& [ends, stiffness] : ties_)
      for (const Pair& way : {ends, Pair{ends.to, ends.from}}) {
        if (way.from < 0) continue;
        laplacian(way.from, way.from) += stiffness;
        if (way.to >= 0) laplacian(way.from, way.to) -= stiffness;
        if (way.to == tool) right(way.from, 0) += stiffness;
      }
    for (int i = 0; i < static_cast<int>(pulls_.size()); ++i) add_pull(right, i);
    for (int end : loose_ends()) {
      laplacian.row(end).setZero();
      right.row(end).setZero();
      laplacian(end, end) = 1;
    }
    moved_ = count_ > 0 ? RealMatrix(laplacian.partialPivLu().solve(right)) : right;
  }

  RealMatrix row(int end) const {
    RealMatrix row = RealMatrix::Zero(1, columns());
    if (end == tool) row(0, 0) = 1;
    return end >= 0 ? RealMatrix(moved_.row(end)) : row;
  }

  RealMatrix force_at(int end) const {
    RealMatrix sum = RealMatrix::Zero(1, columns());
    for (const auto& [ends, stiffness] : ties_)
      if (ends.from == end || ends.to == end)
        sum += (row(end) - row(ends.from == end ? ends.to : ends.from)) * Real(stiffness);
    for (int i = 0; i < static_cast<int>(pulls_.size()); ++i) {
      const Pair ends = pulls_[static_cast<std::size_t>(i)];
      sum(0, 1 + i) += (ends.from == end ? 1 : 0) - (ends.to == end ? 1 : 0);
    }
    return sum;
  }

 private:
  int columns() const { return 1 + static_cast<int>(pulls_.size()); }

  void add_pull(RealMatrix& right, int i) const {
    const Pair ends = pulls_[static_cast<std::size_t>(i)];
    if (ends.from >= 0) right(ends.from, 1 + i) -= 1;
    if (ends.to >= 0) right(ends.to, 1 + i) += 1;
  }

  std::vector<int> loose_ends() const {
    std::vector<int> group;
    for (int i = 0; i < count_; ++i) group.push_back(i);
    const auto group_of = [&](int end) { return end < 0 ? -1 : group[static_cast<std::size_t>(end)]; };
    for (const auto& [ends, stiffness] : ties_) {
      const int low = std::min(group_of(ends.from), group_of(ends.to)),
                high = std::max(group_of(ends.from), group_of(ends.to));
      std::replace(group.begin(), group.end(), high, low);
    }
    std::vector<int> loose;
    for (int i = 0; i < count_; ++i)
      if (group_of(i) == i) loose.push_back(i);
    return loose;
  }

  struct Tie {
    Pair ends;
    double stiffness;
  };

  int count_ = 0;
  std::vector<Tie> ties_;
  std::vector<Pair> pulls_;
  RealMatrix moved_;
};

SlipAnswerRow row_of(const RealMatrix& numbers, std::size_t held) {
  SlipAnswerRow row;
  row.by_change = to_double(numbers(0, 0));
  for (int i = 1; i < numbers.cols(); ++i)
    (static_cast<std::size_t>(i) <= held ? row.by_held : row.by_slip).push_back(to_double(numbers(0, i)));
  return row;
}

struct Layout {
  std::vector<JoinedEnds::Pair> blocks, slips;
  std::vector<double> stiffness, yields;
};

void lay_out(const Coupling& coupling, std::size_t part, JoinedEnds::Pair between, JoinedEnds& ends, Layout& tree) {
  const slip_node<double>& node = coupling.nodes[part];
  const auto place = static_cast<std::size_t>(node.place);
  if (node.kind == slip_part::block) {
    tree.blocks[place] = between;
    tree.stiffness[place] = node.stiffness;
  } else if (node.kind == slip_part::slip) {
    tree.slips[place] = between;
    tree.yields[place] = node.yield;
  }
  for (int i = 0; i < node.child_count; ++i) {
    JoinedEnds::Pair of_child = between;
    if (node.kind == slip_part::series && i + 1 < node.child_count) of_child.to = between.from = ends.add_end();
    lay_out(coupling, static_cast<std::size_t>(node.first_child + i), of_child, ends, tree);
  }
}

}  // namespace

SlipAnswer slip_answer(const Coupling& coupling, bool is_free) {
  JoinedEnds ends;
  const std::size_t held = coupling.held.size(), slips = coupling.slips.size();
  Layout tree{std::vector<JoinedEnds::Pair>(held), std::vector<JoinedEnds::Pair>(slips), std::vector<double>(held),
              std::vector<double>(slips)};
  const int surface = is_free ? ends.add_end() : JoinedEnds::tool;
  lay_out(coupling, 0, {surface, JoinedEnds::ground}, ends, tree);
  for (std::size_t i = 0; i < held; ++i) ends.tie(tree.blocks[i], tree.stiffness[i]);
  for (const JoinedEnds::Pair& block : tree.blocks) ends.pull(block);
  for (const JoinedEnds::Pair& slip : tree.slips) ends.pull(slip);
  ends.solve();
  SlipAnswer answer{{}, row_of(ends.force_at(JoinedEnds::tool), held), row_of(ends.row(surface), held), tree.yields};
  for (const JoinedEnds::Pair& block : tree.blocks)
    answer.moved.push_back(row_of(ends.row(block.from) - ends.row(block.to), held));
  return answer;
}

// In a network that the tool pushes, it pushes the last inner end.
SlipAnswer slip_answer(const SlipNetwork& network, bool is_free) {
  JoinedEnds ends;
  const int count = network.node_count, inner = network.is_pushed() && !is_free ? count - 1 : count;
  for (int i = 0; i < inner; ++i) ends.add_end();
  const auto end_of = [&](int i) { return i < inner ? i : i <= count ? JoinedEnds::tool : JoinedEnds::ground; };
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) ends.tie({end_of(i), end_of(j)}, network.between[at(i * count + j)]);
    ends.tie({end_of(i), end_of(count)}, network.to_tool[at(i)]);
    ends.tie({end_of(i), JoinedEnds::ground}, network.to_ground[at(i)]);
  }
  ends.tie({JoinedEnds::tool, JoinedEnds::ground}, network.through);
  for (int i = 0; i < static_cast<int>(network.held.size()); ++i) ends.pull({end_of(i), JoinedEnds::ground});
  std::vector<double> yields;
  for (const slip_link<double>& link : network.links)
    if (link.lowest != 0) {
      ends.pull({end_of(link.a), end_of(link.b)});
      yields.push_back(link.highest);
    }
  ends.solve();
  const std::size_t held = network.held.size();
  SlipAnswer answer{
      {}, row_of(ends.force_at(JoinedEnds::tool), held), row_of(ends.row(end_of(count - 1)), held), std::move(yields)};
  for (int i = 0; i < count; ++i) answer.moved.push_back(row_of(ends.row(end_of(i)), held));
  return answer;
}

}  // namespace dashpot::compiler
