// The springs, slips and tank of a law whose parameters change while it runs: what its programs call. Emitted code and
// the compiler's evaluate() run this same class, so that they agree in every bit under -ffp-contract=off.
//
// The states are elongations and offsets of springs (tunable/springs.hpp). V + T never rises by more than the work that
// the tool does, set() included.
//
// No heap, no recursion, no division but in set(), in reset() and between coupled slips; every loop is bounded by the
// tables.
#pragma once

#include <dashpot/command.hpp>
#include <dashpot/tunable/parts.hpp>
#include <dashpot/tunable/answers.hpp>
#include <dashpot/tunable/shedding.hpp>
#include <dashpot/tunable/slips.hpp>
#include <dashpot/tunable/tables.hpp>

namespace dashpot {

// Sizes are those of the tables, at least 1 each but for `Slips` and `Ends`. `SlipParts` and `Corners` are those of all
// couplings together, `Ends` those of the largest graph.
template <class Scalar, int Tunables, int Springs, int Nodes, int Blocks, int SlipParts, int Slips, int Corners,
          int Ends>
class tunable_law {
 public:
  using tables = tunable_tables<Scalar>;

  // All members get `t`, the tables that the law was made with.
  explicit constexpr tunable_law(const tables& t) noexcept {
    if constexpr (Slips > 0) slips_.begin(t);
    parts_.values.begin_at_largest(t);
    tune(t);
    if constexpr (Slips > 0) slips_.remember_largest(t, curves_, numbers(t));
    parts_.values.begin(t);
    tune(t);
    find_held(t);
    if constexpr (Slips > 0) slips_.reset(left_to_brake(t, slips_.damping_at_rest(t, curves_)));
  }

  // At rest at `position`: what joins tool and ground is loaded by it, what is behind a slip is not. Returns b of a
  // tool that is in touch and at rest [N·s/m].
  constexpr Scalar reset(const tables& t, Scalar position) noexcept {
    parts_.springs.reset(t.spring_count);
    for (Scalar& elongation : curves_.elongation) elongation = 0;
    if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) { parts_.load(t, part, position); });
    find_held(t);
    shedding_.reset();
    Scalar damping = port_.damping;
    if constexpr (Slips > 0) {
      const Scalar of_slips = left_to_brake(t, slips_.damping_at_rest(t, curves_));
      slips_.reset(of_slips);
      damping += of_slips;
    }
    return damping;
  }

  // What the tool meets in the next sample, to be asked for after reset() and set().
  constexpr const tunable_port<Scalar>& port(const tables&) const noexcept { return port_; }

  // Of all slips, by the tool's displacement in this sample: the force that opposes it [N].
  Scalar slip(const tables& t, Scalar change) noexcept { return slips_.step(t, change, curves_); }

  // The same of slips behind a surface, and all beside them: by what the surface's change would be if it stuck to the
  // tool.
  tunable_push<Scalar> push(const tables& t, Scalar approach) noexcept {
    tunable_push<Scalar> pushed = {};
    pushed.force = slips_.push(t, approach, curves_, pushed.change);
    return pushed;
  }

  // What slips leave to the brake after slip() or push(), by where the tool is.
  tunable_brake<Scalar> slip_brake(const tables& t, Scalar position) noexcept {
    const Scalar now = left_to_brake(t, slips_.damping_now(t, curves_)),
                 wanted = left_to_brake(t, slips_.commanded_damping(t, curves_, position)),
                 damping = slips_.reached_damping(t, wanted);
    return {now * t.rate, damping, clamp_to(make_up_, wanted - damping)};
  }

  // The motor's part within its limits, and of all forces the share that is kept for it.
  constexpr tunable_limit<Scalar> limit(const tables& t, Scalar wanted) noexcept {
    const Scalar force = shedding_.command(t, wanted);
    return {force, shedding_.share()};
  }

  // Where a surface that something elastic holds stands when what was shed of it has followed a tool that has left.
  constexpr Scalar follow(const tables&, Scalar surface, Scalar depth) noexcept {
    return shedding_.followed(surface, surface - depth);
  }

  // Takes the states over a sample, by the change of the tool, or of the surface that it pushes, and to its position.
  // Returns π of what joins tool and ground without a slip [N].
  Scalar update(const tables& t, Scalar change, Scalar position) noexcept {
    curves_.elongation[0] = change;
    for (int i = 0; i < t.block_count; ++i)
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { parts_.advance(t, part, curves_.elongation[i]); });
    if (shedding_.is_limited(t)) shed(t, position);
    else if (t.static_spring != no_index) parts_.springs.set_elongation(t.static_spring, position);
    parts_.springs.bring_offsets_home(t);
    if constexpr (Slips > 0) slips_.keep(t);
    find_held(t);
    return port_.held;
  }

  // Bit i of the result: wanted[i] was no number within the range. What is no number at all leaves its parameter as it
  // is. Where nothing changes, no bit of the states does. To be called between samples.
  constexpr unsigned set(const tables& t, const Scalar* wanted) noexcept {
    const auto change = parts_.values.take(t, wanted);
    if (!change.is_new) return change.clamped;
    parts_.springs.begin_change(t.spring_count);
    tune(t);
    carry_forces_over(t);
    find_held(t);
    return change.clamped;
  }

  // V + T [J]
  Scalar stored_energy(const tables& t) const noexcept { return parts_.springs.stored_energy(t.spring_count); }

  Scalar value(int tunable) const noexcept { return parts_.values.value(tunable); }

 private:
  constexpr auto numbers(const tables& t) const noexcept {
    return [this, &t](int index) { return parts_.number(t, index); };
  }

  // A surface that something elastic holds, and not slips alone, which stay where they are.
  static constexpr bool comes_back(const tables& t) noexcept {
    return t.contact.is_there && (t.static_spring != no_index || t.slip_count == 0);
  }

  // After the parts have advanced, by the share that output() has found.
  constexpr void shed(const tables& t, Scalar position) noexcept {
    const Scalar share = shedding_.share();
    const Scalar at = comes_back(t) ? position - shedding_.dented(position) : position;
    if (t.static_spring != no_index && !t.contact.is_there) parts_.springs.set_elongation(t.static_spring, at);
    for (int i = 0; i < t.part_count && share < 1; ++i) parts_.shed(t, t.parts[i], share);
    if (t.static_spring != no_index && t.contact.is_there) parts_.springs.set_elongation(t.static_spring, at);
    for (int i = 0; i < t.part_count && parts_.springs.has_shed(); ++i) parts_.bring_shed_offsets_home(t, t.parts[i]);
    shedding_.keep();
  }

  // Of b∞ behind slips, what the brake has left.
  constexpr Scalar left_to_brake(const tables& t, Scalar damping) const noexcept {
    if (!t.slip_rule.takes_part) return 0;
    const Scalar left = t.max_damping - port_.damping;
    return damping < left ? damping : left;
  }

  // Everything that follows from the parameters.
  constexpr void tune(const tables& t) noexcept {
    parts_.find_stiffnesses(t);
    tune_brake(t);
    for (int i = 1; i < t.block_count; ++i) {
      curves_.feedthrough[i] = 0;
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { curves_.feedthrough[i] += parts_.feedthrough(t, part); });
    }
    // Last, so that every mesh is left as the steps need it.
    for (int i = 0; i < t.block_count; ++i) {
      curves_.stiffness[i] = 0;
      parts_.each(t, t.blocks[i],
                  [&](const tunable_part<Scalar>& part) { curves_.stiffness[i] += parts_.step_stiffness(t, part); });
    }
    port_.recovery = curves_.stiffness[0] > 0 ? -(1 / curves_.stiffness[0]) : Scalar(0);
    port_.stiffness = 0;
    parts_.each(t, t.blocks[0],
                [&](const tunable_part<Scalar>& part) { port_.stiffness += parts_.step_stiffness_at_port(t, part); });
    if constexpr (Slips > 0) slips_.tune(t, curves_, numbers(t));
  }

  constexpr void tune_brake(const tables& t) noexcept {
    Scalar relaxing = 0;
    feedthrough_ = 0;
    parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
      const Scalar through = parts_.feedthrough(t, part);
      feedthrough_ += through;
      relaxing += parts_.relaxing_damping(t, part, through);
    });
    const Scalar wanted = brake_damping(t, feedthrough_ + relaxing);
    port_.damping = wanted < t.max_damping ? wanted : t.max_damping;
    // Where a surface can be left the motor compensates nothing.
    if (t.contact.is_there && port_.damping > feedthrough_) port_.damping = feedthrough_;
    port_.gain = feedthrough_ - port_.damping;
    port_.feedthrough = feedthrough_ * t.rate;
    const Scalar assured = t.slip_rule.assured_share * port_.damping - (port_.gain < 0 ? -port_.gain : port_.gain);
    make_up_ = assured > 0 ? assured : Scalar(0);
  }

  constexpr Scalar brake_damping(const tables& t, Scalar zero_frequency) const noexcept {
    switch (t.rule) {
      case brake_rule::constant: break;
      case brake_rule::observed: return parts_.number(t, t.observed);
      case brake_rule::zero_frequency: return zero_frequency;
      case brake_rule::half_zero_frequency:
        return zero_frequency / 2 > feedthrough_ ? zero_frequency / 2 : feedthrough_;
      case brake_rule::feedthrough: return feedthrough_;
      case brake_rule::within_viscosity: return zero_frequency < t.damping ? zero_frequency : t.damping;
    }
    return t.damping;
  }

  // p = g δ + π: π of every block, and what its meshes need to be spread.
  constexpr void find_held(const tables& t) noexcept {
    for (int i = 0; i < t.block_count; ++i) {
      Scalar held = 0;
      parts_.each(t, t.blocks[i], [&](const tunable_part<Scalar>& part) { held += parts_.held_by(t, part); });
      curves_.held[i] = held;
    }
    port_.held = curves_.held[0];
  }

  // After a change of the springs' stiffnesses. The spring between tool and ground makes up for what others could not
  // keep.
  constexpr void carry_forces_over(const tables& t) noexcept {
    parts_.springs.carry_over(t.spring_count);
    if (t.static_spring != no_index) {
      Scalar missing = 0;
      parts_.each(t, t.blocks[0], [&](const tunable_part<Scalar>& part) {
        if (part.spring != no_index) missing += parts_.springs.missing_force(part.spring);
      });
      if (missing != 0) parts_.springs.make_up_for(t.static_spring, missing);
    }
    for (int i = 0; i < t.part_count; ++i) parts_.take_forces(t, t.parts[i]);
  }

  tunable_parts<Scalar, Tunables, Springs, Nodes> parts_;
  tunable_curves<Scalar, Blocks> curves_;
  tunable_slips<Scalar, Blocks, SlipParts, Slips, Corners, Ends> slips_;
  tunable_shedding<Scalar> shedding_;
  tunable_port<Scalar> port_;
  Scalar feedthrough_ = 0;  // b∞ of what no slip changes [N·s/m]
  Scalar make_up_ = 0;      // of b that the motor makes up at most [N·s/m]
};

}  // namespace dashpot
