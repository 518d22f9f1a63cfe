// A law with tunable parameters in evaluate(): the runtime's own class over the compiler's tables.
#pragma once

#include <dashpot/tunable_law.hpp>

#include <vector>

#include "law/tunable_tables.hpp"

namespace dashpot::compiler {

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
        law_(tables_),
        added_damping_(scalar(tables.added_damping)) {}
  TunableRun(const TunableRun&) = delete;  // tables_ points into this
  TunableRun& operator=(const TunableRun&) = delete;

  void reset(Scalar position) {
    last_position_ = sampled_position_ = tables_.contact.is_there ? pushed_in(tables_.contact.at, position) : position;
    sampled_change_ = 0;
    law_.reset(tables_, last_position_);
    last_damping_ = law_.damping_at_rest(tables_);
  }

  Scalar last_damping() const { return last_damping_ + added_damping_; }
  Scalar damping() const { return sample_.damping + added_damping_; }

  // The motor's part of it, were there no limit: not finite where the sample is to be refused.
  Scalar wanted(Scalar position, Scalar velocity) {
    sample_ = law_.output(tables_, last_position_, position, velocity);
    return sample_.wanted;
  }
  Scalar force() const { return sample_.force; }

  void keep() {
    sampled_change_ = sample_.change;
    sampled_position_ = sample_.position;
    last_damping_ = sample_.damping;
  }

  void update() {
    law_.update(tables_, sampled_change_, sampled_position_);
    last_position_ = sampled_position_;
  }

  unsigned set(const Scalar* values) { return law_.set(tables_, values); }
  Scalar kept_share() const { return law_.kept_share(); }
  Scalar stored_energy() const { return law_.stored_energy(tables_); }

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
  Scalar added_damping_;
  tunable_sample<Scalar> sample_ = {};
  Scalar last_position_ = 0, sampled_position_ = 0, sampled_change_ = 0;
  Scalar last_damping_ = law_.damping_at_rest(tables_);
};

}  // namespace dashpot::compiler
