#include "report/rail_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace dashpot::compiler {
namespace {

constexpr double row_height = label_rise + symbol_drop + 10;  // [px]
constexpr double least_gap = 30;                              // between rails [px]
constexpr std::size_t most_permuted_rows = 7;                 // 5,040 orders; beyond, neighbours are exchanged

// An element from the rail `left` to the rail `right`, in columns.
struct Bar {
  std::size_t element;
  std::size_t left, right;
  std::size_t row = 0;
};

using Order = std::vector<std::size_t>;  // from a row as packed to its place on the page

class Rails {
 public:
  explicit Rails(const Network& network) : network_(network) {
    place_columns();
    place_bars();
    pack_rows();
    order_rows();
    place_gaps();
  }

  Inside inside() const {
    std::string svg;
    double top = std::numeric_limits<double>::infinity(), bottom = 0, tool_top = top, tool_bottom = 0;
    for (const Bar& bar : bars_) {
      svg += drawn(bar);
      if (bar.right + 1 == x_.size()) top = std::min(top, y(bar)), bottom = std::max(bottom, y(bar));
      if (bar.left == 0) tool_top = std::min(tool_top, y(bar)), tool_bottom = std::max(tool_bottom, y(bar));
    }
    for (std::size_t column = 0; column < x_.size(); ++column) svg += rail(column);
    return {svg, x_.back(), row_height * double(rows_), (tool_top + tool_bottom) / 2, top - 20, bottom + 20};
  }

 private:
  // Layers by the number of elements from the tool; the ground last.
  void place_columns() {
    std::vector<std::size_t> order, layer(network_.nodes.size(), far_away);
    layer[tool] = 0;
    for (std::size_t round = 0; round < network_.nodes.size(); ++round)
      for (const Element& e : network_.elements)
        if (e.has_effect) relax(layer, e.a, e.b), relax(layer, e.b, e.a);
    for (NodeIndex node = 0; node < network_.nodes.size(); ++node)
      if (node != ground && layer[node] != far_away) order.push_back(node);
    std::stable_sort(order.begin(), order.end(), [&](NodeIndex a, NodeIndex b) { return layer[a] < layer[b]; });
    order.push_back(ground);
    column_.assign(network_.nodes.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i) column_[order[i]] = i;
    x_.assign(order.size(), 0);
  }

  // No way through the ground.
  static void relax(std::vector<std::size_t>& layer, NodeIndex from, NodeIndex to) {
    if (from != ground && layer[from] != far_away) layer[to] = std::min(layer[to], layer[from] + 1);
  }

  void place_bars() {
    for (std::size_t i = 0; i < network_.elements.size(); ++i) {
      const Element& e = network_.elements[i];
      const auto [left, right] = std::minmax(column_[e.a], column_[e.b]);
      if (e.has_effect && left != right) bars_.push_back({i, left, right});
    }
    std::stable_sort(bars_.begin(), bars_.end(), [](const Bar& a, const Bar& b) { return a.left < b.left; });
  }

  // Into the row that ends nearest before the bar begins, best at the very same rail.
  void pack_rows() {
    std::vector<std::size_t> ends;
    for (Bar& bar : bars_) {
      std::size_t best = ends.size();
      for (std::size_t row = 0; row < ends.size(); ++row)
        if (ends[row] <= bar.left && (best == ends.size() || ends[row] > ends[best])) best = row;
      if (best == ends.size()) ends.push_back(0);
      ends[best] = bar.right;
      bar.row = best;
    }
    rows_ = ends.size();
  }

  // How often a rail crosses a bar that does not end at it.
  std::size_t crossings(const Order& place) const {
    std::size_t count = 0;
    for (std::size_t column = 0; column < x_.size(); ++column) {
      const auto [top, bottom] = span(column, place);
      for (const Bar& bar : bars_)
        count += bar.left < column && column < bar.right && place[bar.row] > top && place[bar.row] < bottom;
    }
    return count;
  }

  std::pair<std::size_t, std::size_t> span(std::size_t column, const Order& place) const {
    std::size_t top = far_away, bottom = 0;
    for (const Bar& bar : bars_)
      if (bar.left == column || bar.right == column)
        top = std::min(top, place[bar.row]), bottom = std::max(bottom, place[bar.row]);
    return {top, bottom};
  }

  void order_rows() {
    place_.resize(rows_);
    std::iota(place_.begin(), place_.end(), 0);
    if (rows_ <= most_permuted_rows) try_all_orders();
    else exchange_neighbours();
  }

  void try_all_orders() {
    Order candidate = place_;
    std::size_t least = crossings(place_);
    while (least > 0 && std::next_permutation(candidate.begin(), candidate.end()))
      if (const std::size_t count = crossings(candidate); count < least) {
        least = count;
        place_ = candidate;
      }
  }

  void exchange_neighbours() {
    std::size_t least = crossings(place_);
    for (std::size_t round = 0; round < rows_ && least > 0; ++round)
      for (std::size_t i = 1; i < rows_; ++i) {
        std::swap(place_[i - 1], place_[i]);
        if (const std::size_t count = crossings(place_); count < least) least = count;
        else std::swap(place_[i - 1], place_[i]);
      }
  }

  // Every element stands in the first gap that its bar passes.
  void place_gaps() {
    std::vector<double> gap(x_.size(), least_gap);
    for (const Bar& bar : bars_) gap[bar.left] = std::max(gap[bar.left], length_of(bar) + 16);
    for (std::size_t column = 1; column < x_.size(); ++column) x_[column] = x_[column - 1] + gap[column - 1];
  }

  double length_of(const Bar& bar) const {
    return element_length(network_.elements[bar.element], network_.port_motion);
  }
  double y(const Bar& bar) const { return row_height * double(place_[bar.row]) + label_rise; }

  std::string drawn(const Bar& bar) const {
    const double from = x_[bar.left], next = x_[bar.left + 1], length = length_of(bar);
    const double first = (from + next - length) / 2;
    return wire({from, y(bar)}, {first, y(bar)}) +
           element_symbol(network_.elements[bar.element], network_.port_motion, {first, y(bar)}, length) +
           wire({first + length, y(bar)}, {x_[bar.right], y(bar)});
  }

  // The ground's is the wall.
  std::string rail(std::size_t column) const {
    const bool is_wall = column + 1 == x_.size();
    double top = std::numeric_limits<double>::infinity(), bottom = 0;
    std::string svg;
    for (const Bar& bar : bars_) {
      if (bar.left != column && bar.right != column) continue;
      top = std::min(top, y(bar));
      bottom = std::max(bottom, y(bar));
      svg += is_wall ? wire({x_[column], y(bar)}, {x_[column] + 12, y(bar)}) : junction({x_[column], y(bar)});
    }
    return is_wall ? svg : wire({x_[column], top}, {x_[column], bottom}) + svg;
  }

  static constexpr std::size_t far_away = std::numeric_limits<std::size_t>::max();

  const Network& network_;
  std::vector<std::size_t> column_;  // of each node
  std::vector<double> x_;            // of each column [px]
  std::vector<Bar> bars_;
  std::size_t rows_ = 0;
  Order place_;
};

}  // namespace

Inside rail_layout(const Network& network) { return Rails(network).inside(); }

}  // namespace dashpot::compiler
