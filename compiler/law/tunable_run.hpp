// A law with tunable parameters in evaluate(): the runtime's own class over the compiler's tables.
#pragma once

#include <dashpot/tunable_law.hpp>

#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "law/update_law.hpp"

namespace dashpot::compiler {

// By what a call returns.
template <class Scalar>
class TunableAnswer {
 public:
  TunableAnswer(std::initializer_list<std::pair<TunableResult, Scalar>> all) {
    for (const auto& [result, value] : all) all_[static_cast<std::size_t>(result)] = value;
  }
  Scalar of(TunableResult result) const { return all_[static_cast<std::size_t>(result)]; }

 private:
  std::array<Scalar, 9> all_ = {};
};

template <class Scalar>
tunable_range<Scalar> converted(const tunable_range<double>& range) {
  return {static_cast<Scalar>(range.value), static_cast<Scalar>(range.min), static_cast<Scalar>(range.max)};
}

template <class Scalar>
class TunableRun {
 public:
  explicit TunableRun(const TunableTables& tables)
      : blocks_(converted_all<tunable_block<Scalar>>(tables.blocks, block_of)),
        yields_(converted_all<tunable_yield<Scalar>>(tables.yields, yield_of)),
        nodes_(converted_all<slip_node<Scalar>>(tables.nodes, node_of)),
        tables_(tables_of(tables)) {}
  TunableRun(const TunableRun&) = delete;  // tables_ points into this
  TunableRun& operator=(const TunableRun&) = delete;

  TunableAnswer<Scalar> call(TunableCall call, const std::vector<Scalar>& given) {
    using enum TunableResult;
    const auto one = [](Scalar number) { return TunableAnswer<Scalar>{{value, number}}; };
    switch (call) {
      case TunableCall::set: return one(law_.set(tables_, given.data()));
      case TunableCall::meshes: {
        const auto m = law_.meshes(tables_);
        return {{stiffness, m.stiffness}, {feedthrough, m.feedthrough}};
      }
      case TunableCall::viscosity: return one(law_.viscosity(tables_, given.data()));
      case TunableCall::held: return one(law_.held(tables_));
      case TunableCall::reset: return one(law_.reset(tables_, given[0]));
      case TunableCall::resting_brake: return one(law_.resting_brake(tables_, given[0]));
      case TunableCall::slip: return one(law_.slip(tables_, given[0]));
      case TunableCall::push: {
        const auto pushed = law_.push(tables_, given[0]);
        return {{force, pushed.force}, {change, pushed.change}};
      }
      case TunableCall::slip_brake: {
        const auto b = law_.slip_brake(tables_, given[0], given[1]);
        return {{now, b.now}, {damping, b.damping}, {wanted, b.wanted}};
      }
      case TunableCall::limit: {
        const auto limited = law_.limit(tables_, given[0]);
        return {{force, limited.force}, {share, limited.share}};
      }
      case TunableCall::follow: return one(law_.follow(tables_, given[0], given[1]));
      case TunableCall::update: return one(law_.update(tables_, given[0], given[1]));
      case TunableCall::stored_energy: return one(law_.stored_energy(tables_));
    }
    return {};
  }

 private:
  template <class To, class From, class Convert>
  static std::vector<To> converted_all(const std::vector<From>& all, Convert convert) {
    std::vector<To> result;
    for (const From& one : all) result.push_back(convert(one));
    return result;
  }

  static Scalar scalar(double value) { return static_cast<Scalar>(value); }
  static tunable_block<Scalar> block_of(const tunable_block<double>& b) {
    return {b.first_part, b.part_count, scalar(b.least_stiffness)};
  }
  static tunable_yield<Scalar> yield_of(const tunable_yield<double>& y) {
    return {y.first_cut, y.cut_count, scalar(y.least)};
  }
  static slip_node<Scalar> node_of(const slip_node<double>& n) {
    return {n.kind, n.first_child, n.child_count, n.slips, n.place, n.first_corner, 0, 0, 0};
  }

  tunable_tables<Scalar> tables_of(const TunableTables& t) {
    const tunable_tables<double>& h = t.head;
    return {scalar(h.rate),
            scalar(h.retention),
            scalar(h.threshold),
            h.static_spring,
            {h.contact.is_there, scalar(h.contact.at), scalar(h.contact.encoder_step)},
            {h.slip_rule.takes_part, scalar(h.slip_rule.hysteresis), scalar(h.slip_rule.coil_share)},
            h.spring_count,
            h.part_count,
            h.block_count,
            h.slip_count,
            h.coupling_count,
            h.graph_count,
            t.springs.data(),
            t.parts.data(),
            t.edges.data(),
            blocks_.data(),
            t.cuts.data(),
            yields_.data(),
            t.couplings.data(),
            nodes_.data(),
            t.graphs.data(),
            t.links.data(),
            t.ties.data(),
            scalar(h.motor_limit),
            scalar(h.motor_step),
            {h.map.is_there, scalar(h.map.largest_change), scalar(h.map.largest_stiffness)}};
  }

  std::vector<tunable_block<Scalar>> blocks_;
  std::vector<tunable_yield<Scalar>> yields_;
  std::vector<slip_node<Scalar>> nodes_;
  tunable_tables<Scalar> tables_;
  tunable_law<Scalar, most_tunable_springs, most_tunable_nodes, most_tunable_blocks, most_tunable_slip_parts,
              most_tunable_slips, most_tunable_corners, most_tunable_ends>
      law_;
};

}  // namespace dashpot::compiler
