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
  std::array<Scalar, 12> all_ = {};
};

template <class Scalar>
class TunableRun {
 public:
  explicit TunableRun(const TunableTables& tables)
      : ranges_(converted<tunable_range<Scalar>>(tables.tunables, [](const Tunable& t) { return range_of(t.range); })),
        numbers_(converted<tunable_number<Scalar>>(tables.numbers, number_of)),
        parts_(converted<tunable_part<Scalar>>(tables.parts, part_of)),
        nodes_(converted<slip_node<Scalar>>(tables.nodes, node_of)),
        shares_(converted<Scalar>(tables.shares, scalar)),
        tables_(tables_of(tables)),
        law_(tables_) {}
  TunableRun(const TunableRun&) = delete;  // tables_ points into this
  TunableRun& operator=(const TunableRun&) = delete;

  unsigned set(const Scalar* values) { return law_.set(tables_, values); }

  TunableAnswer<Scalar> call(TunableCall call, const std::vector<Scalar>& given) {
    using enum TunableResult;
    const auto one = [](Scalar number) { return TunableAnswer<Scalar>{{value, number}}; };
    switch (call) {
      case TunableCall::reset: return one(law_.reset(tables_, given[0]));
      case TunableCall::port: {
        const auto p = law_.port(tables_);
        return {{held, p.held},         {stiffness, p.stiffness},
                {recovery, p.recovery}, {feedthrough, p.feedthrough},
                {damping, p.damping},   {gain, p.gain}};
      }
      case TunableCall::slip: return one(law_.slip(tables_, given[0]));
      case TunableCall::push: {
        const auto pushed = law_.push(tables_, given[0]);
        return {{force, pushed.force}, {change, pushed.change}};
      }
      case TunableCall::slip_brake: {
        const auto b = law_.slip_brake(tables_, given[0]);
        return {{now, b.now}, {damping, b.damping}, {make_up, b.make_up}};
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
  static std::vector<To> converted(const std::vector<From>& all, Convert convert) {
    std::vector<To> result;
    for (const From& one : all) result.push_back(convert(one));
    return result;
  }

  static Scalar scalar(double value) { return static_cast<Scalar>(value); }
  static tunable_range<Scalar> range_of(const tunable_range<double>& r) {
    return {scalar(r.value), scalar(r.min), scalar(r.max)};
  }
  static tunable_number<Scalar> number_of(const tunable_number<double>& n) {
    return {scalar(n.base), n.first, n.count};
  }
  static tunable_part<Scalar> part_of(const tunable_part<double>& p) {
    return {p.kind,       p.spring,     p.damping,  p.first_node,    p.node_count,
            p.first_edge, p.edge_count, p.is_loose, scalar(p.share), scalar(p.loss)};
  }
  static slip_node<Scalar> node_of(const slip_node<double>& n) {
    return {n.kind, n.first_child, n.child_count, n.slips, n.place, n.first_corner, 0, 0, 0};
  }

  tunable_tables<Scalar> tables_of(const TunableTables& t) {
    const tunable_tables<double>& h = t.head;
    return {scalar(h.period),
            scalar(h.rate),
            h.is_exact,
            scalar(h.retention),
            scalar(h.threshold),
            scalar(h.least_share),
            h.rule,
            scalar(h.damping),
            h.observed,
            scalar(h.max_damping),
            h.static_spring,
            {h.contact.is_there, scalar(h.contact.at), scalar(h.contact.encoder_step)},
            {h.slip_rule.takes_part, scalar(h.slip_rule.hysteresis), scalar(h.slip_rule.coil_share),
             scalar(h.slip_rule.assured_share)},
            h.tunable_count,
            h.spring_count,
            h.part_count,
            h.block_count,
            h.slip_count,
            h.coupling_count,
            h.graph_count,
            ranges_.data(),
            t.terms.data(),
            numbers_.data(),
            t.springs.data(),
            parts_.data(),
            t.edges.data(),
            t.blocks.data(),
            t.cuts.data(),
            t.yields.data(),
            t.couplings.data(),
            nodes_.data(),
            t.graphs.data(),
            t.links.data(),
            t.ties.data(),
            shares_.empty() ? nullptr : shares_.data(),
            scalar(h.motor_limit),
            scalar(h.motor_step)};
  }

  std::vector<tunable_range<Scalar>> ranges_;
  std::vector<tunable_number<Scalar>> numbers_;
  std::vector<tunable_part<Scalar>> parts_;
  std::vector<slip_node<Scalar>> nodes_;
  std::vector<Scalar> shares_;
  tunable_tables<Scalar> tables_;
  tunable_law<Scalar, most_tunables, most_tunable_springs, most_tunable_nodes, most_tunable_blocks,
              most_tunable_slip_parts, most_tunable_slips, most_tunable_corners, most_tunable_ends>
      law_;
};

}  // namespace dashpot::compiler
